// Helpers of the mesh keywords: adding nodes and elements with their ids checked.
#pragma once

#include <optional>

#include "deck/builder.hpp"
#include "deck/geometry.hpp"

namespace balocco::deck {

/// Adds a node of the current scope (`point` in global coordinates) and returns its row; an id that is taken is told.
std::optional<std::int32_t> add_node(Builder& builder, const Block& block, Location location, std::int64_t id,
                                     const Point& point);

/// Adds a node of no scope, with a free id, that is held for ever.
std::int32_t add_ground_node(Builder& builder, Location location, const Point& point);

/// What is added to element ids of the current scope.
std::int64_t element_offset(Builder& builder);

}  // namespace balocco::deck
