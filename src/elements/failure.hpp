// Elements that *SHEAR FAILURE deletes: those of which every point has failed, by their laws' history field FAILED.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "elements/element_group.hpp"

namespace balocco {

/// Components of an element's history, one a point, that are above 0 once it has failed; empty: the elements never fail.
inline std::vector<int> failure_rows(const ElementGroup& group) {
  std::vector<int> rows;
  for (int point = 0; point < group.integration_points(); ++point) {
    rows.push_back(group.law_field_row("FAILED", point));
    if (rows.back() < 0) return {};
  }
  return rows;
}

/// Whether an element with that history of its own has failed.
bool has_failed(std::span<const int> rows, std::span<const double> own_history);

/// The failed elements of all groups of a rank. `history[i]` is that of group i.
class ElementFailures {
 public:
  explicit ElementFailures(std::span<const std::unique_ptr<ElementGroup>> groups);

  /// Whether elements of this rank can fail.
  bool any() const;
  bool failed(std::size_t group, std::int32_t element, std::span<const double> history) const;
  /// Lets the acting elements of a group rest that have failed, from the next cycle on.
  void rest(std::size_t group, std::span<const double> history) const;
  std::int64_t count(std::span<const std::vector<double>> history) const;

 private:
  std::span<const std::unique_ptr<ElementGroup>> groups_;
  std::vector<std::vector<int>> rows_;  // of each group
};

}  // namespace balocco
