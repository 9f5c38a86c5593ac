#include "nastran/coordinate_systems.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "deck/geometry.hpp"
#include "deck/text.hpp"

namespace balocco::nastran {

bool CoordinateSystems::add(const BulkCard& card) {
  if (card.name != "CORD2R" && card.name != "CORD2C") return false;
  const auto id = card.fields.empty() ? std::nullopt : deck::parse_integer(card.fields[0]);
  if (id) entries_[*id] = {.card = card, .frame = std::nullopt};
  return true;
}

std::optional<CoordinateSystems::Frame> CoordinateSystems::frame_of(std::int64_t id, CardFields& asking,
                                                                    deck::Diagnostics& diagnostics) {
  const auto found = entries_.find(id);
  if (found == entries_.end() || found->second.open) {
    asking.fault(fmt::format("its coordinate system {} {}", id,
                             found == entries_.end()
                                 ? "is no CORD2R or CORD2C; write the places in one of these, or in the basic system"
                                 : "stands on itself; give one of its chain reference 0"));
    return std::nullopt;
  }
  auto& [card, frame, open] = found->second;
  if (frame) return frame;
  CardFields fields(card, diagnostics);
  const auto reference = fields.integer(2, "RID", 0);
  open = true;
  std::array<Point, 3> points{};
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = to_basic(reference, fields.point(3 + 3 * i, "a place"), fields, diagnostics);
  open = false;
  const auto axes = deck::axes_of_points(points[0], points[1], points[2]);  // the third one first, as the card tells them
  if (axes)
    frame = Frame{.cylindrical = card.name == "CORD2C", .origin = points[0], .axes = {(*axes)[1], (*axes)[2], (*axes)[0]}};
  else
    fields.fault("its three points lie on a line; move the third one");
  return frame;
}

Point CoordinateSystems::to_basic(std::int64_t id, Point point, CardFields& asking, deck::Diagnostics& diagnostics) {
  if (id == 0) return point;
  const auto frame = frame_of(id, asking, diagnostics);
  if (!frame) return point;
  if (frame->cylindrical) {
    const double angle = point[1] * std::numbers::pi / 180.0;
    point = {point[0] * std::cos(angle), point[0] * std::sin(angle), point[2]};
  }
  Point basic = frame->origin;
  for (int axis = 0; axis < 3; ++axis)
    for (int c = 0; c < 3; ++c) basic[c] += point[axis] * frame->axes[axis][c];
  return basic;
}

}  // namespace balocco::nastran
