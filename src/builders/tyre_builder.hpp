// The tyre builder: a description of a tyre's section, rim, road and run (TOML) becomes a complete model.
#pragma once

#include <string>

#include "builders/file_text.hpp"
#include "model/model.hpp"

namespace balocco {

/// Builds the whole model (mesh, sections, rim, road, steps) of the description `toml_text`. `file_name` is named in
/// messages; `report` receives masses, dimensions, counts and stable increments as text. Units mm, ms, g, N, MPa.
/// @throws InputError with every fault found: "FILE:LINE: error: [table] key: what is wrong; how to mend it".
Model build_tyre(const std::string& toml_text, const std::string& file_name, const FileText& load, std::string& report);

/// A drawing (SVG) of the meshed section of the same description. @throws InputError as build_tyre.
std::string tyre_section_svg(const std::string& toml_text, const std::string& file_name, const FileText& load);

}  // namespace balocco
