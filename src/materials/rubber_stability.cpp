#include "materials/rubber_stability.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

namespace balocco {

namespace {

struct Mode {
  const char* name;
  double second, third;  // logarithmic strains per strain in direction 1
};
constexpr std::array<Mode, 3> modes{{{"uniaxial", -0.5, -0.5}, {"biaxial", 1.0, -2.0}, {"planar", 0.0, -1.0}}};

/// Principal Cauchy stresses 1 and 2 with the third made zero by the pressure of the incompressible material.
std::array<double, 2> stresses(const Law<PointKind::solid>& law,
                               const std::array<double, 3>& strain) {
  std::array<double, 9> f{}, p;
  for (int i = 0; i < 3; ++i) f[4 * i] = std::exp(strain[i]);
  std::vector<double> history(law.history_size(), 0.0);
  law.tangent(f, 0.0, history, p, {});
  const double third = p[8] * f[8];
  return {p[0] * f[0] - third, p[4] * f[4] - third};
}

/// Whether d sigma_a / d epsilon_b (a, b = 1, 2, the third following from incompressibility) is positive definite.
bool stable(const Law<PointKind::solid>& law,
            const std::array<double, 3>& strain) {
  constexpr double step = 1e-4;
  double d[2][2];
  for (int b = 0; b < 2; ++b) {
    std::array<double, 3> plus = strain, minus = strain;
    plus[b] += step;
    plus[2] -= step;
    minus[b] -= step;
    minus[2] += step;
    const auto more = stresses(law, plus), less = stresses(law, minus);
    for (int a = 0; a < 2; ++a) d[a][b] = more[a] - less[a];
  }
  const double off = 0.5 * (d[0][1] + d[1][0]);
  return d[0][0] + d[1][1] > 0.0 && d[0][0] * d[1][1] > off * off;
}

}  // namespace

std::string unstable_range(const Law<PointKind::solid>& law) {
  constexpr double least = 0.2, most = 6.0;  // stretches
  constexpr int steps = 200;
  std::string text;
  for (const Mode& mode : modes) {
    for (const double end : {least, most}) {
      for (int k = 1; k <= steps; ++k) {
        const double strain = std::log(end) * k / steps;
        if (stable(law, {strain, mode.second * strain, mode.third * strain})) continue;
        text += fmt::format("{}{} {} beyond a nominal strain of {:.2f}", text.empty() ? "" : ", ", mode.name,
                            end < 1.0 ? "compression" : "tension", std::exp(strain) - 1.0);
        break;
      }
    }
  }
  return text.empty() ? text : "the law is unstable (Drucker) in " + text + "; keep strains below or fit it again";
}

}  // namespace balocco
