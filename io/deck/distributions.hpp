// *DISTRIBUTION: what elements have one by one.
#pragma once

#include <array>
#include <map>
#include <optional>

#include "model/model.hpp"

namespace balocco::deck {

/// Values of elements, and of all others if there is one.
template <class Value>
struct Distributed {
  std::map<ElementRef, Value> own;
  std::optional<Value> otherwise;

  std::optional<Value> of(ElementRef element) const {
    const auto found = own.find(element);
    return found == own.end() ? otherwise : std::optional(found->second);
  }
};

/// Directions (axes), or lengths: thicknesses of shells.
struct Distribution {
  bool of_lengths = false;
  Distributed<std::array<Point, 3>> directions;
  Distributed<double> lengths;
};

}  // namespace balocco::deck
