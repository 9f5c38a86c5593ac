// J2 plasticity with isotropic hardening in plane stress, in closed form but for one scalar equation (Simo & Taylor, Int. J. Numer.
// Meth. Eng. 22, 1986, in logarithmic strains): what Condensed<plane, J2Plasticity> finds by iterating over the thickness.
//
// With C = 1 + 2 E and A = Fp^-1 the trial Ce = A^T C A = m 1 + D, D without trace, D D = d^2 1; Ce and all that flows from it
// share their axes, so that every tensor is a 1 + b D and no eigenvector is needed: ln Ce = ln(m^2 - d^2) / 2 1 + atanh(d / m) / d D.
// Kirchhoff's stresses p = t11 + t22 and q = (t11 - t22, 2 t12) follow the sum of the elastic strains by E / (1 - nu) and their
// difference by 2 G; mises^2 = p^2 / 4 + 3 q^2 / 4, and flow by dp at mises s takes p to p / (1 + E / (1 - nu) dp / 2s), q to
// q / (1 + 3 G dp / s).
#pragma once

#include <array>

#include "materials/condensation.hpp"
#include "materials/even_functions.hpp"
#include "materials/j2_plasticity.hpp"

namespace balocco {

struct J2PlaneStress {
  static constexpr bool compiled_whole = true;  // law_of.hpp
  Condensed<PointKind::plane, J2Plasticity> general;  // bounds by it; its solid has the parameters

  /// The solid must have no back stresses: they turn the flow away from the trial's axes.
  explicit J2PlaneStress(const J2Plasticity& solid) : general{solid, 0.0} {
    const double young = 9.0 * solid.bulk * solid.shear / (3.0 * solid.bulk + solid.shear);
    poisson_ = 0.5 * young / solid.shear - 1.0;
    sum_modulus_ = young / (1.0 - poisson_);
  }

  template <class T>
  struct State {
    std::array<T, 4> plastic{};  // Fp^-1 - 1 in the plane: 11 12 21 22
    T equivalent_plastic_strain = T(0.0), dissipation = T(0.0), failed = T(0.0);
  };
  template <class S, class Visit>
  void fields(S& state, Visit&& visit) const {
    visit("FP IN PLANE", state.plastic);
    visit("PEEQ", state.equivalent_plastic_strain);
    visit("PLASTIC DISSIPATION", state.dissipation);
    if (general.solid.failure_strain > 0.0) visit("FAILED", state.failed);
  }

  template <class T>
  std::array<T, 3> stress(const std::array<T, 3>& strain, State<T>& state, double increment) const {
    const Trial<T> trial = trial_of(strain, state.plastic);
    Flowed<T> now{sum_modulus_ * trial.sum, (2.0 * general.solid.shear) * trial.slope};
    const State<T> old = state;
    const FlowStress& flow = general.solid.flow;
    if (increment != 0.0 || !flow.depends_on_rate()) flow_back(trial, now, state, increment);
    std::array<T, 3> s = second_piola(trial, now, old.plastic);
    if (general.solid.failure_strain > 0.0) fail(strain, old, state, s);
    return s;
  }

  template <class T>
  T bound(const std::array<T, 3>& strain, const std::array<T, 3>& stress, const State<T>& state) const {
    // A thicker point has a greater bound, and exp(x) <= 1 + x + x^2 for the elastic part of ln C33; S : C is Kirchhoff's trace.
    const T trace = stress[0] * (1.0 + 2.0 * strain[0]) + stress[1] * (1.0 + 2.0 * strain[1]) + 2.0 * (stress[2] * strain[2]);
    const T elastic = (-2.0 * poisson_ / ((1.0 - poisson_) * sum_modulus_)) * trace, plastic = plastic_thickness(state.plastic);
    typename decltype(general)::template State<T> thick;
    thick.free[0] = plastic * plastic * (1.0 + elastic + elastic * elastic) - 1.0;
    return general.bound(strain, stress, thick);
  }

  EnergyDensity energy(const std::array<double, 3>& strain, const State<double>& state) const {
    return {state.failed > 0.0 ? 0.0 : elastic_energy(trial_of(strain, state.plastic)), state.dissipation, 0.0};
  }
  double transverse_stretch(const std::array<double, 3>& strain, const State<double>& state) const {
    return transverse(trial_of(strain, state.plastic), state.plastic);
  }

