// The car builder: a description of a car (TOML) becomes a complete deck.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "model/model.hpp"

namespace balocco {

/// Decks in pieces: what is a model already (heading, tyres, roads), text of the rest of the car, and steps.
struct CarDeck {
  Model tyres;
  std::string car, equilibrium, drive;
  std::string report;  // masses, inertias and dimensions
};

/// The car that `toml_text` describes. `file_name` is named in messages; `load` reads the tyre's description. Units mm, ms, g, N, MPa.
/// @throws InputError with every fault found: "FILE:LINE: error: [table] key: what is wrong; how to mend it".
CarDeck build_car(const std::string& toml_text, const std::string& file_name, const std::function<std::optional<std::string>(const std::string&)>& load);

}  // namespace balocco
