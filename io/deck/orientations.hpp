// Directions by name: the same everywhere, or those of single elements.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// Row of an *ORIENTATION that is the same everywhere; told where there is none.
std::optional<std::int32_t> require_directions(Builder& builder, std::string_view name, const Block& block, Location location);

/// Gives elements their axes where an *ORIENTATION is defined by them. @return false, told, where it cannot be.
bool give_directions(Builder& builder, const Block& block, std::int32_t orientation, const std::vector<ElementRef>& elements);

}  // namespace balocco::deck
