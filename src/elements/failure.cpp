#include "elements/failure.hpp"

#include <algorithm>

namespace balocco {

bool has_failed(std::span<const int> rows, std::span<const double> own_history) {
  return !rows.empty() && std::ranges::all_of(rows, [&](int row) { return own_history[row] > 0.0; });
}

ElementFailures::ElementFailures(std::span<const std::unique_ptr<ElementGroup>> groups) : groups_(groups) {
  for (const auto& group : groups) rows_.push_back(failure_rows(*group));
}

bool ElementFailures::failed(std::size_t group, std::int32_t element, std::span<const double> history) const {
  const auto stride = static_cast<std::size_t>(groups_[group]->padded_size());
  return !rows_[group].empty() &&
         std::ranges::all_of(rows_[group], [&](int row) { return history[static_cast<std::size_t>(row) * stride + element] > 0.0; });
}

void ElementFailures::rest(std::size_t index, std::span<const double> history) const {
  if (rows_[index].empty()) return;
  ElementGroup& group = *groups_[index];
  std::vector<bool> acting;  // made where the first one is found
  for (std::int32_t element = 0; element < group.size(); ++element) {
    if (!group.acts(element) || !failed(index, element, history)) continue;
    acting.resize(group.size(), true);
    acting[element] = false;
  }
  if (acting.empty()) return;
  for (std::int32_t element = 0; element < group.size(); ++element) acting[element] = acting[element] && group.acts(element);
  group.set_acting(std::move(acting));
}

bool ElementFailures::any() const {
  return std::ranges::any_of(rows_, [](const auto& rows) { return !rows.empty(); });
}

std::int64_t ElementFailures::count(std::span<const std::vector<double>> history) const {
  std::int64_t count = 0;
  for (std::size_t group = 0; group < rows_.size(); ++group)
    for (std::int32_t element = 0; !rows_[group].empty() && element < groups_[group]->size(); ++element)
      count += failed(group, element, history[group]) ? 1 : 0;
  return count;
}

}  // namespace balocco
