#include "elements/element_group.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "elements/bulk_viscosity.hpp"
#include "elements/element_type.hpp"
#include "elements/failure.hpp"
#include "math/pack.hpp"

namespace balocco {

namespace {

std::int32_t whole_packs(std::int32_t count) { return (count + pack_size - 1) / pack_size * pack_size; }

/// The energy of the whole element that an output variable asks for; null: it asks for something else.
double ElementEnergies::*whole_element_energy(std::string_view variable) {
  if (variable == "ELSE") return &ElementEnergies::strain;
  if (variable == "ELASE") return &ElementEnergies::hourglass;
  return nullptr;
}

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
      freedoms_per_node_(input.model.elements[input.table].type->turns ? 6 : 3),
      rows_(input.rows),
      connectivity_(input.connectivity),
      scratch_node_(input.scratch_node) {
  for (std::int32_t lane = size_; lane < padded_size_; ++lane) {
    rows_.push_back(input.rows.back());
    for (int i = 0; i < nodes_per_element_; ++i)
      connectivity_.push_back(input.connectivity[(size_ - 1) * nodes_per_element_ + i]);
  }
  set_acting({});
}

void ElementGroup::lumped_mass(std::int32_t element, std::span<double> mass) const {
  lumped_volume(element, mass);
  const double factor = density();
  for (double& share : mass) share *= factor;
}

void ElementGroup::set_acting(std::vector<bool> acting) {
  acting_ = std::move(acting);
  if (!acting_.empty()) acting_.resize(padded_size_, acting_.back());
  scatter_ = connectivity_;
  for (std::int32_t lane = 0; lane < padded_size_; ++lane)
    if (lane >= size_ || !acts(lane))
      std::fill_n(&scatter_[static_cast<std::size_t>(lane) * nodes_per_element_], nodes_per_element_, scratch_node_);
  interface_work_ = work_of(0, interface_padded_);
  interior_work_ = work_of(interface_padded_, padded_size_);
}

void ElementGroup::set_mass_scale(std::span<const double> scale) {
  mass_scale_.assign(scale.begin(), scale.end());
  if (!mass_scale_.empty()) mass_scale_.resize(static_cast<std::size_t>(padded_size_), mass_scale_.back());
  time_scale_.resize(mass_scale_.size());
  std::ranges::transform(mass_scale_, time_scale_.begin(), [](double s) { return std::sqrt(s); });
  decide_adjusting();
}

void ElementGroup::set_added_bounds(std::span<const FrequencyBound> added) {
  added_bounds_.assign(added.begin(), added.end());
  if (!added_bounds_.empty()) added_bounds_.resize(static_cast<std::size_t>(padded_size_), added_bounds_.back());
  added_to_pack_.assign(added_bounds_.size() / pack_size, false);
  for (std::size_t lane = 0; lane < added_bounds_.size(); ++lane)
    if (added_bounds_[lane] != FrequencyBound{}) added_to_pack_[lane / pack_size] = true;
  decide_adjusting();
}

void ElementGroup::decide_adjusting() {
  adjusts_increments_ = records_increments_ || !time_scale_.empty() || !added_bounds_.empty();
}

double ElementGroup::allowing_for(const FrequencyBound& added, double increment) {
  if (added == FrequencyBound{}) return increment;
  return neutral_increment(4.0 / (increment * increment) + added.omega_square, added.rate);
}

void ElementGroup::record_increments(bool record) {
  records_increments_ = record;
  // Kernels without masses of their own bound no increment, and record none.
  if (record) recorded_increments_.assign(static_cast<std::size_t>(padded_size_), StableIncrement{}.increment);
  decide_adjusting();
}

StableIncrement ElementGroup::smallest_recorded_increment() const {
  StableIncrement smallest;
  for (std::int32_t element = 0; element < size_; ++element)
    if (acts(element)) {
      const double scaled = (time_scale_.empty() ? 1.0 : time_scale_[element]) * recorded_increments_[element];
      smallest.merge({added_bounds_.empty() ? scaled : allowing_for(added_bounds_[element], scaled), element});
    }
  return smallest;
}

double ElementGroup::recorded_increment_with_added_bound(std::int32_t element) const {
  const double own = recorded_increments_[element], scale = time_scale_.empty() ? 1.0 : time_scale_[element];
  return added_bounds_.empty() ? own : allowing_for(added_bounds_[element], scale * own) / scale;
}

std::int32_t ElementGroup::acting_count() const {
  std::int32_t count = 0;
  for (std::int32_t element = 0; element < size_; ++element) count += acts(element) ? 1 : 0;
  return count;
}

ElementGroup::Work ElementGroup::work_of(std::int32_t first, std::int32_t last) const {
  Work work;
  for (std::int32_t pack = first; pack < last; pack += pack_size) {
    std::vector<std::int32_t> resting;
    for (std::int32_t lane = pack; lane < pack + pack_size; ++lane)
      if (!acts(lane)) resting.push_back(lane);
    if (resting.size() == pack_size) continue;
    work.resting.insert(work.resting.end(), resting.begin(), resting.end());
    if (work.runs.empty() || work.runs.back().last != pack) work.runs.push_back({pack, pack});
    work.runs.back().last = pack + pack_size;
  }
  return work;
}

StableIncrement ElementGroup::add_forces(Portion portion, const ExplicitCycle& cycle, std::span<double> history) const {
  const Work& work = portion == Portion::interface ? interface_work_ : interior_work_;
  const auto components = static_cast<std::size_t>(work.resting.empty() ? 0 : history_size());
  const auto at = [&](std::size_t component, std::int32_t lane) -> double& {
    return history[component * static_cast<std::size_t>(padded_size_) + static_cast<std::size_t>(lane)];
  };
  kept_history_.clear();
  for (std::size_t component = 0; component < components; ++component)
    for (const auto lane : work.resting) kept_history_.push_back(at(component, lane));
  const StableIncrement smallest = add_forces(work.runs, cycle, history);
  auto kept = kept_history_.begin();
  for (std::size_t component = 0; component < components; ++component)
    for (const auto lane : work.resting) at(component, lane) = *kept++;
  return smallest;
}

std::vector<double> ElementGroup::initial_history() const {
  std::vector<double> own(history_size()), history(own.size() * padded_size_);
  initialize_history(own);
  for (std::int32_t element = 0; element < padded_size_; ++element) scatter_history(element, own, history);
  return history;
}

int ElementGroup::law_field_row(std::string_view, int) const { return -1; }

void ElementGroup::set_initial_fields(const Model& model, std::span<double> history) const {
  std::unordered_map<std::int32_t, std::int32_t> lane_of;
  for (std::int32_t lane = 0; lane < size() && !model.initial_fields.empty(); ++lane) lane_of.emplace(rows_[lane], lane);
  for (const auto& initial : model.initial_fields) {
    if (law_field_row(initial.field, 0) < 0) continue;
    const auto given = static_cast<int>(initial.values.size()) / initial.components;
    for (const auto element : initial.elements) {
      const auto known = element.table == table_ ? lane_of.find(element.row) : lane_of.end();
      if (known == lane_of.end()) continue;
      for (auto lane = known->second; lane < padded_size_ && rows_[lane] == element.row; ++lane)  // padding repeats the last element
        for (int point = 0; point < integration_points(); ++point)
          for (int k = 0; k < initial.components; ++k)
            history[static_cast<std::size_t>(law_field_row(initial.field, point) + k) * padded_size_ + lane] =
                initial.values[initial.components * (point % given) + k];
    }
  }
}

void ElementGroup::gather_history(std::int32_t element, std::span<const double> group_history, std::span<double> own) const {
  for (std::size_t component = 0; component < own.size(); ++component)
    own[component] = group_history[component * padded_size_ + element];
}

void ElementGroup::scatter_history(std::int32_t element, std::span<const double> own, std::span<double> group_history) const {
  for (std::size_t component = 0; component < own.size(); ++component)
    group_history[component * padded_size_ + element] = own[component];
}

void ElementGroup::lumped_rotary_inertia(std::int32_t, std::span<double> inertia) const {
  std::fill(inertia.begin(), inertia.end(), 0.0);
}

void ElementGroup::material_rotary_inertia(std::int32_t, std::span<double> tensors) const {
  std::fill(tensors.begin(), tensors.end(), 0.0);
}

void ElementGroup::energies(std::int32_t first, const NodalMotion& motion, std::span<const double> group_history,
                            std::span<ElementEnergies> of_lanes) const {
  std::vector<double> own(history_size());
  for (std::size_t lane = 0; lane < of_lanes.size(); ++lane) {
    const auto element = std::min(first + static_cast<std::int32_t>(lane), size_ - 1);
    gather_history(element, group_history, own);
    of_lanes[lane] = energies(element, motion, own);
  }
}

Restraint ElementGroup::restraint(std::int32_t) const { return {}; }

Restraint ElementGroup::rotary_restraint(std::int32_t) const { return {}; }

int ElementGroup::output_components(std::string_view variable) const {
  if (variable == "STATUS") return 1;
  return whole_element_energy(variable) != nullptr ? 1 : point_components(variable);
}

void ElementGroup::output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                          std::span<const double> history, std::span<double> values) const {
  if (variable == "STATUS") {
    values[0] = has_failed(failure_rows(*this), history) ? 0.0 : 1.0;
  } else if (const auto energy = whole_element_energy(variable); energy != nullptr) {
    values[0] = energies(element, motion, history).*energy;
  } else {
    point_output(variable, element, integration_point, motion, history, values);
  }
}

void ElementGroup::mean_output(std::string_view variable, std::int32_t element, const NodalMotion& motion, std::span<const double> history,
                               std::span<double> values) const {
  if (variable == "STATUS" || whole_element_energy(variable) != nullptr)
    output(variable, element, 0, motion, history, values);
  else
    mean_point_output(variable, element, motion, history, values);
}

void ElementGroup::mean_point_output(std::string_view variable, std::int32_t element, const NodalMotion& motion,
                                     std::span<const double> history, std::span<double> values) const {
  mean_of_points(values, integration_points(), [&](int point, std::span<double> at_point) {
    point_output(variable, element, point, motion, history, at_point);
  });
}

}  // namespace balocco
