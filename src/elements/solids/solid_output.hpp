// Output variables of solids, from the state at one integration point.
#pragma once

#include <span>
#include <string_view>

#include "elements/solids/solid_reference.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Components of S, LE, E and of metals PE (6), MISES, PRESS, SENER and scalars of the law's history such as PEEQ (1); 0 for anything else.
int solid_output_components(const SolidMaterial& material, std::string_view variable);

/// S: Cauchy stress; LE: logarithmic strain; PE: plastic_strain.hpp, all in global directions; E: Green's strain, in the section's
/// material directions; MISES; PRESS = -tr S / 3; SENER: recoverable energy per reference volume. `deformation_gradient` is that of
/// the material directions.
void solid_output(std::string_view variable, const SolidMaterial& material, const Matrix3<double>& deformation_gradient,
                  std::span<const double> law_history, std::span<double> values);

}  // namespace balocco
