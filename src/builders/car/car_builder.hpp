// The car builder: a description of a car (TOML) becomes a complete deck.
#pragma once

#include <string>

#include "builders/car/car_choices.hpp"
#include "builders/file_text.hpp"
#include "model/model.hpp"

namespace balocco {

/// Decks in pieces: what is a model already (heading, tyres, roads), text of the rest of the car, and steps.
struct CarDeck {
  Model tyres;
  std::string car, equilibrium, drive;
  std::string kinematics;  // a whole deck: the axles are moved, without tyres
  std::string report;  // masses, inertias and dimensions
};

/// The car that `toml_text` describes, and its drive. `file_name` is named in messages; `load` reads the tyre's description and those
/// that they are based on. Units mm, ms, g, N, MPa.
/// @throws InputError with every fault found: "FILE:LINE: error: [table] key: what is wrong; how to mend it".
CarDeck build_car(const std::string& toml_text, const std::string& file_name, const FileText& load, const CarChoices& choices = {});

}  // namespace balocco
