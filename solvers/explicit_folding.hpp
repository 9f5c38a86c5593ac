// Bricks and wedges that fold at a corner, where no integration point sees it.
#pragma once

#include <optional>

#include "analysis.hpp"
#include "elements/failure.hpp"

namespace balocco {

struct FoldedCorner {
  std::int64_t element = -1, node = -1;  // ids
};

/// Laws hold out against a vanishing volume at integration points alone. A corner whose three edges have changed their sense since the
/// reference configuration is folded: its node has gone a third of the way to the opposite corner, and the mesh hardly follows. Where it
/// goes on, by half the element's volume, the node passes through the opposite faces, and elements of the other side go on as if nothing
/// had happened: the element has turned inside out.
struct Folding {  // of this rank's elements that act and have not failed: the one with the smallest id
  std::optional<FoldedCorner> folded, inside_out;
};

Folding find_folding(const Analysis& analysis, const ElementFailures& failures);

}  // namespace balocco
