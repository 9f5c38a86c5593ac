// The discrete equations of an implicit step: residual forces and their exact stiffness at the positions of the state,
// reduced to the free slots (rigid bodies eliminated with finite rotations); of a dynamic one with inertia.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "alpha_method.hpp"
#include "guide_laws.hpp"
#include "implicit_dof_map.hpp"
#include "implicit_slot_exchange.hpp"
#include "implicit_stiffness.hpp"

namespace balocco {

struct AssemblyRequest {
  double step_time = 0.0, total_time = 0.0;
  double increment = 0.0;       // time that the increment takes; 0: none yet, no rate effects
  bool inertia = true;         // dynamic: the weighted forces of the alpha method with inertia; false: the forces alone
  bool initial_loads = false;  // loads as they stood before the step began
  bool load_stiffness = true;  // follower pressure; a linear step leaves it out
  bool arms_turn = true;       // with rigid bodies, and with them the moments of forces on carried nodes; likewise
  bool contact_sticks = false;  // closed points with friction stick in the stiffness, sliding or not
  std::span<const double>
      motion;                   // of each slot: stiffness().product() will hold this rank's part of stiffness * motion
  double viscosity = 0.0;       // viscous force / (mass * displacement since the increment began)
  double regularization = 0.0;  // stiffness added to every free slot (times its lever squared), without a force
};

class ImplicitSystem {
 public:
  /// Collective.
  ImplicitSystem(Analysis& analysis, const Step& step, std::span<const std::int32_t> prescribed);

  /// Residual, loads and stiffness at the current positions, with the histories that would follow. @return false, on
  /// every rank, if an element is inverted or a force is not finite: trouble() says which. Collective.
  bool assemble(const AssemblyRequest& request);
  const std::string& trouble() const { return trouble_; }

  /// Internal - external - contact forces in the slots' directions, carried nodes gathered at their reference node;
  /// zero in absent slots. Stabilising forces are included.
  const std::vector<double>& residual() const { return residual_; }
  /// The same forces as they are at the end of the increment, without weights and inertia; dynamic: without those of contact, which are
  /// apart.
  const std::vector<double>& forces() const { return dynamics_ ? forces_ : residual_; }
  const std::vector<double>& contact_forces() const { return contact_force_; }
  /// Loads on each node, also on carried ones, and moments on bodies, in global directions.
  const std::vector<double>& external() const { return external_; }
  /// Average magnitude of the nodal forces of the elements, over all ranks.
  double average_force() const { return average_force_; }
  /// Points of all ranks whose friction turned back since the last correction. The stiffness has them stick.
  std::int64_t turned_points() const { return turned_points_; }
  /// This rank's part of what the residual of each slot would have more if their springs held them wherever they are.
  std::vector<double>& sticking() { return sticking_; }
  /// Contact points of all ranks that are closed in the trial, and how many changed since the last assembly.
  std::int64_t closed_points() const { return closed_points_; }
  std::int64_t changed_points() const { return changed_points_; }

  /// Dynamic: what inertia adds to the residual, for the motion that dynamics() found last. Collective.
  const std::vector<double>& find_inertia();

  const ImplicitDofMap& map() const { return map_; }
  ImplicitStiffness& stiffness() { return stiffness_; }
  SlotExchange& exchange() { return exchange_; }
  /// Null where the step is at rest.
  AlphaMethod* dynamics() { return dynamics_.get(); }

  /// Moves nodes and bodies by `factor` times an increment of the slots.
  void move(std::span<const double> increment, double factor);
  /// Displacement or rotation of a slot from the reference configuration.
  double displacement(std::int32_t slot) const;
  /// Displacement or rotation, over the increment so far, of what a slot belongs to; global directions.
  Point moved(std::int32_t slot) const;
  Configuration configuration() const;
  void restore(const Configuration& configuration);
  /// The reference configuration, with the nodes that bodies carry now.
  Configuration reference() const;
  /// Puts nodes and bodies where a linear displacement of the slots from the reference configuration takes them.
  void displace(std::span<const double> displacement);

  /// Marks the current positions as the start of an increment, and forgets trial histories.
  void begin_increment();
  /// Tells that the last assembly is where the next correction starts from.
  void begin_iteration();
  const Configuration& start_of_increment() const { return start_; }
  /// Makes the trial's histories those of the state.
  void commit();
  /// Whether a slot is the multiplier of a guide.
  bool is_guided(std::int32_t slot) const;
  /// Work over the increment of what drives, loads and rubs connectors.
  void add_guide_work();
  /// Greatest gap or penetration of a slave node that contact pushes. Collective.
  double greatest_misfit() const;
  /// Adds the present spring forces to the multipliers from which the increment's contact starts.
  void augment_contact();
  /// Whether a point is closed where the increment starts. Collective.
  bool starts_in_contact() const;
  bool has_contact() const { return !step_.active_contact_pairs.empty(); }
  /// Edge length of the area that a slave node stands for: the average of all ranks. Collective.
  double contact_length() const;

  /// Mass that stabilisation gives a slot: the node's, the average where it has none; rotations: times the lever
  /// squared.
  double stabilizing_mass(std::int32_t slot) const { return mass_[slot]; }
  /// What turns a slot's rotation into a length: the longest arm of the body (the size of the model for bodies without
  /// nodes), of a node the longest edge of the elements that turn it; 1 for displacements.
  double lever(std::int32_t slot) const { return lever_[slot]; }
  double model_size() const { return model_size_; }

