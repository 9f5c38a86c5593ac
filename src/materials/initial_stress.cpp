#include "materials/initial_stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "math/dense.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

constexpr std::array<std::pair<int, int>, 6> symmetric_pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
constexpr int component_of[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};

template <PointKind kind>
class InitiallyStressed final : public Law<kind> {
 public:
  static constexpr int n = strain_size(kind), size = initial_stress_size(kind);

  explicit InitiallyStressed(std::unique_ptr<Law<kind>> law) : law_(std::move(law)) {}

  int history_size() const override { return law_->history_size() + size; }
  std::vector<HistoryField> history_fields() const override {
    auto fields = law_->history_fields();
    fields.push_back({"S0", law_->history_size(), size});
    return fields;
  }

  void stress(PointBatch<kind>& points) const override {
    law_->stress(points);
    const double* const rows = points.history + law_->history_size() * points.history_stride;
    for (int point = points.first; point < points.first + points.count; point += pack_size) {
      std::array<Pack, size> initial;
      for (int k = 0; k < size; ++k)
        initial[k].copy_from(rows + k * points.history_stride + point - points.first, std::experimental::element_aligned);
      std::array<Pack, n> strain, sum;
      for (int k = 0; k < n; ++k) {
        strain[k] = load(&points.strain[k][point]);
        sum[k] = load(&points.stress[k][point]);
      }
      add(initial, strain, sum);
      for (int k = 0; k < n; ++k) store(sum[k], &points.stress[k][point]);
      if constexpr (kind == PointKind::solid)  // dF S0 : dF <= |S0| dF : dF
        store(load(&points.shear_modulus[point]) + 0.5 * norm(initial), &points.shear_modulus[point]);
    }
  }

  void tangent(std::span<const double, n> strain, double increment, std::span<double> history, std::span<double, n> stress,
               std::span<double> stiffness) const override {
    law_->tangent(strain, increment, history.first(law_->history_size()), stress, stiffness);
    std::array<double, size> initial;
    std::array<double, n> at, sum;
    std::copy_n(history.begin() + law_->history_size(), size, initial.begin());
    std::copy_n(strain.begin(), n, at.begin());
    std::copy_n(stress.begin(), n, sum.begin());
    add(initial, at, sum);
    std::copy_n(sum.begin(), n, stress.begin());
    if constexpr (kind == PointKind::solid)
      for (int i = 0; i < 3 && !stiffness.empty(); ++i)
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k < 3; ++k) stiffness[n * (3 * i + j) + 3 * i + k] += initial[component_of[k][j]];
  }

  EnergyDensity energy_density(std::span<const double, n> strain, std::span<const double> history) const override {
    EnergyDensity energy = law_->energy_density(strain, history.first(law_->history_size()));
    const auto initial = history.subspan(law_->history_size());
    if constexpr (kind == PointKind::solid) {
      for (int k = 0; k < size; ++k) {
        const auto [i, j] = symmetric_pairs[k];
        double square = i == j ? -1.0 : 0.0;  // of C - 1 = 2 E
        for (int m = 0; m < 3; ++m) square += strain[3 * m + i] * strain[3 * m + j];
        energy.recoverable += (i == j ? 0.5 : 1.0) * initial[k] * square;
      }
    } else {
      for (int k = 0; k < n; ++k) energy.recoverable += initial[k] * strain[k];
    }
    return energy;
  }

  double transverse_stretch(std::span<const double, n> strain, std::span<const double> history) const override {
    return law_->transverse_stretch(strain, history.first(law_->history_size()));
  }

 private:
  template <class T>
  static void add(const std::array<T, size>& initial, const std::array<T, n>& strain, std::array<T, n>& stress) {
    if constexpr (kind == PointKind::solid) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k < 3; ++k) stress[3 * i + j] = stress[3 * i + j] + strain[3 * i + k] * initial[component_of[k][j]];
    } else {
      for (int k = 0; k < n; ++k) stress[k] = stress[k] + initial[k];
    }
  }

  static Pack norm(const std::array<Pack, size>& initial) {
    Pack sum(0.0);
    for (int k = 0; k < size; ++k) sum = sum + (k < 3 ? 1.0 : 2.0) * initial[k] * initial[k];
    return square_root(sum);
  }

  std::unique_ptr<Law<kind>> law_;
};

/// A law that yields, and that begins with an elastic strain: of what is stored then it keeps the books too. The strain is found when the
/// law is asked first.
template <PointKind kind>
class InitiallyStrained final : public Law<kind> {
 public:
  static constexpr int n = strain_size(kind);
  using Values = std::array<double, n>;

  explicit InitiallyStrained(std::unique_ptr<Law<kind>> law) : law_(std::move(law)), own_(law_->history_size()) {}

  int history_size() const override { return own_ + 2 * n; }
  std::vector<HistoryField> history_fields() const override {
    auto fields = law_->history_fields();
    fields.push_back({"S0", own_, n});
    fields.push_back({"E0", own_ + n, n});
    return fields;
  }

