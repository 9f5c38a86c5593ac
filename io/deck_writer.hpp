// Writes a Model as a deck that read_deck understands and people can read.
#pragma once

#include <string>

#include "model/model.hpp"

namespace balocco {

/// Numbers are written so that they read back exactly: read(write(model)) is the same model but for locations, file
/// names, sets that had to be made for what had none, and axes, which are normalised again (round-off).
std::string write_deck(const Model& model);

}  // namespace balocco
