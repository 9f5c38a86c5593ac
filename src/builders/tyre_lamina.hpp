// A ply of parallel cords in rubber as an orthotropic lamina.
//
// The cord's tension-compression asymmetry (twisted cords buckle) is out of scope: the lamina is linear, with the
// tensile modulus.
#pragma once

#include "builders/tyre_spec.hpp"

namespace balocco {

/// Direction 1 runs along the cords. MPa, g/mm3.
struct Lamina {
  double modulus_1 = 0.0, modulus_2 = 0.0;
  double poisson_12 = 0.0;
  double shear_12 = 0.0, shear_23 = 0.0;
  double density = 0.0;
  double cord_fraction = 0.0;  // of the volume
};

/// E1, nu12 and density by the rule of mixtures, E2 and G12 by the equations of Halpin and Tsai with their usual
/// factors 2 and 1 (Jones, Mechanics of Composite Materials, section 3.5). Without cords: the rubber itself at small
/// strain.
Lamina make_lamina(const PlySpec& ply, const TyreSpec& spec);

/// The ply at a radius given as a share of the crown's: the spacing of gathering cords shrinks with it.
PlySpec ply_at(PlySpec ply, double radius_ratio);

/// Membrane stiffness of stacked plies, N/mm: along the circumference and along the meridian, transverse strain held,
/// at a radius as in ply_at.
struct LaminateStiffness {
  double circumferential = 0.0, meridional = 0.0;
};
LaminateStiffness laminate_stiffness(const std::vector<int>& plies, const TyreSpec& spec, double radius_ratio);

}  // namespace balocco
