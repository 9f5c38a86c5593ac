#include "materials/initial_strain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "math/dense.hpp"
#include "math/pack.hpp"
#include "math/symmetric_tensor.hpp"

namespace balocco {

namespace {

/// What a law is asked for and what its answer means, where it has begun with the strain `initial`.
template <PointKind kind, class T>
struct Beginning {
  static constexpr int n = strain_size(kind), size = initial_stress_size(kind);
  std::array<T, size> initial;

  /// Of the law: F F0, or E + E0.
  std::array<T, n> strain(const std::array<T, n>& strain) const {
    std::array<T, n> of_law{};
    if constexpr (kind == PointKind::solid) return (Matrix3<T>{strain} * gradient()).component;
    for (int k = 0; k < size; ++k) of_law[k] = strain[k] + initial[k];
    return of_law;
  }
  /// From that of the law: P F0 / det F0, or S.
  std::array<T, n> stress(const std::array<T, n>& of_law) const {
    if constexpr (kind == PointKind::solid) return (T(1.0) / volume() * (Matrix3<T>{of_law} * gradient())).component;
    return of_law;
  }
  T volume() const {
    if constexpr (kind == PointKind::solid) {
      const Matrix3<T> f0 = gradient();
      return determinant(f0, cofactor(f0));
    }
    return T(1.0);
  }
  /// Of bounds of the tangent: dF F0 is the law's change, (dF F0) (F F0)^-1 = dF F^-1.
  T of_shear_bound() const {
    if constexpr (kind == PointKind::solid) {
      const SymmetricTensor<T> strain{initial};
      const T stretch = T(1.0) + square_root(double_contraction(strain, strain));
      return stretch * stretch / volume();
    }
    return T(1.0);
  }

 private:
  Matrix3<T> gradient() const
    requires(kind == PointKind::solid)
  {
    return full(SymmetricTensor<T>{initial}.plus_identity(T(1.0)));
  }
};

template <PointKind kind>
class InitiallyStrained final : public Law<kind> {
 public:
  static constexpr int n = strain_size(kind), size = initial_stress_size(kind);
  using Values = std::array<double, n>;
  using Initial = std::array<double, size>;

  explicit InitiallyStrained(std::unique_ptr<Law<kind>> law) : law_(std::move(law)), own_(law_->history_size()) {}

  int history_size() const override { return own_ + 2 * size; }
  std::vector<HistoryField> history_fields() const override {
    auto fields = law_->history_fields();
    fields.push_back({"S0", own_, size});
    fields.push_back({"E0", own_ + size, size});
    return fields;
  }
  bool bounds_spatial_gradient() const override { return law_->bounds_spatial_gradient(); }

  void stress(PointBatch<kind>& points) const override {
    std::array<std::array<Pack, n>, PointBatch<kind>::capacity / pack_size> kept;
    find_initial_strains(points);
    for (int point = points.first; point < points.first + points.count; point += pack_size) {
      auto& strain = kept[(point - points.first) / pack_size];
      for (int k = 0; k < n; ++k) strain[k] = load(&points.strain[k][point]);
      const auto of_law = beginning(points, point).strain(strain);
      for (int k = 0; k < n; ++k) store(of_law[k], &points.strain[k][point]);
    }
    law_->stress(points);
    for (int point = points.first; point < points.first + points.count; point += pack_size) {
      const auto begin = beginning(points, point);
      std::array<Pack, n> of_law;
      for (int k = 0; k < n; ++k) of_law[k] = load(&points.stress[k][point]);
      const auto stress = begin.stress(of_law);
      for (int k = 0; k < n; ++k) {
        store(stress[k], &points.stress[k][point]);
        store(kept[(point - points.first) / pack_size][k], &points.strain[k][point]);
      }
      store(load(&points.shear_modulus[point]) * begin.of_shear_bound(), &points.shear_modulus[point]);
      if constexpr (kind == PointKind::solid)
        store(load(&points.volumetric_modulus[point]) / begin.volume(), &points.volumetric_modulus[point]);
    }
  }

  void tangent(std::span<const double, n> strain, double increment, std::span<double> history, std::span<double, n> stress,
               std::span<double> stiffness) const override {
    const Beginning<kind, double> begin{initial_strain(history)};
    std::ranges::copy(begin.initial, history.begin() + own_ + size);
    Values of_law;
    law_->tangent(begin.strain(values(strain)), increment, history.first(own_), of_law, stiffness);
    std::ranges::copy(begin.stress(of_law), stress.begin());
    for (std::size_t row = 0; row < stiffness.size(); row += n) pull_back(begin, stiffness.subspan(row, n));
    for (int column = 0; column < n && !stiffness.empty(); ++column) {
      Values rates;
      for (int row = 0; row < n; ++row) rates[row] = stiffness[n * row + column];
      rates = begin.stress(rates);
      for (int row = 0; row < n; ++row) stiffness[n * row + column] = rates[row];
    }
  }

  void history_slopes(std::span<const double, n> strain, double increment, std::span<const double> old_history, int row,
                      std::span<double> slopes) const override {
    const Beginning<kind, double> begin{initial_strain(old_history)};
    law_->history_slopes(begin.strain(values(strain)), increment, old_history.first(own_), row, slopes);
    for (std::size_t first = 0; first < slopes.size(); first += n) pull_back(begin, slopes.subspan(first, n));
  }

  EnergyDensity energy_density(std::span<const double, n> strain, std::span<const double> history) const override {
    const Beginning<kind, double> begin{initial_strain(history)};
    const EnergyDensity of_law = law_->energy_density(begin.strain(values(strain)), history.first(own_));
    const double share = 1.0 / begin.volume();
    return {share * of_law.recoverable, share * of_law.plastic, share * of_law.viscous, share * of_law.heat};
  }

