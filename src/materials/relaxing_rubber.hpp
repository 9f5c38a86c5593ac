// Neo-Hooke and Mooney-Rivlin rubber with *VISCOELASTIC: the same law through the polynomial form, compiled once.
#pragma once

#include "materials/rubber_plane_stress.hpp"
#include "materials/viscoelastic.hpp"

namespace balocco {

template <PointKind kind>
std::unique_ptr<Law<kind>> relaxing_rubber(const Material& material, const RubberConstants& constants);

}  // namespace balocco
