// From a law's plain formulas, templated over the scalar, to the batched interface of materials/material_law.hpp.
//
// The formulas are an aggregate of parameters. Elastic ones have
//   solid: Matrix3<T> stress(const Matrix3<T>& F)             first Piola-Kirchhoff stress
//          TangentBound<T> bound(const Matrix3<T>& F)         see PointBatch
//          T energy(const Matrix3<T>& F), or for T = double   per reference volume
//          `compiled_whole` = true where stress and bound share much of what they compute: they become one function, at the price
//          of longer compilation
//   thin (plane, line, fibre; n strains): Point prepare(const std::array<T, n>& E), std::array<T, n> stress(Point),
//          T bound(Point) (half the largest eigenvalue of the tangent, E12 counted twice in dE : dE), double energy(E),
//          double transverse_stretch(E)
// Those with memory have a State<T>, an aggregate of scalars and tensors that is zero in the undeformed state, and
//          void fields(State<T>& s, visit)                    calls visit(name, scalar, or array of components) for each
//          stress(F or E, State<T>& s, double increment)      s: old on entry, new on return
//          bound(F, P) or bound(E, S, s); `bounds_spatial_gradient` = true: see Law
//          EnergyDensity energy(F or E, const State<double>&), double transverse_stretch(E, const State<double>&)
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "materials/material_law.hpp"
#include "materials/tangent_bound.hpp"
#include "math/dual.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Parameter `index` of a law as the deck gave it; 0 where a data line ended early.
inline double parameter(std::span<const double> parameters, std::size_t index) {
  return index < parameters.size() ? parameters[index] : 0.0;
}

template <class Formulas>
concept Remembers = requires { typename Formulas::template State<double>; };

/// A state's scalars one after the other, each by its reference: visit(name, component, scalar).
template <class Formulas, class State, class Visit>
void for_each_scalar(const Formulas& formulas, State& state, Visit&& visit) {
  formulas.fields(state, [&](const char* name, auto& field) {
    if constexpr (requires { field.begin(); }) {
      for (std::size_t i = 0; i < field.size(); ++i) visit(name, static_cast<int>(i), field[i]);
    } else {
      visit(name, 0, field);
    }
  });
}

template <class Formulas>
std::vector<HistoryField> fields_of(const Formulas& formulas) {
  std::vector<HistoryField> fields;
  int row = 0;
  typename Formulas::template State<double> state{};
  for_each_scalar(formulas, state, [&](const char* name, int component, const double&) {
    if (component == 0) fields.push_back({name, row, 0});
    ++fields.back().components;
    ++row;
  });
  return fields;
}

/// Formulas and state to and from the history of one point (stride 1) or of a pack of points.
template <Remembers Formulas, class T>
struct Memory {
  using State = typename Formulas::template State<T>;

  static State read(const Formulas& formulas, const double* history, std::ptrdiff_t stride) {
    State state{};
    for_each_scalar(formulas, state, [&](const char*, int, T& scalar) {
      if constexpr (std::is_same_v<T, Pack>)
        scalar.copy_from(history, std::experimental::element_aligned);
      else
        scalar = *history;
      history += stride;
    });
    return state;
  }
  static void write(const Formulas& formulas, const State& state, double* history, std::ptrdiff_t stride) {
    for_each_scalar(formulas, state, [&](const char*, int, const T& scalar) {
      if constexpr (std::is_same_v<T, Pack>)
        scalar.copy_to(history, std::experimental::element_aligned);
      else
        *history = value_of(scalar);
      history += stride;
    });
  }
};

/// The adapter of any kind: `Kinematics<T>` is Matrix3<T> for solids, std::array<T, n> for the others.
template <PointKind kind, class Formulas>
class LawOf final : public Law<kind> {
 public:
  static constexpr int n = strain_size(kind);
  explicit LawOf(const Formulas& formulas) : formulas_(formulas) {
    if constexpr (Remembers<Formulas>) fields_ = fields_of(formulas);
  }

  int history_size() const override {
    return fields_.empty() ? 0 : fields_.back().first + fields_.back().components;
  }
  std::vector<HistoryField> history_fields() const override { return fields_; }