  /// The thickness is that of the beginning.
  double transverse_stretch(std::span<const double, n> strain, std::span<const double> history) const override {
    const Beginning<kind, double> begin{initial_strain(history)};
    const auto strain_at_rest = begin.strain(at_rest());
    std::vector<double> own(static_cast<std::size_t>(own_), 0.0);
    Values stress;
    law_->tangent(strain_at_rest, 0.0, own, stress, {});
    return law_->transverse_stretch(begin.strain(values(strain)), history.first(own_)) / law_->transverse_stretch(strain_at_rest, own);
  }

 private:
  static Values values(std::span<const double, n> span) {
    Values copy;
    std::ranges::copy(span, copy.begin());
    return copy;
  }
  static Values at_rest() {
    Values strain{};
    for (int k = 0; kind == PointKind::solid && k < n; k += 4) strain[k] = 1.0;
    return strain;
  }
  static bool is_zero(std::span<const double> values) {
    return std::ranges::all_of(values, [](double value) { return value == 0.0; });
  }
  static double norm(std::span<const double> values) {
    return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0));
  }

  /// Derivatives by the law's strain become those by the element's.
  static void pull_back(const Beginning<kind, double>& begin, std::span<double> slopes) {
    if constexpr (kind == PointKind::solid)  // A F0, as F0 is symmetric
      std::ranges::copy(begin.strain(values(slopes.template first<n>())), slopes.begin());
  }

  Beginning<kind, Pack> beginning(const PointBatch<kind>& points, int point) const {
    Beginning<kind, Pack> begin;
    for (int k = 0; k < size; ++k)
      begin.initial[k].copy_from(points.history + (own_ + size + k) * points.history_stride + point - points.first,
                                 std::experimental::element_aligned);
    return begin;
  }

  void find_initial_strains(const PointBatch<kind>& points) const {
    std::vector<double> history;
    for (int lane = 0; lane < points.count; ++lane) {
      const auto at = [&](int row) -> double& { return points.history[row * points.history_stride + lane]; };
      bool is_known = false, is_free = true;
      for (int k = 0; k < size; ++k) {
        is_free = is_free && at(own_ + k) == 0.0;
        is_known = is_known || at(own_ + size + k) != 0.0;
      }
      if (is_free || is_known) continue;
      history.resize(static_cast<std::size_t>(history_size()));
      for (int row = 0; row < history_size(); ++row) history[row] = at(row);
      const Initial initial = initial_strain(history);
      for (int k = 0; k < size; ++k) at(own_ + size + k) = initial[k];
    }
  }

  /// The strain with which the law begins, by Newton's method: strains of metals are small, and so is what a tangent by F leaves of the
  /// exact one by a symmetric strain.
  Initial initial_strain(std::span<const double> history) const {
    constexpr int most_iterations = 12, first_slow = 3;
    constexpr double accuracy = 1e-14, round_off = 1e-10;
    Beginning<kind, double> begin{};
    const auto wanted = history.subspan(own_, size), known = history.subspan(own_ + size, size);
    if (is_zero(wanted)) return begin.initial;
    if (!is_zero(known)) {
      std::ranges::copy(known, begin.initial.begin());
      return begin.initial;
    }
    Initial elastic{};  // of the stiffness at rest: of a stress that the law will not let stand
    double before = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      std::vector<double> own(history.begin(), history.begin() + own_);
      Dense<n, n> stiffness;
      Values of_law;
      law_->tangent(begin.strain(at_rest()), 0.0, own, of_law, stiffness.component);
      Initial lacking = symmetric(begin.stress(of_law));
      for (int k = 0; k < size; ++k) lacking[k] = wanted[k] - lacking[k];
      const double left = norm(lacking);
      if (left <= accuracy * norm(wanted)) return begin.initial;
      if (iteration >= first_slow && left > 0.5 * before) return left <= round_off * norm(wanted) ? begin.initial : elastic;
      before = left;
      const auto modulus = symmetric(stiffness);
      solve_dense(modulus.component, lacking, 1);
      for (int k = 0; k < size; ++k) begin.initial[k] += lacking[k];
      if (iteration == 0) elastic = begin.initial;
    }
    return elastic;
  }

  static Initial symmetric(const Values& stress) {
    if constexpr (kind == PointKind::solid) return symmetric_part(Matrix3<double>{stress}).component;
    else return stress;
  }
  /// By symmetric strains.
  static Dense<size, size> symmetric(const Dense<n, n>& stiffness) {
    if constexpr (kind == PointKind::solid) {
      Dense<size, size> result;
      for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
          for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l) result(initial_stress_component[i][j], initial_stress_component[k][l]) += stiffness(3 * i + j, 3 * k + l);
      return result;
    } else {
      return stiffness;
    }
  }

  std::unique_ptr<Law<kind>> law_;
  int own_;
};

}  // namespace

template <PointKind kind>
std::unique_ptr<Law<kind>> initially_strained(std::unique_ptr<Law<kind>> law) {
  return std::make_unique<InitiallyStrained<kind>>(std::move(law));
}

template std::unique_ptr<Law<PointKind::solid>> initially_strained(std::unique_ptr<Law<PointKind::solid>>);
template std::unique_ptr<Law<PointKind::plane>> initially_strained(std::unique_ptr<Law<PointKind::plane>>);
template std::unique_ptr<Law<PointKind::line>> initially_strained(std::unique_ptr<Law<PointKind::line>>);
template std::unique_ptr<Law<PointKind::fibre>> initially_strained(std::unique_ptr<Law<PointKind::fibre>>);

}  // namespace balocco
