// Laws that yield, and whose undeformed state is not free of stress: the stress counts for their yielding.
#pragma once

#include <memory>

#include "materials/material_law.hpp"

namespace balocco {

/// The law, beginning with an elastic strain E0 that it takes to have a stress S0 at rest, which is the Cauchy stress there:
///   solids: P = P_law(F F0) F0 / det F0 with F0 = 1 + E0 symmetric, as of matter that another deformation has brought there (energy
///   W_law(F F0) / det F0 of a volume); others: S = S_law(E + E0).
/// A stress beyond yield stands by the plastic strain with which the law hardens so far; where it does not, matter begins with the strain
/// of the stiffness at rest, and flows.
/// Behind the law's own history come "S0" (initial_stress_size components), as a stress of the material directions, and "E0", which is
/// found when the law is asked first.
template <PointKind kind>
std::unique_ptr<Law<kind>> initially_strained(std::unique_ptr<Law<kind>> law);

/// Components of an initial stress: solids 11 22 33 12 13 23, plane 11 22 12, line 11, fibre 11 12.
constexpr int initial_stress_size(PointKind kind) { return kind == PointKind::solid ? 6 : strain_size(kind); }

/// Which of them is component ij of a solid's.
inline constexpr int initial_stress_component[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};

}  // namespace balocco
