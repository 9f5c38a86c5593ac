// Profiles of analytical rigid surfaces: START, LINE, CIRCL lines and the arcs that FILLET RADIUS puts into their
// corners.
#pragma once

#include <span>
#include <vector>

#include "deck/builder.hpp"

namespace balocco::deck {

/// Reads START, LINE and CIRCL lines. Returns an empty profile if something was wrong (told).
std::vector<ProfileSegment> read_profile(Builder& builder, const Block& block, std::span<const DataLine> lines);

/// Replaces corners by tangent arcs of that radius. Throws std::invalid_argument saying which corner has no room for
/// it.
std::vector<ProfileSegment> round_corners(const std::vector<ProfileSegment>& profile, double radius);

}  // namespace balocco::deck
