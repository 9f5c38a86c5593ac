// *VISCOELASTIC, TIME=PRONY: finite linear viscoelasticity of the deviatoric stress on any elastic solid law (Simo,
// Comput. Meth. Appl. Mech. Eng. 60, 1987; Simo & Hughes, Computational Inelasticity, 1998, sec. 10.3).
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "materials/condensation.hpp"
#include "materials/law_of.hpp"
#include "materials/stretch.hpp"
#include "math/inverse_cube_root.hpp"
#include "math/symmetric_tensor.hpp"

namespace balocco {

/// A term of the series: relative modulus and relaxation time.
struct PronyTerm {
  double share = 0.0, time = 0.0;
};

/// The terms of a material, empty without *VISCOELASTIC. @throws InputError if the shares leave nothing in the long term
std::vector<PronyTerm> prony_terms(const Material& material);

/// What an increment of length dt does to a branch of relaxation time t, with x = dt / t.
struct BranchDecay {
  double left = 1.0;      // exp(-x)
  double mean = 1.0;      // m = (1 - exp(-x)) / x
  double work = 0.5;      // (1 - m) / x
  double heat = 0.0;      // (1 - m) / x - m^2 / 2

  static BranchDecay over(double x) {
    if (!(x > 0.0)) return {};
    const double lost = -std::expm1(-x), mean = lost / x;
    if (x < 1e-2) {
      const double heat = x * (1.0 / 3.0 - x * (1.0 / 4.0 - x * (7.0 / 60.0 - x * (1.0 / 24.0 - x * (31.0 / 2520.0)))));
      return {1.0 - lost, mean, heat + 0.5 * mean * mean, heat};
    }
    return {1.0 - lost, mean, (1.0 - mean) / x, (1.0 - mean) / x - 0.5 * mean * mean};
  }
};

/// With the deviatoric Kirchhoff stress s0 of the instantaneous law, S0 = J^2/3 F^-1 s0 F^-T and terms g, t:
///   h_new = exp(-dt/t) h + g (1 - exp(-dt/t)) t/dt (S0_new - S0),  S = (1 - sum g) S0 + sum h,  s = dev(F S F^T) J^-2/3.
/// The pressure does not relax. The solid's energy must be the sum of one of the volume and one of the isochoric deformation: the deviatoric
/// stress of another is no gradient of an energy, so that what scales it or lets it relax would do work in closed loops.
/// Each branch keeps its energy e, which goes where its stress goes: e' = h : E' - 2 e / t with the isochoric strain E, integrated for the
/// h above and straight E. At small strain that is |h|^2 / (4 G g); where nothing relaxes it is g times the solid's isochoric energy.
template <class Solid>
struct Viscoelastic {
  static constexpr int most_terms = 6;
  Solid solid;
  std::vector<PronyTerm> terms;
  double scale = 1.0;   // instantaneous over given deviatoric stress

  static Viscoelastic of(const Material& material, const Solid& solid, bool instantaneous) {
    Viscoelastic law{solid, prony_terms(material)};
    if (!instantaneous) law.scale = 1.0 / law.long_term();
    return law;
  }

  template <class T>
  struct State {
    SymmetricTensor<T> elastic{};  // S0
    SymmetricTensor<T> strain{};   // (Cbar - I) / 2, Cbar = J^-2/3 C
    std::array<SymmetricTensor<T>, most_terms> branch{};
    std::array<T, most_terms> stored{};  // energy of each branch
    T dissipation = T(0.0);
  };
  template <class S, class Visit>
  void fields(S& state, Visit&& visit) const {
    visit("INSTANTANEOUS STRESS", state.elastic.component);
    visit("ISOCHORIC STRAIN", state.strain.component);
    for (std::size_t i = 0; i < terms.size(); ++i) visit("BRANCH STRESS", state.branch[i].component);
    const auto stored = std::span(state.stored).first(terms.size());
    visit("BRANCH ENERGIES", stored);
    visit("VISCOUS DISSIPATION", state.dissipation);
  }