  void stress(PointBatch<kind>& points) const override {
    if constexpr (requires { Formulas::compiled_whole; })
      respond_whole(points);
    else
      respond_packs(points);
  }

  void tangent(std::span<const double, n> strain, double increment, std::span<double> history,
               std::span<double, n> stress, std::span<double> stiffness) const override {
    if (stiffness.empty()) {
      const Kinematics<double> result = respond<double>(as_kinematics(strain), increment, history);
      for (int i = 0; i < n; ++i) stress[i] = component(result, i);
      return;
    }
    Kinematics<Dual<n>> variables;
    for (int k = 0; k < n; ++k) component(variables, k) = Dual<n>(strain[k], k);
    const Kinematics<Dual<n>> result = respond<Dual<n>>(variables, increment, history);
    for (int i = 0; i < n; ++i) {
      stress[i] = component(result, i).value;
      for (int j = 0; j < n; ++j) stiffness[n * i + j] = component(result, i).derivative[j];
    }
  }

  void history_slopes(std::span<const double, n> strain, double increment, std::span<const double> old_history, int row,
                      std::span<double> slopes) const override {
    if constexpr (Remembers<Formulas>) {
      Kinematics<Dual<n>> variables;
      for (int k = 0; k < n; ++k) component(variables, k) = Dual<n>(strain[k], k);
      auto state = Memory<Formulas, Dual<n>>::read(formulas_, old_history.data(), 1);
      formulas_.stress(variables, state, increment);
      int at = -row;
      for_each_scalar(formulas_, state, [&](const char*, int, const Dual<n>& scalar) {
        if (at >= 0 && at * n < static_cast<int>(slopes.size())) std::ranges::copy(scalar.derivative, slopes.begin() + at * n);
        ++at;
      });
    } else {
      Law<kind>::history_slopes(strain, increment, old_history, row, slopes);
    }
  }
  bool bounds_spatial_gradient() const override {
    return requires { Formulas::bounds_spatial_gradient; };
  }

  EnergyDensity energy_density(std::span<const double, n> strain, std::span<const double> history) const override {
    if constexpr (Remembers<Formulas>) {
      return formulas_.energy(as_kinematics(strain), Memory<Formulas, double>::read(formulas_, history.data(), 1));
    } else {
      return {formulas_.energy(as_kinematics(strain)), 0.0, 0.0};
    }
  }

  void energy_densities(const PointBatch<kind>& points, const double* history, std::ptrdiff_t stride,
                        std::span<EnergyDensity> densities) const override {
    if constexpr (requires(const Kinematics<Pack>& strain) { formulas_.energy(strain); }) {
      for (int i = 0; i < points.count; i += pack_size) {
        const Pack energy = formulas_.energy(strain_of_pack(points, points.first + i));
        for (int lane = 0; lane < pack_size; ++lane) densities[static_cast<std::size_t>(i + lane)] = {energy[lane], 0.0, 0.0};
      }
    } else {
      Law<kind>::energy_densities(points, history, stride, densities);
    }
  }

  double transverse_stretch(std::span<const double, n> strain, std::span<const double> history) const override {
    if constexpr (kind == PointKind::solid)
      return 1.0;
    else if constexpr (Remembers<Formulas>)
      return formulas_.transverse_stretch(as_kinematics(strain),
                                          Memory<Formulas, double>::read(formulas_, history.data(), 1));
    else
      return formulas_.transverse_stretch(as_kinematics(strain));
  }

 private:
  template <class T>
  using Kinematics = std::conditional_t<kind == PointKind::solid, Matrix3<T>, std::array<T, n>>;

  template <class T>
  static T& component(Matrix3<T>& tensor, int k) {
    return tensor.component[k];
  }
  template <class T>
  static const T& component(const Matrix3<T>& tensor, int k) {
    return tensor.component[k];
  }
  template <class T, std::size_t size>
  static T& component(std::array<T, size>& values, int k) {
    return values[k];
  }
  template <class T, std::size_t size>
  static const T& component(const std::array<T, size>& values, int k) {
    return values[k];
  }
  static Kinematics<double> as_kinematics(std::span<const double, n> strain) {
    Kinematics<double> result;
    for (int k = 0; k < n; ++k) component(result, k) = strain[k];
    return result;
  }

