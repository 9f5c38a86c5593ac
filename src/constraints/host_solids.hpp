// In which of a set of solids a point lies, and how its motion follows from that of the solid's nodes (*EMBEDDED ELEMENT).
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Nodes of a solid and the values of their shape functions, whose sum is 1.
struct HostPoint {
  std::vector<std::int32_t> nodes;
  std::vector<double> weights;
  double outside = 0.0;  // distance from the solid, 0 inside
};

class HostSolids {
 public:
  HostSolids(const Model& model, std::vector<ElementRef> elements);

  /// True for solids, whose shape functions are known.
  static bool takes(const ElementType& type);
  /// The solid that holds `point`, or the nearest within `tolerance` (a length); the first of equals in the order of the elements.
  std::optional<HostPoint> at(const Point& point, double tolerance) const;
  /// Mean length of the solids' edges about.
  double mean_size() const { return mean_size_; }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(const Point& point) const;
  std::optional<HostPoint> place(ElementRef element, const Point& point) const;

  const Model& model_;
  double mean_size_ = 0.0;
  std::map<Cell, std::vector<ElementRef>> cells_;  // solids by the cells of a grid that their bounds, a little stretched, touch
};

}  // namespace balocco
