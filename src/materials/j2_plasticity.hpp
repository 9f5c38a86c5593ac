// *PLASTIC: finite-strain J2 plasticity, F = Fe Fp with Hencky's elasticity in the intermediate configuration and the
// exponential map (Eterovic & Bathe, Int. J. Numer. Meth. Eng. 30, 1990; Weber & Anand, Comput. Meth. Appl. Mech. Eng.
// 79, 1990). The return is exact: along a fixed direction one large increment gives what many small ones give. Isotropic
// hardening by FlowStress; kinematic by back stresses of Armstrong & Frederick (Chaboche, Int. J. Plasticity 2, 1986).
#pragma once

#include <array>

#include "materials/flow_stress.hpp"
#include "materials/material_law.hpp"
#include "materials/plastic_increment.hpp"
#include "materials/stretch.hpp"
#include "materials/tangent_bound.hpp"
#include "math/symmetric_tensor.hpp"

namespace balocco {

struct BackStress {
  double modulus = 0.0;  // C: slope per plastic strain
  double recall = 0.0;   // gamma: saturates at C / gamma; 0: linear

  /// Share of the old back stress that is left after plastic strain dp, and what grows along the flow.
  template <class V>
  V remaining(const V& dp) const {
    return recall > 0.0 ? exponential(-recall * dp) : V(1.0);
  }
  template <class V>
  V growth(const V& dp, const V& remaining) const {
    return recall > 0.0 ? (modulus / recall) * (1.0 - remaining) : modulus * dp;
  }
};

struct J2Plasticity {
  static constexpr bool compiled_whole = true;  // law_of.hpp
  static constexpr int most_back_stresses = 4;
  static constexpr bool bounds_spatial_gradient = true;
  double bulk, shear;
  FlowStress flow;
  std::vector<BackStress> back_stresses;
  double failure_strain = 0.0;  // *SHEAR FAILURE: PEEQ after which a point carries nothing; 0: none

  /// @throws InputError if the options of the material do not fit together
  static J2Plasticity of(const Material& material);
  /// Whether a material has *PLASTIC.
  static bool wanted(const Material& material);

  template <class T>
  struct State {
    Matrix3<T> plastic{};  // Fp^-1 - I
    T equivalent_plastic_strain = T(0.0), dissipation = T(0.0);
    std::array<SymmetricTensor<T>, most_back_stresses> back_stress{};
    T failed = T(0.0);  // 1 from the end of the increment on in which the plastic strain of failure was reached
  };
  template <class S, class Visit>
  void fields(S& state, Visit&& visit) const {
    visit("FP", state.plastic.component);
    visit("PEEQ", state.equivalent_plastic_strain);
    visit("PLASTIC DISSIPATION", state.dissipation);
    for (std::size_t i = 0; i < back_stresses.size(); ++i) visit("ALPHA", state.back_stress[i].component);
    if (failure_strain > 0.0) visit("FAILED", state.failed);
  }

  template <class T>
  Matrix3<T> stress(const Matrix3<T>& f, State<T>& state, double increment) const {
    if (!(failure_strain > 0.0)) return intact_stress(f, state, increment);
    const State<T> old = state;
    const Matrix3<T> carried = intact_stress(f, state, increment);
    return fail(f, old, carried, state);
  }

  /// With tau = P F^T, l = dF F^-1, x = largest difference of elastic principal strains:
  ///   d2W <= lambda (tr l)^2 + 2 mu (x coth x) |sym l|^2 + 3 |tau| |l|^2,  x coth x <= 1 + x^2 / 3 <= 1 + |tau / mu|^2 / 6,
  /// |l| <= |F^-1|_2 |dF|. Plastic flow only lowers it.
  template <class T>
  TangentBound<T> bound(const Matrix3<T>& f, const Matrix3<T>& piola) const {
    const Invariants<T> c = invariants(f);
    const T inverse_square = 1.0 / (c.jacobian * c.jacobian);
    const T n2 = largest_eigenvalue_bound(c.second * inverse_square, c.first * inverse_square);
    const T stress_square = double_contraction(piola, piola) * largest_eigenvalue_bound(c.first, c.second);
    const T x = (1.0 / (6.0 * shear * shear)) * stress_square;
    return {T(maximum(bulk - (2.0 / 3.0) * shear, 0.0)), n2 * (shear * (1.0 + x) + 1.5 * square_root(stress_square))};
  }

  EnergyDensity energy(const Matrix3<double>& f, const State<double>& state) const {
    return {state.failed > 0.0 ? 0.0 : elastic_energy(f, state.plastic), state.dissipation, 0.0};
  }

