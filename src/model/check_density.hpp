// Materials that need a density.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Errors, and where they belong: materials without a density in steps that need masses, or under loads on mass.
std::vector<std::pair<Location, std::string>> check_density(const Model& model);

}  // namespace balocco