 private:
  /// Ce = m 1 + D with its logarithm: e11 + e22 = sum, (e11 - e22, 2 e12) = slope (D11, D12).
  template <class T>
  struct Trial {
    T mean, difference, twice_shear;  // m, D11 = -D22, D12
    T square, determinant;            // d^2, m^2 - d^2
    T sum, slope;
  };
  /// p, and q = slope (D11, D12).
  template <class T>
  struct Flowed {
    T sum, slope;
  };

  template <class T>
  static Trial<T> trial_of(const std::array<T, 3>& e, const std::array<T, 4>& p) {
    const T a11 = 1.0 + p[0], a22 = 1.0 + p[3];
    const T b11 = e[0] * a11 + 0.5 * (e[2] * p[2]), b12 = e[0] * p[1] + 0.5 * (e[2] * a22);  // E A
    const T b21 = 0.5 * (e[2] * a11) + e[1] * p[2], b22 = 0.5 * (e[2] * p[1]) + e[1] * a22;
    // (Ce - 1) / 2 = A^T E A + (P + P^T + P^T P) / 2
    const T g11 = a11 * b11 + p[2] * b21 + (p[0] + 0.5 * (p[0] * p[0] + p[2] * p[2]));
    const T g22 = p[1] * b12 + a22 * b22 + (p[3] + 0.5 * (p[1] * p[1] + p[3] * p[3]));
    const T g12 = a11 * b12 + p[2] * b22 + 0.5 * (p[1] + p[2] + p[0] * p[1] + p[2] * p[3]);
    Trial<T> t;
    t.mean = 1.0 + (g11 + g22);
    t.difference = g11 - g22;
    t.twice_shear = 2.0 * g12;
    t.square = t.difference * t.difference + t.twice_shear * t.twice_shear;
    t.determinant = t.mean * t.mean - t.square;
    t.sum = 0.5 * smooth_logarithm(t.determinant);
    t.slope = inverse_hyperbolic_tangent_ratio(T(t.square / (t.mean * t.mean))) / t.mean;
    return t;
  }

  template <class T>
  void flow_back(const Trial<T>& trial, Flowed<T>& now, State<T>& state, double increment) const {
    using V = std::decay_t<decltype(value_of(state.dissipation))>;
    const FlowStress& flow = general.solid.flow;
    const T size = square_root(trial.square + std::numeric_limits<double>::min());
    const T across = now.slope * size;  // |q|
    const auto mises_of = [](const auto& p, const auto& q) { return square_root(0.25 * (p * p) + 0.75 * (q * q)); };
    const V p = value_of(now.sum), q = value_of(across), before = value_of(state.equivalent_plastic_strain);
    const V trial_mises = mises_of(p, q);
    const auto yields = trial_mises > flow.yield_stress(before);
    if (!any(yields)) return;

    const double along = 0.5 * sum_modulus_, sideways = 3.0 * general.solid.shear;
    const auto residual = [&](const V& dp) {
      const Sloped<V> yield = flow(V(before + dp), dp, increment);
      const V share = dp / yield.value, rise = (1.0 - share * yield.slope) / yield.value;
      const V fewer_p = 1.0 / (1.0 + along * share), fewer_q = 1.0 / (1.0 + sideways * share);
      const V flowed_p = p * fewer_p, flowed_q = q * fewer_q, mises = mises_of(flowed_p, flowed_q);
      const V slope = (0.25 * along) * (flowed_p * flowed_p * fewer_p) + (0.75 * sideways) * (flowed_q * flowed_q * fewer_q);
      return Sloped<V>{mises - yield.value, -(slope * rise) / maximum(mises, V(std::numeric_limits<double>::min())) - yield.slope};
    };
    const double stiffness = along < sideways ? along : sideways;
    const V dp = select(yields, plastic_increment(flow, before, increment, trial_mises, stiffness, yields, residual), V(0.0));

    // One step of Newton's method with duals at the root gives dp its exact derivative; for plain scalars it adds zero.
    const Sloped<V> yield = flow(V(before + dp), dp, increment);
    const V share_value = dp / yield.value;
    const T mises = mises_of(T(now.sum * T(1.0 / (1.0 + along * share_value))), T(across * T(1.0 / (1.0 + sideways * share_value))));
    const T flowed = select(yields, T(dp) - (mises - T(value_of(mises))) / T(residual(dp).slope), T(0.0));
    const T change = flowed - T(value_of(flowed));
    const T share = (T(dp) + change) / (T(yield.value) + T(yield.slope) * change);
    now.sum = select(yields, now.sum / (1.0 + along * share), now.sum);
    now.slope = select(yields, now.slope / (1.0 + sideways * share), now.slope);

    const V dissipated = 0.5 * (flow(before, dp, increment).value + yield.value);
    state.dissipation = state.dissipation + flowed * T(dissipated);
    state.equivalent_plastic_strain = state.equivalent_plastic_strain + flowed;
    const V sum = 0.5 * share_value * value_of(now.sum), slope = 1.5 * share_value * value_of(now.slope);
    turn_plastic(trial, V(select(yields, sum, V(0.0))), V(select(yields, slope, V(0.0))), state);
  }

