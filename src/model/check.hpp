// What must hold for a Model whatever syntax it came from, and the summary that `balocco check` prints.
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Whole messages "FILE:LINE: error: what is wrong; how to mend it"; a sound model has no errors.
struct Findings {
  std::vector<std::string> errors, warnings;
};
Findings check_model(const Model& model);

/// What was understood: counts, mass by section, centre of gravity, inertia, bounding box, stable increment with the
/// element that governs it, memory and run time on `ranks` ranks, warnings.
std::string summarize(const Model& model, int ranks);

}  // namespace balocco