  void respond_packs(PointBatch<kind>& points) const {
    for (int point = points.first; point < points.first + points.count; point += pack_size)
      respond_pack(points, point, strain_of_pack(points, point));
  }
  [[gnu::flatten]] void respond_whole(PointBatch<kind>& points) const { respond_packs(points); }

  static Kinematics<Pack> strain_of_pack(const PointBatch<kind>& points, int point) {
    Kinematics<Pack> strain;
    for (int k = 0; k < n; ++k) component(strain, k) = load(&points.strain[k][point]);
    return strain;
  }

  /// One pack of a batch: stress, bounds, history.
  void respond_pack(PointBatch<kind>& points, int point, const Kinematics<Pack>& strain) const {
    if constexpr (Remembers<Formulas>) {
      using Remembered = Memory<Formulas, Pack>;
      double* const history = points.history + (point - points.first);
      auto state = Remembered::read(formulas_, history, points.history_stride);
      const auto stress = formulas_.stress(strain, state, points.increment);
      Remembered::write(formulas_, state, history, points.history_stride);
      put(points, point, stress);
      if constexpr (kind == PointKind::solid)
        put_bound(points, point, formulas_.bound(strain, stress));
      else
        put_bound(points, point, {Pack(0.0), formulas_.bound(strain, stress, state)});
    } else if constexpr (kind == PointKind::solid) {
      const auto stress = formulas_.stress(strain);
      const TangentBound<Pack> bound = formulas_.bound(strain);
      put(points, point, stress);
      put_bound(points, point, bound);
    } else {
      const auto prepared = formulas_.prepare(strain);
      put(points, point, formulas_.stress(prepared));
      put_bound(points, point, {Pack(0.0), formulas_.bound(prepared)});
    }
  }
  static void put(PointBatch<kind>& points, int point, const Kinematics<Pack>& stress) {
    for (int k = 0; k < n; ++k) store(component(stress, k), &points.stress[k][point]);
  }
  static void put_bound(PointBatch<kind>& points, int point, const TangentBound<Pack>& bound) {
    store(bound.volumetric, &points.volumetric_modulus[point]);
    store(bound.shear, &points.shear_modulus[point]);
  }

  /// One point: stress, and history if there is one.
  template <class T>
  Kinematics<T> respond(const Kinematics<T>& strain, double increment, std::span<double> history) const {
    if constexpr (Remembers<Formulas>) {
      auto state = Memory<Formulas, T>::read(formulas_, history.data(), 1);
      const auto stress = formulas_.stress(strain, state, increment);
      Memory<Formulas, T>::write(formulas_, state, history.data(), 1);
      return stress;
    } else if constexpr (kind == PointKind::solid) {
      return formulas_.stress(strain);
    } else {
      return formulas_.stress(formulas_.prepare(strain));
    }
  }

  Formulas formulas_;
  std::vector<HistoryField> fields_;
};

template <class Formulas>
std::unique_ptr<Law<PointKind::solid>> make_solid_law(const Formulas& formulas) {
  return std::make_unique<LawOf<PointKind::solid, Formulas>>(formulas);
}
template <class Formulas>
std::unique_ptr<Law<PointKind::plane>> make_plane_law(const Formulas& formulas) {
  return std::make_unique<LawOf<PointKind::plane, Formulas>>(formulas);
}
template <class Formulas>
std::unique_ptr<Law<PointKind::line>> make_line_law(const Formulas& formulas) {
  return std::make_unique<LawOf<PointKind::line, Formulas>>(formulas);
}
template <class Formulas>
std::unique_ptr<Law<PointKind::fibre>> make_fibre_law(const Formulas& formulas) {
  return std::make_unique<LawOf<PointKind::fibre, Formulas>>(formulas);
}

}  // namespace balocco
