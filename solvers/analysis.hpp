// What every procedure works on for the life of a run on one rank: domain, element groups, contact, state.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "communicator.hpp"
#include "constraints/constraint.hpp"
#include "constraints/nodal_directions.hpp"
#include "domain.hpp"
#include "elements/small_strain_output.hpp"
#include "loads/surface_loading.hpp"
#include "lumped_inertia.hpp"
#include "model/model.hpp"
#include "model/results.hpp"
#include "model/state.hpp"
#include "mesh_contact.hpp"
#include "rigid_contact.hpp"

namespace balocco {

/// Padded lanes repeat the last element: their history follows its.
void repeat_in_padded_lanes(const ElementGroup& group, std::span<double> history);

class Analysis : public ResultSource {
 public:
  /// Builds groups, masses, contact and the undeformed state. @throws InputError on every rank alike.
  Analysis(const Model& model, const Communicator& communicator, const Partitioner& partitioner = metis_partition);

  const Model& model;
  const Communicator& communicator;
  Domain domain;
  std::vector<std::unique_ptr<ElementGroup>> element_groups;
  std::vector<RigidContact> contacts;              // per Model::contact_pairs, empty where the master deforms
  std::vector<MeshContact> mesh_contacts;          // likewise, empty where the master is rigid
  std::vector<std::unique_ptr<Constraint>> constraints;  // per Model::constraints
  std::vector<std::int32_t> first_constraint_row;        // of each constraint in State::multiplier, and how many rows there are
  std::vector<std::int32_t> local_constraints;           // those whose nodes are all on this rank, in order
  /// What a load of a step does on its surface; loads that differ in magnitude alone share it.
  const SurfaceLoading& loading(const SurfaceLoad& load) const;
  LumpedInertia inertia;                           // as materials and sections give it, summed over ranks (order-free)
  /// As the explicit loop has it: with the elements' mass scales.
  const LumpedInertia& scaled_inertia() const { return scaled_inertia_.mass.empty() ? inertia : scaled_inertia_; }
  /// ROTARYI elements on nodes that turn: inertia about the node in the reference configuration, global axes.
  struct RotaryTensor {
    std::int32_t node = -1;     // local
    std::int32_t section = -1;  // row of Model::sections
    Matrix3<double> tensor{};
  };
  std::vector<RotaryTensor> rotary_tensors;
  double undeformed_increment = 1e300;             // smallest stable increment of the undeformed elements, over all ranks
  NodalDirections directions;
  std::vector<Mode> modes;                         // of the last frequency step of this run
  std::int32_t step_of_modes = -1;                 // that step's row of Model::steps
  State current;

  /// What happens once when a step starts afresh: attaches and releases what it says, from where the nodes stand; contact
  /// pairs that rest in it forget what they knew. Collective.
  void start_step(const Step& step);
  /// Gives contact pairs the interactions that they have in the current step, also where a step goes on after a restart.
  void apply_interactions();
  /// Coulomb's coefficients at a time of the current step.
  void follow_friction(double step_time);
  /// False for an element that *MODEL CHANGE has taken out of the model in the current step: it has no force and no energy, only mass.
  bool takes_part(const ElementGroup& group, std::int32_t element) const;
  /// False for a constraint that *EQUATION, REMOVE has taken out of the current step.
  bool holds(std::int32_t constraint) const;
  /// Body that carries a local node, or -1. Reference nodes are not carried.
  std::int32_t carrier(std::int32_t local_node) const { return carrier_[local_node]; }
  /// Body that turns a local node: it is tied, or the reference node; or -1.
  std::int32_t turning_body(std::int32_t local_node) const { return turning_body_[local_node]; }
  /// Body whose reference node is this local node, or -1.
  std::int32_t reference_of(std::int32_t local_node) const { return reference_of_[local_node]; }
  /// What a body load acts on: the nodal mass, or reference volume, of its element set, on the nodes that this rank owns, zero
  /// elsewhere; of quadratic elements the consistent one in implicit steps. Collective when it is first asked for.
  const std::vector<double>& loaded_share(const BodyLoad& load) const;
  /// Rebuilds what follows from the state, after a checkpoint was read.
  void take_up_checkpoint();
  /// Gives elements and nodes the masses that State::mass_scale says. Collective.
  void apply_mass_scale();
  /// Rebuilds carrier() and tells the groups which elements act, from the state: after attachments.
  void index_rigid_nodes();
  /// Where the nodes of a local constraint are.
  void find_places(std::int32_t constraint, std::vector<NodePlace>& places) const;
  NodePlace place_of(std::int32_t row) const;  // of a node of the model that this rank has
  /// Puts the carried nodes where their bodies are.
  void place_rigid_nodes(std::vector<double>& position) const;

