// The elements of one type and one section on one rank, and the one force kernel that every solver drives.
//
// Nodal arrays are local to the rank and hold 4 doubles a node: x, y, z and a fourth that is zero, except in `force`, where the
// fourth is the node's rounding constant (math/exact_sum.hpp): a kernel adds rounded(f, force[4 * node + 3]) and never
// changes the fourth. Moments likewise, of nodes that turn alone (ElementType::turns). Elements are padded to whole packs; padded lanes repeat a real element and add their force to the
// scratch node behind the last real one.
//
// The history of a group is a structure of arrays, history[component * padded_size() + element]; functions that look at one
// element take that element's own history, its components one after the other (gather_history, scatter_history). Reference configuration of every kernel is
// Model::nodes.coordinates (total Lagrangian).
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "elements/nodal_motion.hpp"
#include "math/scalar.hpp"
#include "model/frequency_bound.hpp"
#include "model/model.hpp"

namespace balocco {

struct GroupInput {
  const Model& model;
  std::int32_t table = -1;                 // Model::elements[table]
  std::int32_t section = -1;               // Model::sections[section]
  std::vector<std::int32_t> rows;          // rows in the table; those that touch nodes shared with other ranks come first
  std::int32_t interface_count = 0;        // how many of `rows` touch shared nodes
  std::vector<std::int32_t> connectivity;  // local nodes, in the order of `rows`
  std::int32_t scratch_node = 0;           // local node that padded lanes may write to
};

/// What an explicit cycle hands to the kernels.
struct ExplicitCycle {
  NodalMotion motion;                // at the end of the increment
  NodalForces forces;                // INTERNAL force is SUBTRACTED: they accumulate external - internal
  double increment = 0.0;            // time over which the positions moved; 0: none yet (no rate effects)
  double linear_bulk_viscosity = 0.0, quadratic_bulk_viscosity = 0.0;
};

/// The smallest stable increment of a range of elements and who governs it.
struct StableIncrement {
  double increment = 1e300;
  std::int32_t element = -1;  // index in the group

  void merge(const StableIncrement& other) {
    if (other.increment < increment) *this = other;
  }
};

/// Energy of one element, in all.
struct ElementEnergies {
  double strain = 0.0;      // recoverable
  double hourglass = 0.0;   // artificial
  double viscous = 0.0;     // dissipated by bulk viscosity and stiffness-proportional damping
  double plastic = 0.0;     // dissipated by plasticity
  double heat = 0.0;        // work done by thermal expansion (EnergyDensity)
};

/// Bounds, over a step, of what an element without mass of its own (a spring, a dashpot) does to each node that it holds.
struct Restraint {
  double stiffness = 0.0;  // force per displacement, or moment per rotation
  double viscosity = 0.0;  // force per velocity, or moment per angular velocity
  double force = 0.0;      // or moment, of a table
};

/// Elements that touch nodes shared with other ranks, and the others.
enum class Portion { interface, interior };

/// Lanes first .. last - 1 of a group, whole packs.
struct PackRun {
  std::int32_t first = 0, last = 0;
};

/// The mean of what value_at(point, values) gives.
template <class ValueAt>
void mean_of_points(std::span<double> mean, int points, ValueAt value_at) {
  std::array<double, 16> at_point{};
  std::ranges::fill(mean, 0.0);
  for (int point = 0; point < points; ++point) {
    value_at(point, std::span(at_point).first(mean.size()));
    for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += at_point[c];
  }
  for (double& value : mean) value /= points;
}

class ElementGroup {
 public:
  explicit ElementGroup(const GroupInput& input);
  virtual ~ElementGroup() = default;

  std::int32_t table() const { return table_; }
  std::int32_t section() const { return section_; }
  std::int32_t size() const { return size_; }
  std::int32_t padded_size() const { return padded_size_; }
  /// Element of the table that lane `element` < padded_size() computes.
  std::int32_t row(std::int32_t element) const { return rows_[element]; }
  std::span<const std::int32_t> nodes(std::int32_t element) const {
    return {connectivity_.data() + element * nodes_per_element_, static_cast<std::size_t>(nodes_per_element_)};
  }
  int nodes_per_element() const { return nodes_per_element_; }
  /// 6 where the nodes turn (node by node: force, moment), else 3.
  int freedoms_per_node() const { return freedoms_per_node_; }
  /// Whether a moment of its own may act on its nodes number `end`.
  virtual bool turns_node([[maybe_unused]] int end) const { return freedoms_per_node_ == 6; }

  /// Doubles of history an element carries, and their values in the undeformed state (one element's own).
  virtual int history_size() const = 0;
  virtual void initialize_history(std::span<double> history) const = 0;

