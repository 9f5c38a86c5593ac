// What the keywords of interactions and those of pairs share.
#pragma once

#include "model/model.hpp"

namespace balocco::deck {

/// Mean length of the edges of a surface's faces, undeformed; 0 where it has none.
double mean_edge(const Model& model, std::int32_t surface);

}  // namespace balocco::deck
