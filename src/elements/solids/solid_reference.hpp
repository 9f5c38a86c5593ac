// What every solid element needs to know of the model: its law, its density, its material directions and initial
// moduli.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "elements/element_group.hpp"
#include "materials/initial_stress.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// The material of a solid section.
struct SolidMaterial {
  std::unique_ptr<Law<PointKind::solid>> law;
  double density = 0.0, damping_beta = 0.0;
  std::array<double, 36> stiffness{};  // initial, material directions, 11 22 33 12 13 23 with engineering shear
  double volumetric_modulus = 0.0, shear_modulus = 0.0;  // initial bounds, see PointBatch
  double wave_speed = 0.0;                               // dilatational, 0 without density

  /// @throws InputError if the section's law has no solid form.
  static SolidMaterial of_section(const Model& model, const Section& section);
};

/// Columns are the section's material directions at `point` of an element: the global ones without an orientation.
Matrix3<double> material_directions(const Model& model, const Section& section, const Point& point, ElementRef element = {});

/// Nodes of a row of an element table in the section's material directions about the element's centre. Solids are
/// computed there: rotating the reference configuration once makes F = dx/dX that of the material directions at no cost
/// per cycle.
void reference_nodes(const Model& model, const Section& section, const ElementTable& table, std::int32_t row,
                     std::span<Vector3<double>> nodes);

}  // namespace balocco
