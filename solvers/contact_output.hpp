// Nodal output of contact: of slave nodes, one value (or vector of three) for each local node. All collective.
#pragma once

#include "analysis.hpp"

namespace balocco {

void contact_pressure(const Analysis& analysis, std::span<double> values);
void contact_shear(const Analysis& analysis, std::span<double> values);
void contact_slip(const Analysis& analysis, std::span<double> values);
/// Distance to the nearest master; zero on nodes of no contact pair.
void contact_opening(const Analysis& analysis, std::span<double> values);
void contact_normal_force(const Analysis& analysis, std::span<double> values);
void contact_shear_force(const Analysis& analysis, std::span<double> values);

}  // namespace balocco