  /// Accelerations and net nodal forces of the last increment, set by the procedures for output. A, RF = -(external loads + internal).
  std::vector<double> acceleration;    // 4 a node
  std::vector<double> reaction;        // 4 a node: force that constraints exert
  std::vector<double> angular_acceleration, reaction_moment;  // 4 a node that turns
  std::vector<std::array<double, 6>> body_reaction;      // per rigid body: reaction force and moment at the reference node
  std::vector<Point> body_angular_acceleration;          // per rigid body
  double output_increment = 0.0;       // explicit: the increment across which they accelerate
  std::optional<double> kinetic_energy;  // implicit dynamics: of this rank's consistent mass; none: that of the lumped one
  /// Explicit: work that State::nodal_work already counts although it belongs to the first half of the increment to come, as
  /// velocities do; per local node, filled with the other output.
  std::vector<NodalWork> work_ahead;

  const State& state() const override { return current; }
  std::span<const std::unique_ptr<ElementGroup>> groups() const override { return element_groups; }
  int nodal_components(std::string_view variable) const override;
  void nodal(std::string_view variable, std::span<double> values) const override;
  void element(std::size_t group, std::string_view variable, std::int32_t element, int integration_point,
               std::span<double> values) const override;
  void element_mean(std::size_t group, std::string_view variable, std::int32_t element, std::span<double> values) const override;
  /// Internal force of an element where the state stands, freedoms_per_node() a node; of small strain after linear steps.
  void internal_force(std::size_t group, std::int32_t element, std::span<double> force) const;
  EnergyBalance energies() const override;
  ContactResultant contact(std::int32_t pair) const override;
  std::vector<ContactPlace> contact_places(std::int32_t pair) const override;
  /// What elements show with a linear state: of a perturbation see SmallStrainOutput::perturb().
  SmallStrainOutput& small_strain() const;

 private:
  struct SampledEnergies {
    std::int32_t step = -1;
    std::int64_t increment = -1;
    EnergyBalance balance;
  };

  bool stays_linear(const Step& step) const;
  void leave_linear_geometry(const Step& step);
  void make_local_constraints();
  void make_surface_loadings();
  /// Adds what a connector's constraints exert to a total force CTF (as of a spring that is pulled), or to a part of it: CRF of what holds,
  /// stops (friction at the stop included), locks or drives it, CSF of friction, CCF of loads.
  void add_connector_forces(ElementRef connector, std::string_view variable, std::span<double> values) const;
  template <class Visit>
  void for_each_energies(std::size_t group, Visit visit) const;
  EnergyBalance sum_energies() const;
  void apply_attachments(const Step& step);
  void find_acting_elements();
  void add_kinetic_energy(ExactSum& sum) const;
  void add_kinetic_energy_of_rotary_inertia(ExactSum& sum) const;
  void collect_rotary_tensors();

  InertiaSums inertia_sums_;
  std::vector<std::pair<SurfaceLoad, std::unique_ptr<SurfaceLoading>>> surface_loadings_;
  LumpedInertia scaled_inertia_;  // empty: as `inertia`
  std::vector<std::int32_t> carrier_, reference_of_, turning_body_;
  std::map<ElementRef, std::vector<std::int32_t>> constraints_of_connector_;
  double mass_constant_ = 0.0;  // rounds shares of nodal masses
  /// By element set, whether mass, and whether consistent.
  mutable std::map<std::tuple<std::int32_t, bool, bool>, std::vector<double>> loaded_share_;
  mutable SampledEnergies sampled_;  // histories, status and checks of one increment share a sample
  mutable std::unique_ptr<SmallStrainOutput> small_strain_;  // made when a linear state is first asked for output
};

}  // namespace balocco
