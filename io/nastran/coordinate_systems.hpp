// Coordinate systems of bulk data: rectangular (CORD2R) and cylindrical (CORD2C), each told in another one or in the basic one.
#pragma once

#include <map>
#include <optional>

#include "nastran/bulk_cards.hpp"

namespace balocco::nastran {

class CoordinateSystems {
 public:
  /// Whether the card describes a system that is known here; it is then kept.
  bool add(const BulkCard& card);
  /// The basic coordinates of a point of system `id`; 0 is the basic system. Faults are told as those of the card that asks.
  Point to_basic(std::int64_t id, Point point, CardFields& asking, deck::Diagnostics& diagnostics);

 private:
  struct Frame {
    bool cylindrical = false;
    Point origin{};
    std::array<Point, 3> axes{};
  };
  struct Entry {
    BulkCard card;
    std::optional<Frame> frame;  // none: not yet asked for
    bool open = false;           // being worked out: who asks for it now is one of those that it stands on
  };
  std::optional<Frame> frame_of(std::int64_t id, CardFields& asking, deck::Diagnostics& diagnostics);
  std::map<std::int64_t, Entry> entries_;
};

}  // namespace balocco::nastran
