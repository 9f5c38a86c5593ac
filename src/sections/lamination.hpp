// Classical lamination theory for membranes: the plane stiffness of a stack of plies, and the law of its equivalent sheet.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "materials/material_law.hpp"
#include "model/model.hpp"

namespace balocco {

/// Stiffness of a plane point, row-major 3 x 3: (S11, S22, S12) = Q (E11, E22, 2E12).
using PlaneStiffness = std::array<double, 9>;

/// Q of a ply seen from axes from which the ply's first direction is turned by `angle` (radians, about the normal).
PlaneStiffness rotated_stiffness(const PlaneStiffness& ply, double angle);

/// Inverse of a plane stiffness: moduli along the axes are E1 = 1 / S[0], E2 = 1 / S[4], G12 = 1 / S[8].
PlaneStiffness compliance(const PlaneStiffness& stiffness);

/// Largest eigenvalue of a stiffness in the tensor norm, E : C : E <= value * (E11^2 + E22^2 + 2 E12^2).
double greatest_modulus(const PlaneStiffness& stiffness);

/// The homogeneous sheet that equals a stack of plies in its plane (Jones, Mechanics of Composite Materials, 1999, sec. 4.2).
struct Laminate {
  double thickness = 0.0;
  double density = 0.0;                // thickness-weighted
  PlaneStiffness stiffness{};          // A / thickness, A = sum of t_k Q(angle_k)
  PlaneStiffness damping_stiffness{};  // the same with each ply's stiffness times its beta
};

/// @throws InputError if a ply's material is missing or not linear elastic.
Laminate laminate(const Model& model, const Section& section);

/// The linear law S = Q E (St. Venant-Kirchhoff) without history; the thickness does not change.
std::unique_ptr<Law<PointKind::plane>> linear_plane_law(const PlaneStiffness& stiffness);

}  // namespace balocco
