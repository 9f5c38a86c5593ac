// Where elements of second order cannot go.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Errors, and where they belong: explicit steps with elements of implicit ones.
std::vector<std::pair<Location, std::string>> check_quadratic(const Model& model);

}  // namespace balocco