 private:
  template <class T>
  Matrix3<T> intact_stress(const Matrix3<T>& f, State<T>& state, double increment) const {
    const Elastic<T> elastic = elastic_strain(f, state.plastic);
    const T volume = trace(elastic.strain);
    SymmetricTensor<T> deviator = T(2.0 * shear) * elastic.strain.plus_identity((-1.0 / 3.0) * volume);
    if (increment != 0.0 || !flow.depends_on_rate()) flow_back(elastic.strain, deviator, state, increment);

    // U^-1 T U^-1 = Ce^-1 T where they commute; Fe = R U and Fp are still those of the trial: flow does not change the
    // elastic rotation R.
    const SymmetricTensor<T> total = deviator.plus_identity(bulk * volume);
    Matrix3<T> second;
    if (back_stresses.empty()) {
      const SymmetricTensor<T> metric = inverse((T(2.0) * elastic.green).plus_identity(T(1.0)));
      second = full(commuting_product(metric, total));
    } else {
      const Matrix3<T> inverse_stretch =
          full(exponential_less_identity(T(-1.0) * elastic.strain).plus_identity(T(1.0)));
      second = inverse_stretch * full(total) * inverse_stretch;
    }
    const Matrix3<T> left = elastic.gradient * second;
    return left + left * elastic.trial_plastic_transposed;
  }

  /// Points that had failed before carry nothing and stay as they were; those that fail now give up their elastic energy.
  template <class T>
  Matrix3<T> fail(const Matrix3<T>& f, const State<T>& old, const Matrix3<T>& carried, State<T>& state) const {
    const auto gone = value_of(old.failed) > 0.0;
    Matrix3<T> stress;
    for (int i = 0; i < 9; ++i) {
      stress.component[i] = select(gone, T(0.0), carried.component[i]);
      state.plastic.component[i] = select(gone, old.plastic.component[i], state.plastic.component[i]);
    }
    for (std::size_t i = 0; i < back_stresses.size(); ++i)
      for (int k = 0; k < 6; ++k)
        state.back_stress[i].component[k] = select(gone, old.back_stress[i].component[k], state.back_stress[i].component[k]);
    state.equivalent_plastic_strain = select(gone, old.equivalent_plastic_strain, state.equivalent_plastic_strain);
    const auto fails = value_of(state.equivalent_plastic_strain) >= failure_strain;
    if (any(fails)) {
      const T lost = select(fails, T(elastic_energy(f, state.plastic)), T(0.0));
      state.dissipation = state.dissipation + lost;
    }
    state.dissipation = select(gone, old.dissipation, state.dissipation);
    state.failed = select(fails, T(1.0), old.failed);
    return stress;
  }

  template <class T>
  T elastic_energy(const Matrix3<T>& f, const Matrix3<T>& plastic) const {
    const auto strain = elastic_strain(f, plastic).strain;
    const T volume = trace(strain);
    const auto deviator = strain.plus_identity((-1.0 / 3.0) * volume);
    return 0.5 * bulk * volume * volume + shear * double_contraction(deviator, deviator);
  }

  template <class T>
  struct Elastic {
    Matrix3<T> gradient, trial_plastic_transposed;  // Fe, (Fp^-1 - I)^T
    SymmetricTensor<T> green, strain;               // (Ce - I) / 2, ln(Ce) / 2
  };
  template <class T>
  Elastic<T> elastic_strain(const Matrix3<T>& f, const Matrix3<T>& plastic) const {
    Elastic<T> e;
    e.gradient = f + f * plastic;
    e.trial_plastic_transposed = transpose(plastic);
    e.green = green_strain(e.gradient - Matrix3<T>::identity());
    e.strain = logarithmic_strain(e.green);
    return e;
  }

  /// What is left of the deviator after the back stresses have faded over dp, and its size.
  template <class V>
  struct Relative {
    SymmetricTensor<V> tensor;
    V mises, slope;  // slope of mises against dp
  };
  template <class T, class V>
  Relative<T> relative(const SymmetricTensor<T>& deviator, const State<T>& state, const V& dp) const {
    Relative<T> r{deviator, T(0.0), T(0.0)};
    SymmetricTensor<T> fading;
    for (std::size_t i = 0; i < back_stresses.size(); ++i) {
      const V remaining = back_stresses[i].remaining(dp);
      r.tensor = r.tensor - T(remaining) * state.back_stress[i];
      fading = fading + T(back_stresses[i].recall * remaining) * state.back_stress[i];
    }
    r.mises = square_root(1.5 * double_contraction(r.tensor, r.tensor) + std::numeric_limits<double>::min());
    r.slope = 1.5 * double_contraction(r.tensor, fading) / r.mises;
    return r;
  }