  template <class T>
  Matrix3<T> stress(const Matrix3<T>& f, State<T>& state, double increment) const {
    const Matrix3<T> cof = cofactor(f);
    const T jacobian = determinant(f, cof), inverse = 1.0 / jacobian;
    const Matrix3<T> inverse_transposed = inverse * cof;
    const SymmetricTensor<T> kirchhoff = symmetric_part(solid.stress(f) * transpose(f));
    const T pressure = (1.0 / 3.0) * trace(kirchhoff);
    const T root = inverse_cube_root(jacobian), square = root * root;  // J^-1/3, J^-2/3
    const SymmetricTensor<T> deviator = T(scale) * kirchhoff.plus_identity(-pressure);
    const SymmetricTensor<T> elastic =
        T(1.0 / square) * symmetric_part(transpose(inverse_transposed) * full(deviator) * inverse_transposed);

    SymmetricTensor<T> total = T(long_term()) * elastic;
    const SymmetricTensor<T> change = elastic - state.elastic;
    const SymmetricTensor<T> strain = green_strain(root * f - Matrix3<T>::identity()), stretching = strain - state.strain;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const BranchDecay decay = BranchDecay::over(increment / terms[i].time);
      const SymmetricTensor<T> old = state.branch[i], gained = T(terms[i].share) * change;
      state.branch[i] = T(decay.left) * old + T(decay.mean) * gained;
      total = total + state.branch[i];
      const T by_old = double_contraction(old, stretching), by_gain = double_contraction(gained, stretching);
      const T work = decay.mean * by_old + decay.work * by_gain;
      const double lost = 1.0 - decay.left;
      const T heat = maximum(lost * ((1.0 + decay.left) * state.stored[i] + decay.mean * by_old) + decay.heat * by_gain, T(0.0));
      state.stored[i] = state.stored[i] + (work - heat);
      state.dissipation = state.dissipation + heat;
    }
    state.elastic = elastic;
    state.strain = strain;
    const SymmetricTensor<T> pushed = square * symmetric_part(f * full(total) * transpose(f));
    return full(pushed.plus_identity(pressure - (1.0 / 3.0) * trace(pushed))) * inverse_transposed;
  }

  /// That of the instantaneous law, with the stresses that lag behind it.
  template <class T>
  TangentBound<T> bound(const Matrix3<T>& f, const Matrix3<T>& piola) const {
    const Invariants<T> c = invariants(f);
    const TangentBound<T> elastic = solid.bound(f);
    const T inverse_square = 1.0 / (c.jacobian * c.jacobian);
    const T n2 = largest_eigenvalue_bound(c.second * inverse_square, c.first * inverse_square);
    const T size = square_root(double_contraction(piola, piola) * largest_eigenvalue_bound(c.first, c.second));
    return {elastic.volumetric * scale, elastic.shear * scale + 1.5 * (size * n2)};
  }

  EnergyDensity energy(const Matrix3<double>& f, const State<double>& state) const {
    const double jacobian = determinant(f, cofactor(f)), root = std::cbrt(jacobian);
    const double volumetric = solid.energy(root * Matrix3<double>::identity());
    EnergyDensity e{volumetric + long_term() * scale * (solid.energy(f) - volumetric), 0.0, state.dissipation};
    for (std::size_t i = 0; i < terms.size(); ++i) e.recoverable += state.stored[i];
    return e;
  }

 private:
  double long_term() const {
    double rest = 1.0;
    for (const PronyTerm& term : terms) rest -= term.share;
    return rest;
  }
};

/// Any form of a solid law.
template <PointKind kind, class Solid>
std::unique_ptr<Law<kind>> make_form(const Solid& solid) {
  if constexpr (kind == PointKind::solid)
    return make_solid_law(solid);
  else
    return make_condensed_law<kind>(solid);
}

/// Whether a material relaxes.
bool relaxes(const Material& material);

}  // namespace balocco
