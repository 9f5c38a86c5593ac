#include "materials/initial_stress.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

namespace {

constexpr std::array<std::pair<int, int>, 6> symmetric_pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

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
          for (int k = 0; k < 3; ++k) stiffness[n * (3 * i + j) + 3 * i + k] += initial[initial_stress_component[k][j]];
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
          for (int k = 0; k < 3; ++k) stress[3 * i + j] = stress[3 * i + j] + strain[3 * i + k] * initial[initial_stress_component[k][j]];
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

}  // namespace

template <PointKind kind>
std::unique_ptr<Law<kind>> initially_stressed(std::unique_ptr<Law<kind>> law) {
  const bool yields = history_scalar(*law, "PEEQ") >= 0;
  return yields ? initially_strained(std::move(law)) : std::make_unique<InitiallyStressed<kind>>(std::move(law));
}

template std::unique_ptr<Law<PointKind::solid>> initially_stressed(std::unique_ptr<Law<PointKind::solid>>);
template std::unique_ptr<Law<PointKind::plane>> initially_stressed(std::unique_ptr<Law<PointKind::plane>>);
template std::unique_ptr<Law<PointKind::line>> initially_stressed(std::unique_ptr<Law<PointKind::line>>);
template std::unique_ptr<Law<PointKind::fibre>> initially_stressed(std::unique_ptr<Law<PointKind::fibre>>);

}  // namespace balocco
