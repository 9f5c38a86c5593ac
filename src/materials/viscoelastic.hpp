// *VISCOELASTIC, TIME=PRONY: finite linear viscoelasticity of the deviatoric stress on any elastic solid law (Simo,
// Comput. Meth. Appl. Mech. Eng. 60, 1987; Simo & Hughes, Computational Inelasticity, 1998, sec. 10.3).
#pragma once

#include <cmath>
#include <limits>
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

/// With the deviatoric Kirchhoff stress s0 of the instantaneous law, S0 = J^2/3 F^-1 s0 F^-T and terms g, t:
///   h_new = exp(-dt/t) h + g (1 - exp(-dt/t)) t/dt (S0_new - S0),  S = (1 - sum g) S0 + sum h,  s = dev(F S F^T) J^-2/3.
/// The pressure does not relax.
template <class Solid>
struct Viscoelastic {
  static constexpr int most_terms = 6;
  Solid solid;
  std::vector<PronyTerm> terms;
  double scale = 1.0;   // instantaneous over given deviatoric stress
  double shear = 1.0;   // instantaneous initial shear modulus

  static Viscoelastic of(const Material& material, const Solid& solid, double shear, bool instantaneous) {
    Viscoelastic law{solid, prony_terms(material)};
    if (!instantaneous) law.scale = 1.0 / law.long_term();
    law.shear = law.scale * shear;
    return law;
  }

  template <class T>
  struct State {
    SymmetricTensor<T> elastic{};  // S0
    SymmetricTensor<T> strain{};   // (Cbar - I) / 2, Cbar = J^-2/3 C
    std::array<SymmetricTensor<T>, most_terms> branch{};
    T dissipation = T(0.0);
  };
  template <class S, class Visit>
  void fields(S& state, Visit&& visit) const {
    visit("INSTANTANEOUS STRESS", state.elastic.component);
    visit("ISOCHORIC STRAIN", state.strain.component);
    for (std::size_t i = 0; i < terms.size(); ++i) visit("BRANCH STRESS", state.branch[i].component);
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
      const double x = increment / terms[i].time, decay = std::exp(-x);
      const double gain = x > 0.0 ? terms[i].share * (-std::expm1(-x) / x) : terms[i].share;
      const SymmetricTensor<T> old = state.branch[i];
      state.branch[i] = T(decay) * old + T(gain) * change;
      total = total + state.branch[i];
      // Work on the branch, s : d = h : d(Cbar) / 2, less what it stores, |h|^2 / (4 G g) as at small strain.
      const T work = 0.5 * double_contraction(old + state.branch[i], stretching);
      const T stored = (1.0 / (4.0 * shear * terms[i].share)) * (double_contraction(state.branch[i], state.branch[i]) -
                                                                 double_contraction(old, old));
      state.dissipation = state.dissipation + (work - stored);
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
    for (std::size_t i = 0; i < terms.size(); ++i)
      e.recoverable += double_contraction(state.branch[i], state.branch[i]) / (4.0 * shear * terms[i].share);
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
