// A reference to an element of the model.
#pragma once

#include <compare>
#include <cstdint>

namespace balocco {

/// The table of the element's type and its row there.
struct ElementRef {
  std::int32_t table = -1;
  std::int32_t row = -1;
  friend auto operator<=>(const ElementRef&, const ElementRef&) = default;
};

}  // namespace balocco
