// Values that one rank has, brought to root.
#pragma once

#include <vector>

#include "communicator.hpp"

namespace balocco {

/// Values of which exactly one rank has the bits and all others zero bits, put together on root. Collective.
void merge_bits(std::vector<double>& values, const Communicator& communicator);

}  // namespace balocco