 private:
  void record_pattern();
  void add_elements(double increment, bool& sound);
  void add_element(std::size_t group, std::int32_t element, const NodalMotion& motion, bool& sound);
  void add_loads(const AssemblyRequest& request);
  template <class Load>
  double magnitude_of(const Load& load, const AssemblyRequest& request) const;
  void add_surface_load_stiffness(const AssemblyRequest& request);
  void add_body_load_stiffness(const AssemblyRequest& request);
  void add_follower_stiffness(const AssemblyRequest& request);
  /// Displacement and spin of the node of a concentrated load that follows; none where another rank owns it.
  std::optional<std::array<NodeMotion, 2>> followed_motion(const ConcentratedLoad& load) const;
  /// Calls visit(local node, load, share) for the loads whose force depends on the place, always in the same order.
  template <class Visit>
  void for_each_spun_node(Visit visit) const {
    for (const auto& load : step_.body_loads) {
      if (load.kind != BodyLoad::Kind::centrifugal) continue;
      const auto& share = analysis_.loaded_share(load);
      for (std::int32_t node = 0; node < analysis_.domain.size(); ++node)
        if (share[node] != 0.0) visit(node, load, share[node]);
    }
  }
  void record_contact();
  void follow_faces();
  void add_contact(bool sticks);
  void add_contact_point(std::int32_t pair, std::int32_t point, bool sticks);
  void add_contact_place(std::int32_t pair, std::int32_t place, bool sticks);
  void count_points(const std::vector<std::vector<ContactPoint>>& before);
  void lower_multipliers();
  /// Calls visit(pair, contact, point or place, whether this rank adds its forces) for all that contact may push, of either kind of master.
  template <class Visit>
  void for_each_contact(Visit visit) const;
  void record_constraints();
  void add_constraints();
  void add_constraint(std::size_t local_constraint);
  void add_slack(std::size_t local_constraint);
  void follow_guides(std::int32_t constraint, std::size_t rows);
  /// Calls add(nodes of the constraint) for the blocks of which its tangent consists, motions_ being theirs, always in the same order.
  template <class Add>
  void for_each_constraint_block(std::size_t local_constraint, Add add);
  void add_stabilization(const AssemblyRequest& request);
  void add_dynamics(const AssemblyRequest& request);
  void gather_at_bodies(std::vector<double>& forces, bool with_stiffness = true);
  /// visit(spin, its first slot) of the nodes and bodies of this rank that turn by themselves.
  template <class Visit>
  void for_each_spin(Visit visit) const {
    for (std::int32_t node = 0; node < analysis_.domain.turning; ++node)
      if (analysis_.domain.owned[node] && analysis_.turning_body(node) < 0) visit(map_.nodal_spin(node), map_.slot(node, 3));
    for (std::int32_t body = 0; body < static_cast<std::int32_t>(analysis_.model.rigid_bodies.size()); ++body)
      if (map_.owned(map_.rotation_slot(body, 0))) visit(map_.spin(body), map_.rotation_slot(body, 0));
  }
  void add_half_residual_turns();
  void turn_into_slot_directions(std::vector<double>& forces) const;
  bool everywhere_sound(bool sound);
  void leave_out_initial_stress(std::size_t group, std::int32_t element, const NodalMotion& motion);
  std::vector<int> unstiffening_rows(const ElementGroup& group, const Step& step) const;
  void find_levers();
  void find_stabilizing_masses();
  std::span<const NodeMotion> motions_of(std::span<const std::int32_t> nodes);
  /// Displacements of an element's nodes, each followed by its spin where they turn.
  std::span<const NodeMotion> motions_of(const ElementGroup& group, std::int32_t element);
  bool moves_as_one(const ElementGroup& group, std::int32_t element) const;

  Analysis& analysis_;
  const Step& step_;
  ImplicitDofMap map_;
  SlotExchange exchange_;
  ImplicitStiffness stiffness_;
  GuideLaws guides_;
  /// Per element group: where initial stresses are that do not stiffen, as they do not in linear steps but perturbations.
  std::vector<std::vector<int>> unstiffening_rows_;
  Configuration start_;
  std::vector<std::vector<double>> trial_history_;
  std::vector<std::vector<ContactPoint>> start_contact_, trial_contact_;
  /// Slips of a contact point in the last assembly, and where the last correction started from: zero if that had it stick.
  struct Slips {
    Vector3<double> now{}, before{};
    bool turns_back() const { return dot(now, before) < 0.0; }
  };
  std::vector<std::vector<Slips>> slips_;
  std::vector<std::vector<MeshPairing>> pairings_;  // of deformable masters, as the pattern of the stiffness has them
  std::vector<double> sticking_;
  std::unique_ptr<AlphaMethod> dynamics_;
  std::vector<double> residual_, external_, mass_, lever_;
  std::vector<double> forces_, contact_force_, inertia_;  // dynamic
  double model_size_ = 1.0;
  double average_force_ = 0.0;
  std::array<double, 2> force_sum_{};  // of magnitudes, and how many
  std::int64_t closed_points_ = 0, changed_points_ = 0, turned_points_ = 0;
  std::int64_t inverted_element_ = -1;
  std::string trouble_;
  std::vector<NodeMotion> motions_;                                        // scratch
  MeshTangent mesh_tangent_;                                               // scratch
  std::vector<double> old_history_, new_history_, force_, other_force_, block_;  // scratch
  std::vector<double> nodal_, nodal_moment_;                       // scratch
  std::vector<NodePlace> places_;                                  // scratch
  std::vector<double> gaps_, gradient_, curvature_;                // scratch
  std::vector<bool> holds_;                                        // scratch: rows of a constraint
};

}  // namespace balocco
