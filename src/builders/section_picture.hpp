// A drawing of a tyre's meshed section.
#pragma once

#include <string>

#include "builders/tyre_section.hpp"

namespace balocco {

/// SVG, 1 mm = 4 units: rubber by part, membranes by region, rim contact, dimensions.
std::string section_svg(const TyreSpec& spec, const TyreSection& section);

}  // namespace balocco
