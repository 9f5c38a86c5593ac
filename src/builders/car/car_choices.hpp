#pragma once

#include <string>

namespace balocco {

/// What overrides a car's description; empty: as described.
struct CarChoices {
  std::string obstacle;  // of the drive: comfort, pothole, drop
  std::string fidelity;  // complete, semi-flexible, rigid
};

}  // namespace balocco
