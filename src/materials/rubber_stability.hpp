// Drucker's condition for rubber: stress must rise with logarithmic strain in every direction of plane stress.
#pragma once

#include <string>

#include "materials/material_law.hpp"

namespace balocco {

/// Looks at nominal strains between -0.8 and 5 in uniaxial, equibiaxial and planar tension and compression of the
/// incompressible material. @return "" or a sentence with the strains beyond which the law is unstable
std::string unstable_range(const Law<PointKind::solid>& law);

}  // namespace balocco
