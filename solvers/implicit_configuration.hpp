// Where nodes and bodies are: what an increment begins from, and what a failed trial returns to.
#pragma once

#include <vector>

#include "model/state.hpp"

namespace balocco {

struct Configuration {
  std::vector<double> position, orientation, rotation;
  std::vector<RigidBodyState> bodies;
  std::vector<double> multiplier;
};

}  // namespace balocco
