#include "materials/expanding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/pack.hpp"

namespace balocco {

namespace {

enum Row { thermal, linear, done, force, work, rows };

/// 1 in the components of a strain that expansion stretches.
template <PointKind kind>
constexpr double stretched(int k) {
  if constexpr (kind == PointKind::solid) return k % 4 == 0 ? 1.0 : 0.0;
  if constexpr (kind == PointKind::plane) return k < 2 ? 1.0 : 0.0;
  return k == 0 ? 1.0 : 0.0;
}

/// Strain of the mechanical part: F / theta, or (E - (theta^2 - 1) / 2) / theta^2.
template <PointKind kind, class T>
T mechanical(const T& strain, const T& theta, int k) {
  if constexpr (kind == PointKind::solid) return strain / theta;
  return (strain - (0.5 * stretched<kind>(k)) * (theta * theta - 1.0)) / (theta * theta);
}

/// Stress from that of the law: theta^2 P, or theta S.
template <PointKind kind, class T>
T whole_stress(const T& stress, const T& theta) {
  if constexpr (kind == PointKind::solid) return theta * theta * stress;
  return theta * stress;
}

template <PointKind kind>
class Expanding final : public Law<kind> {
 public:
  static constexpr int n = strain_size(kind);
  using Values = std::array<double, n>;

  explicit Expanding(std::unique_ptr<Law<kind>> law) : law_(std::move(law)), own_(law_->history_size()) {
    Values undeformed{}, stress;
    if constexpr (kind == PointKind::solid)
      for (int k = 0; k < n; ++k) undeformed[k] = stretched<kind>(k);
    std::array<double, n * n> stiffness;
    std::vector<double> history(static_cast<std::size_t>(own_), 0.0);
    law_->tangent(undeformed, 0.0, history, stress, stiffness);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) modulus_[i] += stiffness[n * i + k] * stretched<kind>(k);
    for (int k = 0; k < n; ++k) modulus_of_volume_ += modulus_[k] * stretched<kind>(k);
  }

  int history_size() const override { return own_ + rows; }
  std::vector<HistoryField> history_fields() const override {
    auto fields = law_->history_fields();
    int row = own_;
    for (const char* name : {"THE", "THE LINEAR", "THE DONE", "THE FORCE", "THE WORK"}) fields.push_back({name, row++, 1});
    return fields;
  }
  bool bounds_spatial_gradient() const override { return law_->bounds_spatial_gradient(); }

  void stress(PointBatch<kind>& points) const override {
    std::array<std::array<Pack, PointBatch<kind>::capacity / pack_size>, n> strain;
    const auto at = [&](int row, int point) { return points.history + (own_ + row) * points.history_stride + point - points.first; };
    const auto read = [&](int row, int point) { return Pack(at(row, point), std::experimental::element_aligned); };
    for (int point = points.first; point < points.first + points.count; point += pack_size) {
      const Pack theta = 1.0 + read(thermal, point);
      for (int k = 0; k < n; ++k) {
        strain[k][(point - points.first) / pack_size] = load(&points.strain[k][point]);
        store(mechanical<kind>(load(&points.strain[k][point]), theta, k), &points.strain[k][point]);
      }
    }
    law_->stress(points);
    std::array<EnergyDensity, PointBatch<kind>::capacity> energy;
    law_->energy_densities(points, points.history, points.history_stride, energy);
    for (int point = points.first; point < points.first + points.count; point += pack_size) {
      const Pack theta = 1.0 + read(thermal, point);
      Pack stored([&](int lane) { return energy[point - points.first + lane].recoverable; }), contraction(0.0);
      for (int k = 0; k < n; ++k) {
        const Pack whole = whole_stress<kind>(load(&points.stress[k][point]), theta), part = load(&points.strain[k][point]);
        contraction += contracted(whole, part, k);
        store(whole, &points.stress[k][point]);
        store(strain[k][(point - points.first) / pack_size], &points.strain[k][point]);
      }
      const Pack now = slope(theta, stored, contraction);
      const Pack step = read(thermal, point) - read(done, point);
      const Pack sum = read(work, point) + 0.5 * (read(force, point) + now) * step;
      sum.copy_to(at(work, point), std::experimental::element_aligned);
      now.copy_to(at(force, point), std::experimental::element_aligned);
      read(thermal, point).copy_to(at(done, point), std::experimental::element_aligned);
      scale_bounds(points, point, theta);
    }
  }

