// What a membrane kernel needs to know about its section: the law, and the moduli of the undeformed state.
#pragma once

#include <memory>

#include "materials/initial_stress.hpp"
#include "sections/lamination.hpp"

namespace balocco {

struct MembraneSection {
  std::unique_ptr<Law<PointKind::plane>> law;
  double thickness = 0.0;
  double density = 0.0;
  PlaneStiffness initial_stiffness{};  // dS/dE in the undeformed state
  PlaneStiffness damping_stiffness{};  // stiffness-proportional damping: beta * initial stiffness (as Abaqus for rubber)
  double damping_beta = 0.0;           // the largest of the plies
  bool linear = false;                 // dS/dE is initial_stiffness for every strain
  double initial_modulus = 0.0;        // 2 * shear_modulus that the law tells for the undeformed state
};

/// What a law bounds its tangent with at zero strain: PointBatch::shear_modulus, doubled. `history` is that of a virgin point.
double undeformed_modulus(const Law<PointKind::plane>& law, std::span<const double> history);

/// @throws InputError if the material is missing, has no plane-stress form, or the thickness is not positive.
MembraneSection membrane_section(const Model& model, const Section& section);

}  // namespace balocco