  void stress(PointBatch<kind>& points) const override {
    std::array<std::array<Pack, PointBatch<kind>::capacity / pack_size>, n> strain;
    find_initial_strains(points);
    for (int point = points.first; point < points.first + points.count; point += pack_size)
      for (int k = 0; k < n; ++k) {
        auto& kept = strain[k][(point - points.first) / pack_size];
        kept = load(&points.strain[k][point]);
        const double* const initial = points.history + (own_ + n + k) * points.history_stride + point - points.first;
        store(kept + Pack(initial, std::experimental::element_aligned), &points.strain[k][point]);
      }
    law_->stress(points);
    for (int point = points.first; point < points.first + points.count; point += pack_size)
      for (int k = 0; k < n; ++k) store(strain[k][(point - points.first) / pack_size], &points.strain[k][point]);
  }

  void tangent(std::span<const double, n> strain, double increment, std::span<double> history, std::span<double, n> stress,
               std::span<double> stiffness) const override {
    const Values initial = initial_strain(history);
    std::ranges::copy(initial, history.begin() + own_ + n);
    law_->tangent(sum(strain, initial), increment, history.first(own_), stress, stiffness);
  }

  void history_slopes(std::span<const double, n> strain, double increment, std::span<const double> old_history, int row,
                      std::span<double> slopes) const override {
    law_->history_slopes(sum(strain, initial_strain(old_history)), increment, old_history.first(own_), row, slopes);
  }

  EnergyDensity energy_density(std::span<const double, n> strain, std::span<const double> history) const override {
    return law_->energy_density(sum(strain, initial_strain(history)), history.first(own_));
  }

  /// The thickness is that of the beginning.
  double transverse_stretch(std::span<const double, n> strain, std::span<const double> history) const override {
    const Values initial = initial_strain(history);
    const std::vector<double> virgin(static_cast<std::size_t>(own_), 0.0);
    return law_->transverse_stretch(sum(strain, initial), history.first(own_)) / law_->transverse_stretch(initial, virgin);
  }

 private:
  static Values sum(std::span<const double, n> strain, const Values& initial) {
    Values sum;
    for (int k = 0; k < n; ++k) sum[k] = strain[k] + initial[k];
    return sum;
  }

  static bool is_zero(std::span<const double> values) {
    return std::ranges::all_of(values, [](double value) { return value == 0.0; });
  }

  void find_initial_strains(const PointBatch<kind>& points) const {
    std::vector<double> history;
    for (int lane = 0; lane < points.count; ++lane) {
      const auto at = [&](int row) -> double& { return points.history[row * points.history_stride + lane]; };
      bool is_known = false, is_free = true;
      for (int k = 0; k < n; ++k) {
        is_free = is_free && at(own_ + k) == 0.0;
        is_known = is_known || at(own_ + n + k) != 0.0;
      }
      if (is_free || is_known) continue;
      history.resize(static_cast<std::size_t>(history_size()));
      for (int row = 0; row < history_size(); ++row) history[row] = at(row);
      const Values initial = initial_strain(history);
      for (int k = 0; k < n; ++k) at(own_ + n + k) = initial[k];
    }
  }

  /// The strain at which the law has the stress S0, by Newton's method; of a stress beyond yield, which the law will not let stand, that of
  /// the stiffness at rest.
  Values initial_strain(std::span<const double> history) const {
    Values strain{};
    const auto wanted = history.subspan(own_, n), known = history.subspan(own_ + n, n);
    if (is_zero(wanted)) return strain;
    if (!is_zero(known)) {
      std::ranges::copy(known, strain.begin());
      return strain;
    }
    constexpr int most_iterations = 8;  // strains of metals are small
    constexpr double accuracy = 1e-12;
    const auto norm = [](const auto& values) { return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0)); };
    Values at_rest{};
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      std::vector<double> own(history.begin(), history.begin() + own_);
      Dense<n, n> stiffness;
      Values stress, lacking;
      law_->tangent(strain, 0.0, own, stress, stiffness.component);
      for (int k = 0; k < n; ++k) lacking[k] = wanted[k] - stress[k];
      if (norm(lacking) <= accuracy * norm(wanted)) return strain;
      solve_dense(stiffness.component, lacking, 1);
      for (int k = 0; k < n; ++k) strain[k] += lacking[k];
      if (iteration == 0) at_rest = strain;
    }
    return at_rest;
  }

  std::unique_ptr<Law<kind>> law_;
  int own_;
};

}  // namespace

template <PointKind kind>
std::unique_ptr<Law<kind>> initially_stressed(std::unique_ptr<Law<kind>> law) {
  if (history_scalar(*law, "PEEQ") < 0) return std::make_unique<InitiallyStressed<kind>>(std::move(law));
  if constexpr (kind != PointKind::solid) return std::make_unique<InitiallyStrained<kind>>(std::move(law));
  throw InputError("an initial stress does not count for yielding of solids; leave *INITIAL CONDITIONS, TYPE=STRESS out for elements "
                   "whose material has *PLASTIC");
}

template std::unique_ptr<Law<PointKind::solid>> initially_stressed(std::unique_ptr<Law<PointKind::solid>>);
template std::unique_ptr<Law<PointKind::plane>> initially_stressed(std::unique_ptr<Law<PointKind::plane>>);
template std::unique_ptr<Law<PointKind::line>> initially_stressed(std::unique_ptr<Law<PointKind::line>>);
template std::unique_ptr<Law<PointKind::fibre>> initially_stressed(std::unique_ptr<Law<PointKind::fibre>>);

}  // namespace balocco