  void tangent(std::span<const double, n> strain, double increment, std::span<double> history, std::span<double, n> stress,
               std::span<double> stiffness) const override {
    const auto own = history.first(own_);
    const auto state = history.subspan(own_, rows);
    double now = 0.0;
    if (state[linear] != 0.0) {
      law_->tangent(strain, increment, own, stress, stiffness);
      for (int k = 0; k < n; ++k) {
        now -= modulus_[k] * from_rest(strain[k], k);
        stress[k] -= state[thermal] * modulus_[k];
      }
      now += state[thermal] * modulus_of_volume_;
    } else {
      const double theta = 1.0 + state[thermal];
      const Values part = mechanical_of(strain, theta);
      law_->tangent(part, increment, own, stress, stiffness);
      double contraction = 0.0;
      for (int k = 0; k < n; ++k) {
        stress[k] = whole_stress<kind>(stress[k], theta);
        contraction += contracted(stress[k], part[k], k);
      }
      for (double& slope_of_stress : stiffness) slope_of_stress *= kind == PointKind::solid ? theta : 1.0 / theta;
      now = slope(theta, law_->energy_density(part, own).recoverable, contraction);
    }
    state[work] += 0.5 * (state[force] + now) * (state[thermal] - state[done]);
    state[force] = now;
    state[done] = state[thermal];
  }

  void history_slopes(std::span<const double, n> strain, double increment, std::span<const double> old_history, int row,
                      std::span<double> slopes) const override {
    const double theta = old_history[own_ + linear] != 0.0 ? 1.0 : 1.0 + old_history[own_ + thermal];
    law_->history_slopes(mechanical_of(strain, theta), increment, old_history.first(own_), row, slopes);
    for (double& value : slopes) value /= kind == PointKind::solid ? theta : theta * theta;
  }

  EnergyDensity energy_density(std::span<const double, n> strain, std::span<const double> history) const override {
    const auto state = history.subspan(own_, rows);
    const double theta = state[linear] != 0.0 ? 1.0 : 1.0 + state[thermal];
    EnergyDensity energy = law_->energy_density(mechanical_of(strain, theta), history.first(own_));
    const double volume = theta * theta * theta;
    energy = {volume * energy.recoverable, volume * energy.plastic, volume * energy.viscous, state[work]};
    if (state[linear] == 0.0) return energy;
    for (int k = 0; k < n; ++k) energy.recoverable -= state[thermal] * modulus_[k] * from_rest(strain[k], k);
    energy.recoverable += 0.5 * state[thermal] * state[thermal] * modulus_of_volume_;
    return energy;
  }

  double transverse_stretch(std::span<const double, n> strain, std::span<const double> history) const override {
    const double theta = history[own_ + linear] != 0.0 ? 1.0 : 1.0 + history[own_ + thermal];
    const double of_law = law_->transverse_stretch(mechanical_of(strain, theta), history.first(own_));
    return of_law * (kind == PointKind::plane ? theta : theta * theta);  // a thickness, or an area
  }

 private:
  static Values mechanical_of(std::span<const double, n> strain, double theta) {
    Values part;
    for (int k = 0; k < n; ++k) part[k] = mechanical<kind>(strain[k], theta, k);
    return part;
  }
  static double from_rest(double strain, int k) { return kind == PointKind::solid ? strain - stretched<kind>(k) : strain; }
  /// Addend of P : F_mech, or of S : (2 E_mech + 1).
  template <class T>
  static T contracted(const T& stress, const T& part, int k) {
    if constexpr (kind == PointKind::solid) return stress * part;
    return stress * (2.0 * part + stretched<kind>(k));
  }
  /// dW/d(theta) at a given F: 3 W / theta - P : F / theta, where F = theta F_mech; with S, P : F = theta^2 S : (2 E_mech + 1).
  template <class T>
  static T slope(const T& theta, const T& energy_of_law, const T& contraction) {
    const T of_volume = 3.0 * (theta * theta) * energy_of_law;
    if constexpr (kind == PointKind::solid) return of_volume - contraction;
    return of_volume - theta * contraction;
  }
  /// Of theta^3 W_law: (F^-T : dF)^2 is the same of F_mech, dF_mech = dF / theta, dE_mech = dE / theta^2.
  static void scale_bounds(PointBatch<kind>& points, int point, const Pack& theta) {
    const Pack shear = load(&points.shear_modulus[point]);
    store(kind == PointKind::solid ? shear * theta : shear / theta, &points.shear_modulus[point]);
    if constexpr (kind == PointKind::solid)
      store(load(&points.volumetric_modulus[point]) * (theta * theta * theta), &points.volumetric_modulus[point]);
  }

  std::unique_ptr<Law<kind>> law_;
  int own_;
  Values modulus_{};                // D : 1
  double modulus_of_volume_ = 0.0;  // 1 : D : 1
};

}  // namespace

template <PointKind kind>
std::unique_ptr<Law<kind>> expanding(std::unique_ptr<Law<kind>> law) {
  return std::make_unique<Expanding<kind>>(std::move(law));
}

template std::unique_ptr<Law<PointKind::solid>> expanding(std::unique_ptr<Law<PointKind::solid>>);
template std::unique_ptr<Law<PointKind::plane>> expanding(std::unique_ptr<Law<PointKind::plane>>);
template std::unique_ptr<Law<PointKind::line>> expanding(std::unique_ptr<Law<PointKind::line>>);
template std::unique_ptr<Law<PointKind::fibre>> expanding(std::unique_ptr<Law<PointKind::fibre>>);

}  // namespace balocco