  /// History of the whole group in the undeformed state.
  std::vector<double> initial_history() const;
  /// Component of an element's history at which a field of its law's history (HistoryField) begins at a point; -1: it has none.
  virtual int law_field_row(std::string_view field, int point) const;
  /// Writes what Model::initial_fields say of these elements into the history of the group.
  void set_initial_fields(const Model& model, std::span<double> history) const;
  /// Copies the history of one element out of, or into, that of the group.
  void gather_history(std::int32_t element, std::span<const double> group_history, std::span<double> own) const;
  void scatter_history(std::int32_t element, std::span<const double> own, std::span<double> group_history) const;

  /// Each node's share of the reference volume of an element, and the density that makes lumped masses of it.
  virtual void lumped_volume(std::int32_t element, std::span<double> volume) const = 0;
  virtual double density() const = 0;
  void lumped_mass(std::int32_t element, std::span<double> mass) const;

  /// How many times its mass, and rotary inertia, each element has in explicit steps; empty: once. Their stable increments and bulk
  /// viscosity follow. lumped_mass() and what else statics ask for do not.
  void set_mass_scale(std::span<const double> scale);
  double mass_scale(std::int32_t element) const { return mass_scale_.empty() ? 1.0 : mass_scale_[element]; }
  /// While it records, add_forces() keeps the stable increment that each acting element has with its own mass.
  void record_increments(bool record);
  double recorded_increment(std::int32_t element) const { return recorded_increments_[element]; }
  /// That where what set_added_bounds() says falls, as the element's own bound does, with its mass scale.
  double recorded_increment_with_added_bound(std::int32_t element) const;
  /// The smallest recorded one, with the masses as they are scaled now.
  StableIncrement smallest_recorded_increment() const;

  /// What springs and contact add to each element, because they move the masses of its nodes; empty: nothing. The increments that
  /// add_forces() returns allow for it.
  void set_added_bounds(std::span<const FrequencyBound> added);

  /// Lumped rotary inertia of each node, the same about all axes (mass x length^2), raised for the explicit increment's sake; asked
  /// only where nodes turn.
  virtual void lumped_rotary_inertia(std::int32_t element, std::span<double> inertia) const;
  /// As the material has it: 3 x 3 a node, row-major, about global axes in the reference configuration.
  virtual void material_rotary_inertia(std::int32_t element, std::span<double> tensors) const;

  /// Which elements act in explicit cycles from now on, one flag an element; empty: all (as at first). The others rest, because
  /// one rigid body carries them or they are out of the model: they are not computed, bound no increment and keep their history.
  void set_acting(std::vector<bool> acting);
  /// Lanes < padded_size(); a padded lane does what the last element does.
  bool acts(std::int32_t lane) const { return acting_.empty() || acting_[lane]; }
  std::int32_t acting_count() const;

  /// Adds external - internal forces of the acting elements of a portion, updates their history in place and returns their
  /// smallest stable increment (2 / omega_max of a free element, with damping).
  StableIncrement add_forces(Portion portion, const ExplicitCycle& cycle, std::span<double> history) const;
  /// The kernel: all lanes of the runs, of which resting ones scatter to the scratch node (`scatter_`) and merge no increment
  /// (`merge`); what it does to their history is undone. Nothing allocates, throws or branches per element.
  virtual StableIncrement add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                                     std::span<double> history) const = 0;

  /// Internal force of one element (freedoms_per_node() a node: force, moment) where its nodes are, its exact derivative
  /// (row-major, square) unless `stiffness` is empty, and the history after an increment that started from `old_history`.
  /// Rates, where a force depends on them, are those of motion.velocity where motion.velocity_slope says how they go with positions,
  /// and means over motion.increment elsewhere. A derivative by a rotation is one by the spin d_theta in global axes: R <- exp(d_theta) R.
  /// @return false if the element is inverted (a Jacobian <= 0), with outputs unspecified.
  virtual bool linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                         std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const = 0;

  /// An element without mass has no stable increment of its own; the nodes that it holds have (explicit_restraints.hpp).
  virtual Restraint restraint(std::int32_t element) const;
  /// The same for rotations of its nodes, and moments.
  virtual Restraint rotary_restraint(std::int32_t element) const;
  /// Restraints that depend on where nodes are hold within a reach, which the history keeps: sets it about where they are, or takes it back
  /// from there; and whether an acting element has left it.
  virtual void set_reach(const NodalMotion&, std::span<double>) {}
  virtual void restore_reach(std::span<const double>) {}
  virtual bool is_beyond_reach(const NodalMotion&) const { return false; }

