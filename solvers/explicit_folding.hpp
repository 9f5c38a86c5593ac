// Bricks and wedges that have turned inside out at a corner, where no integration point sees it.
#pragma once

#include <optional>
#include <span>

#include "analysis.hpp"
#include "elements/failure.hpp"

namespace balocco {

struct FoldedCorner {
  std::int64_t element = -1, node = -1;  // ids
};

/// Laws hold out against a vanishing volume at integration points alone: behind them a node may pass through the opposite face, and
/// elements of the other side go on as if nothing had happened. @return of this rank's elements that act and have not failed the one
/// with the smallest id at one of whose corners the three edges have changed their sense since the reference configuration.
std::optional<FoldedCorner> find_folded_corner(const Analysis& analysis, const ElementFailures& failures);

}  // namespace balocco
