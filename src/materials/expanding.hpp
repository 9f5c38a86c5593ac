// Laws of matter that expands with temperature (*EXPANSION).
#pragma once

#include <memory>

#include "materials/material_law.hpp"

namespace balocco {

/// The law with an isotropic thermal strain eps: the deformation gradient is split into F = F_mech * theta 1 with theta = 1 + eps, and the
/// energy of the law, by volume of what has expanded, depends on F_mech alone: W(F) = theta^3 W_law(F / theta) (S. C. H. Lu and
/// K. S. Pister, Int. J. Solids Struct. 11, 1975). The Cauchy stress is what the law gives for F_mech. Of first order, about the undeformed
/// state, eps is a second Piola-Kirchhoff stress -eps D : 1 with the law's tangent D there; as of any initial stress, linear steps leave out
/// what it stiffens (elements/initial_stress_rows.hpp).
///
/// Five history fields behind the law's own, of which the solver sets the first two: "THE", eps; "THE LINEAR", 1 where it is of first
/// order; "THE DONE", eps up to which the state has followed; "THE FORCE", dW/d(eps) there; "THE WORK", the work of heat
/// (EnergyDensity::heat) by the trapezoidal rule.
template <PointKind kind>
std::unique_ptr<Law<kind>> expanding(std::unique_ptr<Law<kind>> law);

}  // namespace balocco
