#pragma once

#include <string>

namespace balocco {

/// What overrides a car's description; empty: as described.
struct CarChoices {
  std::string obstacle;  // of the drive: comfort, pothole, drop
  std::string fidelity;  // complete, semi-flexible, rigid
  bool inflates_one_tyre = false;  // in a job of its own, from which the equilibrium starts
};

}  // namespace balocco
