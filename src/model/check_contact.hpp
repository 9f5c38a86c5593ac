// Contact pairs whose surfaces, or steps, do not fit.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// What is wrong, where.
std::vector<std::pair<Location, std::string>> check_contact(const Model& model);

}  // namespace balocco
