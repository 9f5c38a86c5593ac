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
    for (const auto& field : law_->history_fields())
      if (field.name == "S0") stressed_ = field;
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
      Pack stored([&](int lane) { return whole_energy(energy[point - points.first + lane]); }), contraction(0.0);
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
      const Heated heated = heated_at_rest(own);
      const Values pull = pulled(strain, heated.modulus);
      for (int k = 0; k < n; ++k) stress[k] -= state[thermal] * pull[k];
      if constexpr (kind == PointKind::solid)  // of F S; linear steps leave it out
        for (int k = 0; k < n && !stiffness.empty(); ++k)
          for (int i = 0; i < 3; ++i) stiffness[n * k + k / 3 * 3 + i] -= state[thermal] * heated.modulus[3 * i + k % 3];
      now = state[thermal] * heated.modulus_of_volume - work_of(strain, heated.modulus);
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
      now = slope(theta, whole_energy(law_->energy_density(part, own)), contraction);
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
    energy = {volume * energy.recoverable, volume * energy.plastic, volume * energy.viscous, volume * energy.heat + state[work]};
    if (state[linear] == 0.0) return energy;
    const Heated heated = heated_at_rest(history.first(own_));
    energy.recoverable -= state[thermal] * work_of(strain, heated.modulus);
    energy.recoverable += 0.5 * state[thermal] * state[thermal] * heated.modulus_of_volume;
    return energy;
  }

  double transverse_stretch(std::span<const double, n> strain, std::span<const double> history) const override {
    const double theta = history[own_ + linear] != 0.0 ? 1.0 : 1.0 + history[own_ + thermal];
    const double of_law = law_->transverse_stretch(mechanical_of(strain, theta), history.first(own_));
    return of_law * (kind == PointKind::plane ? theta : theta * theta);  // a thickness, or an area
  }

 private:
  struct Heated {
    Values modulus{};                // D : 1
    double modulus_of_volume = 0.0;  // 1 : D : 1
  };
  /// With the law's tangent D in the undeformed state; `own` tells of the point's axes.
  Heated heated_at_rest(std::span<const double> own) const {
    Values undeformed{}, stress;
    if constexpr (kind == PointKind::solid)
      for (int k = 0; k < n; ++k) undeformed[k] = stretched<kind>(k);
    std::array<double, n * n> stiffness;
    std::vector<double> history(own.begin(), own.end());
    std::fill_n(history.begin() + stressed_.first, stressed_.components, 0.0);
    law_->tangent(undeformed, 0.0, history, stress, stiffness);
    Heated heated;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) heated.modulus[i] += stiffness[n * i + k] * stretched<kind>(k);
    for (int k = 0; k < n; ++k) heated.modulus_of_volume += heated.modulus[k] * stretched<kind>(k);
    return heated;
  }
  /// What expands with the volume: dissipated energy too is counted by it.
  static double whole_energy(const EnergyDensity& energy) { return energy.recoverable + energy.plastic + energy.viscous; }
  static Values mechanical_of(std::span<const double, n> strain, double theta) {
    Values part;
    for (int k = 0; k < n; ++k) part[k] = mechanical<kind>(strain[k], theta, k);
    return part;
  }
  /// A stress S of the undeformed state as the law gives stresses: F S of solids, whose F is not 1 at rest where the columns are other
  /// material axes than the global ones.
  static Values pulled(std::span<const double, n> strain, const Values& s) {
    if constexpr (kind != PointKind::solid) return s;
    Values p{};
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < 3; ++i) p[k] += strain[k / 3 * 3 + i] * s[3 * i + k % 3];
    return p;
  }
  /// S : E, with Green's strain of solids.
  static double work_of(std::span<const double, n> strain, const Values& s) {
    double work = 0.0;
    if constexpr (kind == PointKind::solid) {
      const Values p = pulled(strain, s);
      for (int k = 0; k < n; ++k) work += 0.5 * (strain[k] * p[k] - stretched<kind>(k) * s[k]);
    } else {
      for (int k = 0; k < n; ++k) work += s[k] * strain[k];
    }
    return work;
  }
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
  HistoryField stressed_{.name = {}, .first = 0, .components = 0};  // an initial stress, which stiffens nothing here
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
