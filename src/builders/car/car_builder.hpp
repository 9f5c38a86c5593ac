// The car builder: a description of a car (TOML) becomes a complete deck.
#pragma once

#include <string>

namespace balocco {

/// The deck of the car that `toml_text` describes. `file_name` is named in messages; `report` receives masses, inertias and
/// dimensions as text. Units mm, ms, g, N, MPa.
/// @throws InputError with every fault found: "FILE:LINE: error: [table] key: what is wrong; how to mend it".
std::string build_car(const std::string& toml_text, const std::string& file_name, std::string& report);

}  // namespace balocco
