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
  Model tyre;              // where the equilibrium starts from a tyre that is inflated alone: that one, with its steps
  std::string inflation;
  std::string kinematics;  // a whole deck: the axles are moved, without tyres
  std::string report;  // masses, inertias and dimensions
};

/// What a car's description names: other descriptions, and a mesh of its wheel; none where there is no such file.
struct CarFiles {
  FileText text;
  std::function<std::optional<Model>(const std::string& path)> mesh;
};

/// The car that `toml_text` describes, and its drive. `file_name` is named in messages. Units mm, ms, g, N, MPa.
/// @throws InputError with every fault found: "FILE:LINE: error: [table] key: what is wrong; how to mend it".
CarDeck build_car(const std::string& toml_text, const std::string& file_name, const CarFiles& files,
                  const CarChoices& choices = {});

}  // namespace balocco