  /// mises(dp) - 3 G dp - growth of the back stresses - flow stress, with its slope: zero at the plastic increment.
  template <class V>
  Sloped<V> residual(const SymmetricTensor<V>& deviator, const State<V>& state, const V& dp, double increment) const {
    const Relative<V> r = relative(deviator, state, dp);
    const Sloped<V> yield = flow(V(state.equivalent_plastic_strain + dp), dp, increment);
    Sloped<V> result{r.mises - (3.0 * shear) * dp - yield.value, r.slope - 3.0 * shear - yield.slope};
    for (const auto& back : back_stresses) {
      const V remaining = back.remaining(dp);
      result.value = result.value - back.growth(dp, remaining);
      result.slope = result.slope - back.modulus * remaining;
    }
    return result;
  }

  template <class T>
  void flow_back(const SymmetricTensor<T>& trial_strain, SymmetricTensor<T>& deviator, State<T>& state,
                 double increment) const;
  /// exp(-dp n), the change of Fp^-1, less the identity; with back stresses, which turn the flow away from the trial
  /// strain E, what leads to the elastic strain E - dp n all the same: exp(-E) exp(E - dp n).
  template <class V>
  Matrix3<V> plastic_step(const SymmetricTensor<V>& trial_strain, const SymmetricTensor<V>& flowed) const {
    if (back_stresses.empty()) return full(exponential_less_identity(V(-1.0) * flowed));
    const Matrix3<V> a = full(exponential_less_identity(V(-1.0) * trial_strain));
    const Matrix3<V> b = full(exponential_less_identity(trial_strain - flowed));
    return a + b + a * b;
  }
};

/// The form of a metal's law. @throws InputError if the options of the material do not fit together
template <PointKind kind>
std::unique_ptr<Law<kind>> make_metal(const Material& material);

namespace j2_detail {

template <class T>
auto values(const SymmetricTensor<T>& a) {
  SymmetricTensor<std::decay_t<decltype(value_of(a.component[0]))>> r;
  for (int i = 0; i < 6; ++i) r.component[i] = value_of(a.component[i]);
  return r;
}

}  // namespace j2_detail

template <class T>
void J2Plasticity::flow_back(const SymmetricTensor<T>& trial_strain, SymmetricTensor<T>& deviator, State<T>& state,
                             double increment) const {
  using V = std::decay_t<decltype(value_of(state.dissipation))>;
  const auto trial = relative(deviator, state, V(0.0));
  State<V> old;
  old.equivalent_plastic_strain = value_of(state.equivalent_plastic_strain);
  for (std::size_t i = 0; i < back_stresses.size(); ++i) old.back_stress[i] = j2_detail::values(state.back_stress[i]);
  const V trial_mises = value_of(trial.mises);
  const auto yields = trial_mises > flow.yield_stress(old.equivalent_plastic_strain);
  if (!any(yields)) return;

  const SymmetricTensor<V> fixed = j2_detail::values(deviator);
  const auto open_stress = [&](const V& dp) { return residual(fixed, old, dp, increment); };
  const V dp = select(yields, plastic_increment(flow, old.equivalent_plastic_strain, increment, trial_mises, 3.0 * shear, yields, open_stress),
                      V(0.0));
  // One step of Newton's method with duals at the root gives dp its exact derivative; for plain scalars it adds zero.
  const T mises = relative(deviator, state, dp).mises;
  const V slope = residual(fixed, old, dp, increment).slope;
  const T flowed = select(yields, T(dp) - (mises - T(value_of(mises))) / T(slope), T(0.0));
  const auto r = relative(deviator, state, flowed);

  // n = 3/2 relative / mises; everything that grows along the flow is parallel to it.
  const SymmetricTensor<T> unit = (1.0 / r.mises) * r.tensor;
  const V before = flow(old.equivalent_plastic_strain, dp, increment).value;
  const V after = flow(V(old.equivalent_plastic_strain + dp), dp, increment).value;
  T along = T(V(0.5 * (before + after)));
  for (std::size_t i = 0; i < back_stresses.size(); ++i) {
    const T remaining = back_stresses[i].remaining(flowed);
    const T growth = back_stresses[i].growth(flowed, remaining);
    const SymmetricTensor<T> next = remaining * state.back_stress[i] + growth * unit;
    along = along + 0.75 * double_contraction(state.back_stress[i] + next, unit);
    for (int k = 0; k < 6; ++k)
      state.back_stress[i].component[k] = select(yields, next.component[k], state.back_stress[i].component[k]);
  }
  deviator = deviator - (3.0 * shear * flowed) * unit;
  state.dissipation = state.dissipation + flowed * along;
  state.equivalent_plastic_strain = state.equivalent_plastic_strain + flowed;

  Matrix3<T> step = plastic_step(trial_strain, (1.5 * flowed) * unit);
  for (int i = 0; i < 9; ++i) step.component[i] = select(yields, step.component[i], T(0.0));
  state.plastic = state.plastic + step + state.plastic * step;
}

}  // namespace balocco
