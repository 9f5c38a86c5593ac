#include "elements/element_group.hpp"

#include <algorithm>

#include "elements/element_type.hpp"
#include "math/pack.hpp"

namespace balocco {

namespace {

std::int32_t whole_packs(std::int32_t count) { return (count + pack_size - 1) / pack_size * pack_size; }

}  // namespace

// Lanes 0 .. size-1 are the elements of `rows`, in order; only the last pack has padded lanes. The interface portion is rounded
// up to whole packs by a few interior elements, which may be computed early without harm.
ElementGroup::ElementGroup(const GroupInput& input)
    : table_(input.table),
      section_(input.section),
      size_(static_cast<std::int32_t>(input.rows.size())),
      padded_size_(whole_packs(size_)),
      interface_padded_(std::min(whole_packs(input.interface_count), padded_size_)),
      nodes_per_element_(input.model.elements[input.table].type->nodes),
      rows_(input.rows),
      connectivity_(input.connectivity),
      scatter_(input.connectivity) {
  for (std::int32_t lane = size_; lane < padded_size_; ++lane) {
    rows_.push_back(input.rows.back());
    for (int i = 0; i < nodes_per_element_; ++i) {
      connectivity_.push_back(input.connectivity[(size_ - 1) * nodes_per_element_ + i]);
      scatter_.push_back(input.scratch_node);
    }
  }
}

std::vector<double> ElementGroup::initial_history() const {
  std::vector<double> own(history_size()), history(own.size() * padded_size_);
  initialize_history(own);
  for (std::int32_t element = 0; element < padded_size_; ++element) scatter_history(element, own, history);
  return history;
}

void ElementGroup::gather_history(std::int32_t element, std::span<const double> group_history, std::span<double> own) const {
  for (std::size_t component = 0; component < own.size(); ++component)
    own[component] = group_history[component * padded_size_ + element];
}

void ElementGroup::scatter_history(std::int32_t element, std::span<const double> own, std::span<double> group_history) const {
  for (std::size_t component = 0; component < own.size(); ++component)
    group_history[component * padded_size_ + element] = own[component];
}

}  // namespace balocco
