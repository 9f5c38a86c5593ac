// Where a deck said something.
#pragma once

#include <cstdint>

namespace balocco {

/// Where in which file of Model::files something was said. `file` < 0: nowhere (made by the program).
struct Location {
  std::int32_t file = -1;
  std::int32_t line = 0;
};

}  // namespace balocco
