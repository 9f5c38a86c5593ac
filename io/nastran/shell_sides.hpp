// Which way the normals of shells point: pre-processors do not mind, and decks have sides.
#pragma once

#include <cstdint>
#include <vector>

namespace balocco::nastran {

/// Turns round node orders until neighbours across an edge of two shells point to the same side; of each such surface those are
/// turned that are fewer. A surface that has but one side stays as it is. @return how many were turned.
int unify_sides(const std::vector<std::vector<std::int64_t>*>& shells);

}  // namespace balocco::nastran
