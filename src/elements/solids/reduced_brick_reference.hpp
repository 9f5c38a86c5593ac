// Reference data of one C3D8R: what the kernel reads for an element and nothing else (59 doubles).
#pragma once

#include <array>
#include <span>

#include "elements/solids/hexahedron.hpp"
#include "elements/solids/solid_reference.hpp"
#include "model/model.hpp"

namespace balocco {

/// Where each quantity lies in an element's record.
namespace brick_record {
inline constexpr int mean_gradient = 0;   // beta_k, 7 x 3
inline constexpr int hourglass_map = 21;  // C_4 .. C_7, 4 x 3: q_a = c_(3+a) - F C_(3+a)
inline constexpr int stiffness =
    33;  // 3 classes x (11 12 13 22 23 33), then 3 of mode 7; stiffness control: one number; metals: C_1 .. C_3
inline constexpr int volume = 54;
inline constexpr int length = 55;  // L = 2 / sqrt(largest eigenvalue of sum beta beta^T): the shortest side of a box
inline constexpr int gradient_bound = 56;   // that eigenvalue
inline constexpr int hourglass_bound = 57;  // largest eigenvalue of the hourglass stiffness on q, per volume; metals:
                                            // times 1 / gradient_bound of any shape
inline constexpr int overlap =
    58;  // cos^2 of the angle between uniform strains and hourglass modes (0: parallelepiped)
inline constexpr int size = 59;
}  // namespace brick_record

/// The record of an element. The hourglass stiffness acts on the natural components c_i . q_a (i = 1 .. 3), which no
/// rotation changes: Green strains that vary linearly over the element,
///   zeta: E11 = q2.c1, E22 = q1.c2, 2 E12 = q1.c1 + q2.c2;   eta: E11 = q3.c1, E33 = q1.c3, 2 E13 = q1.c1 + q3.c3;
///   xi:   E22 = q3.c2, E33 = q2.c3, 2 E23 = q2.c2 + q3.c3    (q1 .. q4: modes eta zeta, xi zeta, xi eta, xi eta zeta).
/// In each class the three other strains are enhanced, that is free of stress: no shear locking, no volumetric locking.
/// Their energy is V/3 times the initial moduli, condensed so, in the element's own (skew) axes C_1, C_2, C_3; mode xi
/// eta zeta gets V/9 times the uniaxial modulus along each axis. Bending of a rectangular brick is exact for a beam or
/// a plate. An element that `flows` (reduced_brick_flow.hpp) keeps C_1, C_2, C_3 and computes its stiffness from them.
std::array<double, brick_record::size> reduced_brick_record(const HexahedronGeometry& geometry, const SolidMaterial& material,
                                                            const Section& section, bool flows);

}  // namespace balocco
