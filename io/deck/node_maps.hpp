// Maps of nodal coordinates.
#pragma once

#include <functional>

#include "deck/builder.hpp"

namespace balocco::deck {

/// *NCOPY, REFLECT=POINT, LINE or MIRROR: through point a, the line a b, the plane a b c of the data lines. Empty: an error was
/// told.
std::function<Point(const Point&)> reflection_of(Builder& builder, const Block& block);

/// *NCOPY, POLE: as far behind the old node as the pole is before it. Empty: an error was told.
std::function<Point(const Point&)> pole_of(Builder& builder, const Block& block);

}  // namespace balocco::deck
