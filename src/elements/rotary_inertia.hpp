// What groups of elements whose nodes turn say of their rotary inertia beside what the explicit loop needs.
#pragma once

#include <cstdint>
#include <span>

namespace balocco {

class MaterialRotaryInertia {
 public:
  virtual ~MaterialRotaryInertia() = default;

  /// Rotary inertia of each node of an element as the material has it (ElementGroup::lumped_rotary_inertia is raised for the explicit
  /// increment's sake): 3 x 3 a node, row-major, about global axes in the reference configuration, mass x length^2.
  virtual void material_rotary_inertia(std::int32_t element, std::span<double> tensors) const = 0;
};

}  // namespace balocco