  /// Fp^-1 <- Fp^-1 exp(-dp n), whose plastic strains have the sum `sum` and the differences `slope` (D11, D12). Nothing takes
  /// derivatives of the new state.
  template <class T, class V>
  static void turn_plastic(const Trial<T>& trial, const V& sum, const V& slope, State<T>& state) {
    const V half = 0.5 * slope, square = half * half * value_of(trial.square);
    const V shrink = exponential(V(-0.5 * sum)), even = shrink * hyperbolic_cosine_of_root(square) - 1.0;
    const V odd = -(shrink * half) * hyperbolic_sine_ratio_of_root(square);
    const V s11 = even + odd * value_of(trial.difference), s22 = even - odd * value_of(trial.difference);
    const V s12 = odd * value_of(trial.twice_shear);
    auto& p = state.plastic;
    const T p11 = p[0] + (1.0 + p[0]) * T(s11) + p[1] * T(s12), p12 = p[1] + (1.0 + p[0]) * T(s12) + p[1] * T(s22);
    const T p21 = p[2] + p[2] * T(s11) + (1.0 + p[3]) * T(s12), p22 = p[3] + p[2] * T(s12) + (1.0 + p[3]) * T(s22);
    p = {p11, p12, p21, p22};
  }

  /// S = A Ce^-1 t A^T with A = Fp^-1 of the trial: flow does not change the elastic rotation.
  template <class T>
  static std::array<T, 3> second_piola(const Trial<T>& trial, const Flowed<T>& now, const std::array<T, 4>& p) {
    const T half = 0.5 / trial.determinant;
    const T mean = half * (trial.mean * now.sum - now.slope * trial.square), slope = half * (trial.mean * now.slope - now.sum);
    const T m11 = mean + slope * trial.difference, m22 = mean - slope * trial.difference, m12 = slope * trial.twice_shear;
    const T a11 = 1.0 + p[0], a22 = 1.0 + p[3];
    const T b11 = a11 * m11 + p[1] * m12, b12 = a11 * m12 + p[1] * m22, b21 = p[2] * m11 + a22 * m12, b22 = p[2] * m12 + a22 * m22;
    return {b11 * a11 + b12 * p[1], b21 * p[2] + b22 * a22, b11 * p[2] + b12 * a22};
  }

  /// F33 of a plane whose third stress vanishes and whose plastic flow keeps the volume.
  template <class T>
  T transverse(const Trial<T>& trial, const std::array<T, 4>& p) const {
    return exponential(T((-poisson_ / (1.0 - poisson_)) * trial.sum)) * plastic_thickness(p);
  }
  template <class T>
  static T plastic_thickness(const std::array<T, 4>& p) {
    return (1.0 + p[0]) * (1.0 + p[3]) - p[1] * p[2];
  }

  template <class T>
  T elastic_energy(const Trial<T>& trial) const {
    return 0.25 * (sum_modulus_ * trial.sum * trial.sum + (2.0 * general.solid.shear) * trial.slope * trial.slope * trial.square);
  }

  /// As J2Plasticity: points that had failed before carry nothing; those that fail now give up their elastic energy.
  template <class T>
  void fail(const std::array<T, 3>& strain, const State<T>& old, State<T>& state, std::array<T, 3>& stress) const {
    const auto gone = value_of(old.failed) > 0.0;
    for (T& component : stress) component = select(gone, T(0.0), component);
    for (int i = 0; i < 4; ++i) state.plastic[i] = select(gone, old.plastic[i], state.plastic[i]);
    state.equivalent_plastic_strain = select(gone, old.equivalent_plastic_strain, state.equivalent_plastic_strain);
    const auto fails = value_of(state.equivalent_plastic_strain) >= general.solid.failure_strain;
    if (any(fails))
      state.dissipation = state.dissipation + select(fails, elastic_energy(trial_of(strain, state.plastic)), T(0.0));
    state.dissipation = select(gone, old.dissipation, state.dissipation);
    state.failed = select(fails, T(1.0), old.failed);
  }

  double poisson_ = 0.0, sum_modulus_ = 0.0;  // E / (1 - nu)
};

}  // namespace balocco
