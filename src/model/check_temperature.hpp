// What must hold where matter follows its temperature.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Errors about *EXPANSION, tables of *ELASTIC and *TEMPERATURE, and where they belong: sections and steps that do not follow them.
std::vector<std::pair<Location, std::string>> check_temperature(const Model& model);

}  // namespace balocco
