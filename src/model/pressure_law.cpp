#include "model/pressure_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace balocco {

namespace {

/// Work of x (exp(x) - 1) from zero to x: (x - 1) exp(x) + 1 - x^2 / 2, a series where that cancels.
double work_of_exponential(double x) {
  if (x > 0.5) return (x - 1.0) * std::exp(x) + 1.0 - 0.5 * x * x;
  double sum = 0.0, power = x * x;  // x^(n + 2) / ((n + 2) n!)
  for (int n = 1; n <= 14; ++n) {
    power *= x / n;
    sum += power / (n + 2);
  }
  return sum;
}

/// The straight line that holds at an overclosure behind the first row: its first row.
std::size_t piece_of(const std::vector<PressureLaw::Row>& rows, double overclosure) {
  const auto behind = std::ranges::upper_bound(rows, overclosure, {}, &PressureLaw::Row::overclosure);
  const auto piece = std::distance(rows.begin(), behind) - 1;
  return static_cast<std::size_t>(std::min(piece, std::ssize(rows) - 2));
}

double slope_of_piece(const std::vector<PressureLaw::Row>& rows, std::size_t piece) {
  return (rows[piece + 1].pressure - rows[piece].pressure) / (rows[piece + 1].overclosure - rows[piece].overclosure);
}

}  // namespace

double PressureLaw::start() const {
  if (kind == Kind::exponential) return -clearance;
  return kind == Kind::table ? rows.front().overclosure : 0.0;
}

PressureLaw::Value PressureLaw::at(double overclosure, double straight_from) const {
  if (overclosure <= start()) return {};
  if (kind == Kind::linear) return {slope * overclosure, slope};
  if (overclosure > straight_from) {
    const auto end = at(straight_from);
    return {end.pressure + end.slope * (overclosure - straight_from), end.slope};
  }
  if (kind == Kind::table) {
    const auto piece = piece_of(rows, overclosure);
    const double rise = slope_of_piece(rows, piece);
    return {rows[piece].pressure + rise * (overclosure - rows[piece].overclosure), rise};
  }
  const double x = 1.0 + overclosure / clearance, scale = pressure / (std::numbers::e - 1.0), growth = std::expm1(x);
  return {scale * x * growth, scale / clearance * (growth + x * (growth + 1.0))};
}

double PressureLaw::energy(double overclosure, double straight_from) const {
  if (overclosure <= start()) return 0.0;
  if (kind == Kind::linear) return 0.5 * slope * overclosure * overclosure;
  if (overclosure > straight_from) {
    const double beyond = overclosure - straight_from;
    return energy(straight_from) + 0.5 * beyond * (at(straight_from).pressure + at(overclosure, straight_from).pressure);
  }
  if (kind == Kind::exponential)
    return clearance * pressure / (std::numbers::e - 1.0) * work_of_exponential(1.0 + overclosure / clearance);
  double sum = 0.0;
  const auto piece = piece_of(rows, overclosure);
  for (std::size_t i = 0; i < piece; ++i)
    sum += 0.5 * (rows[i].pressure + rows[i + 1].pressure) * (rows[i + 1].overclosure - rows[i].overclosure);
  return sum + 0.5 * (rows[piece].pressure + at(overclosure).pressure) * (overclosure - rows[piece].overclosure);
}

double PressureLaw::mean_pressure(double from, double to, double straight_from) const {
  // Nearer than this the difference of two works is rounding, and the pressure between them as good.
  constexpr double together = 1e-6;
  const double reach = std::abs(from - start()) + std::abs(to - start());
  if (std::abs(to - from) <= together * reach) return at(0.5 * (from + to), straight_from).pressure;
  return (energy(to, straight_from) - energy(from, straight_from)) / (to - from);
}

double PressureLaw::steepest() const {
  if (kind != Kind::table) return slope;
  double steepest = 0.0;
  for (std::size_t piece = 0; piece + 1 < rows.size(); ++piece) steepest = std::max(steepest, slope_of_piece(rows, piece));
  return steepest;
}

/// The slope grows with x: Newton's steps from above, where it is convex, come down on it.
double PressureLaw::where_slope_is(double sought) const {
  const double ratio = sought * clearance * (std::numbers::e - 1.0) / pressure;  // exp(x) (1 + x) - 1
  if (!(ratio > 0.0)) return start();
  double x = std::log1p(ratio);
  for (int i = 0; i < 60; ++i) {
    const double step = (std::exp(x) * (1.0 + x) - 1.0 - ratio) / (std::exp(x) * (2.0 + x));
    x -= step;
    if (std::abs(step) <= 1e-15 * x) break;
  }
  return (x - 1.0) * clearance;
}

}  // namespace balocco
