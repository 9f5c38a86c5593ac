// What must hold where a material can fail.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Errors about *SHEAR FAILURE and where they belong: elements and steps that cannot delete, loads that would go on acting.
std::vector<std::pair<Location, std::string>> check_failure(const Model& model);

}  // namespace balocco