  virtual ElementEnergies energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history) const = 0;
  /// The same bits for as many lanes from `first` on, a whole pack's first lane, as `of_lanes` has room for: whole packs, padded
  /// lanes too; with the history of the whole group.
  virtual void energies(std::int32_t first, const NodalMotion& motion, std::span<const double> group_history,
                        std::span<ElementEnergies> of_lanes) const;

  /// Number of components of an output variable, 0 where the element has none: those of its points (S 6, LE 6, MISES 1, SENER 1,
  /// STH 1 ...) and the energies of the whole element, ELSE (elastic strain) and ELASE (artificial strain: hourglass).
  int output_components(std::string_view variable) const;
  /// Values of a variable at one integration point, tensors in order 11 22 33 12 13 23; whole-element variables are the same at each.
  void output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
              std::span<const double> history, std::span<double> values) const;
  /// The mean of that over the integration points.
  void mean_output(std::string_view variable, std::int32_t element, const NodalMotion& motion, std::span<const double> history,
                   std::span<double> values) const;
  virtual int integration_points() const = 0;

  /// Size of the force kernel's reference data, for the memory estimate.
  virtual std::size_t bytes_per_element() const = 0;

 protected:
  /// Square roots of the mass scales of the pack that starts at lane `first`: what mass s m does in time t, mass m does in
  /// t / sqrt(s). So kernels compute bulk viscosity and increments as in that time, and merge() takes increments back.
  const double* time_scale(std::int32_t first) const {
    return time_scale_.empty() ? unit_scale_.data() : time_scale_.data() + first;
  }
  /// Merges the increments of the pack that starts at lane `first`.
  template <PackOfLanes T>
  void merge(T increments, std::int32_t first, StableIncrement& smallest) const {
    if (adjusts_increments_) increments = adjusted(increments, first);
    if (all_of(increments >= T(smallest.increment))) return;
    for (int lane = 0; lane < pack_size; ++lane)
      if (acts(first + lane)) smallest.merge({increments[lane], first + lane});
  }

  /// Apart from the kernels that most groups go through: records increments, and adjusts them.
  template <PackOfLanes T>
  [[gnu::noinline]] T adjusted(T increments, std::int32_t first) const {
    if (records_increments_)
      for (int lane = 0; lane < pack_size; ++lane) recorded_increments_[first + lane] = increments[lane];
    if (!time_scale_.empty()) increments *= T([&](int lane) { return time_scale_[first + lane]; });
    if (added_bounds_.empty() || !added_to_pack_[first / pack_size]) return increments;
    return T([&](int lane) { return allowing_for(added_bounds_[first + lane], double{increments[lane]}); });
  }
  static double allowing_for(const FrequencyBound& added, double increment);

  virtual int point_components(std::string_view variable) const = 0;
  virtual void point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                            std::span<const double> history, std::span<double> values) const = 0;
  /// Groups whose points share work override it.
  virtual void mean_point_output(std::string_view variable, std::int32_t element, const NodalMotion& motion,
                                 std::span<const double> history, std::span<double> values) const;

  std::int32_t table_, section_, size_, padded_size_, interface_padded_;
  int nodes_per_element_, freedoms_per_node_;
  std::vector<std::int32_t> rows_;          // padded
  std::vector<std::int32_t> connectivity_;  // padded, scratch node never inside: padded lanes GATHER from a real element
  std::vector<std::int32_t> scatter_;       // as connectivity_, but padded and resting lanes point to the scratch node

 private:
  /// What a portion computes: packs in which an element acts, and the resting lanes among them.
  struct Work {
    std::vector<PackRun> runs;
    std::vector<std::int32_t> resting;
  };
  Work work_of(std::int32_t first, std::int32_t last) const;
  void decide_adjusting();

  std::int32_t scratch_node_;
  std::vector<bool> acting_;  // padded; empty: all
  Work interface_work_, interior_work_;
  mutable std::vector<double> kept_history_;  // of resting lanes while their pack is computed
  static constexpr std::array<double, pack_size> unit_scale_ = [] {
    std::array<double, pack_size> units{};
    units.fill(1.0);
    return units;
  }();
  std::vector<double> mass_scale_, time_scale_;  // padded; empty: all 1
  std::vector<FrequencyBound> added_bounds_;     // padded; empty: nothing is added
  std::vector<bool> added_to_pack_;              // to any of its lanes
  bool records_increments_ = false;
  bool adjusts_increments_ = false;  // any of the three
  mutable std::vector<double> recorded_increments_;  // padded
};

}  // namespace balocco
