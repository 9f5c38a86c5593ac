// Reference data of one C3D8R: what the kernel reads for an element and nothing else (39 to 59 doubles).
#pragma once

#include <array>
#include <optional>

#include "elements/solids/hexahedron.hpp"
#include "elements/solids/solid_reference.hpp"
#include "model/model.hpp"

namespace balocco {

/// What resists the hourglass modes of a group, told by its record.
enum class BrickHourglass {
  scalar,       // HOURGLASS=STIFFNESS: one number
  isotropic,    // the moduli below by fewer numbers (IsotropicShape): 3 classes x 3, then 3 of mode 7
  anisotropic,  // 3 classes x (11 12 13 22 23 33), then 3 of mode 7
  flowing       // of metals (reduced_brick_flow.hpp): C_1 .. C_3
};

/// Where each quantity lies in an element's record.
namespace brick_record {
inline constexpr int mean_gradient = 0;     // beta_k, 7 x 3
inline constexpr int hourglass_map = 21;    // C_4 .. C_7, 4 x 3: q_a = c_(3+a) - F C_(3+a)
inline constexpr int volume = 33;
inline constexpr int length = 34;           // L = 2 / sqrt(largest eigenvalue of sum beta beta^T): the shortest side of a box
inline constexpr int gradient_bound = 35;   // that eigenvalue
inline constexpr int hourglass_bound = 36;  // largest eigenvalue of the hourglass stiffness on q, per volume; metals:
                                            // times 1 / gradient_bound of any shape
inline constexpr int overlap = 37;          // cos^2 of the angle between uniform strains and hourglass modes (0: parallelepiped)
inline constexpr int stiffness = 38;        // as BrickHourglass says
inline constexpr int full_stiffness = 21;   // numbers of an anisotropic one
inline constexpr int most = stiffness + full_stiffness;
constexpr int size(BrickHourglass kind) {
  using enum BrickHourglass;
  return stiffness + (kind == scalar ? 1 : kind == isotropic ? 12 : kind == flowing ? 9 : full_stiffness);
}
}  // namespace brick_record

/// Poisson's ratio of a material that is isotropic about the undeformed state; none: it is not.
std::optional<double> isotropic_poisson_ratio(const SolidMaterial& material);

/// The record of an element. The hourglass stiffness acts on the natural components c_i . q_a (i = 1 .. 3), which no
/// rotation changes: Green strains that vary linearly over the element,
///   zeta: E11 = q2.c1, E22 = q1.c2, 2 E12 = q1.c1 + q2.c2;   eta: E11 = q3.c1, E33 = q1.c3, 2 E13 = q1.c1 + q3.c3;
///   xi:   E22 = q3.c2, E33 = q2.c3, 2 E23 = q2.c2 + q3.c3    (q1 .. q4: modes eta zeta, xi zeta, xi eta, xi eta zeta).
/// In each class the three other strains are enhanced, that is free of stress: no shear locking, no volumetric locking.
/// Their energy is V/3 times the initial moduli, condensed so, in the element's own (skew) axes C_1, C_2, C_3; mode xi
/// eta zeta gets V/9 times the uniaxial modulus along each axis. Bending of a rectangular brick is exact for a beam or
/// a plate. An element that flows keeps C_1, C_2, C_3 and computes its stiffness from them.
std::array<double, brick_record::most> reduced_brick_record(const HexahedronGeometry& geometry, const SolidMaterial& material,
                                                            const Section& section, BrickHourglass kind);

}  // namespace balocco
