// Fills the reference data that the membrane kernels read (MembraneLayout) from geometry and section.
#pragma once

#include "elements/membranes/membrane_geometry.hpp"
#include "elements/membranes/membrane_kernel.hpp"
#include "sections/membrane_section.hpp"

namespace balocco {

struct HourglassOptions {
  HourglassControl control = HourglassControl::enhanced;
  double scale = 1.0;
};

/// Writes component c of one element to reference[c * pack_size].
///
/// Hourglass stiffness of the one-point quadrilateral. enhanced: in the element's own axes, that of assumed-strain bending with
/// the material's Young's modulus E along each axis (for a rectangle of length a along the axis E V / (12 a^2) of q^2 / 2, exact for
/// bending in its plane; Belytschko & Bindeman, Comput. Methods Appl. Mech. Eng. 88, 1991); along the normal 0.005 of the shear
/// modulus. stiffness: 0.005 of the shear modulus in every direction.
template <int nodes, int points>
void fill_membrane_reference(const MembraneGeometry& geometry, const MembraneSection& section,
                             const HourglassOptions& hourglass, double* reference);

}  // namespace balocco
