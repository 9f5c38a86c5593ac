// Contact of the nodes of a deformable surface with a rigid surface, analytical or of facets: finite sliding, Coulomb friction with
// elastic stick, one force law for the implicit and the explicit solver, so that contact forces import exactly.
//
// Normal force of a node: t = max(0, multiplier - stiffness * gap) (gap < 0: penetration). The multiplier is zero
// unless the implicit solver augmented it. Friction: tangential spring from the anchor, cut at mu * t, or, where the deck gives an
// ELASTIC SLIP, of the stiffness mu * t / elastic slip where that is less. It is as stiff as the normal spring. Springs that an
// explicit cycle must follow have the stiffness of the pair; those of the implicit solver and the stiff ones of explicit steps are 20
// times as stiff. Where the deck gives a law of pressure over overclosure (model/pressure_law.hpp) the normal spring is that, in all steps:
// nothing is augmented and no spring is stiffer.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "communicator.hpp"
#include "contact_law.hpp"
#include "domain.hpp"
#include "master_surface.hpp"
#include "model/model.hpp"
#include "model/results.hpp"
#include "model/state.hpp"

namespace balocco {

struct MasterFrame;

/// Force of one contact point and its derivatives, for assembly by the implicit solver.
struct ContactTangent {
  std::int32_t node = -1;  // local slave node
  bool closed = false;
  std::array<double, 3> force{};           // on the slave node; the master gets the opposite at the same place
  std::array<double, 3 * 9> derivative{};  // d force / d (node position 3, master position 3, master spin 3), row-major
  Vector3<double> slip{};                  // over the increment, in global directions
};

/// How a slave node answers to a force in an explicit cycle: as a free mass, but for the directions in which its velocity over
/// the next increment is prescribed.
struct SlaveFreedom {
  double inverse_mass = 0.0;  // 0: it moves as something else wants
  int held = 0;
  std::array<Point, 3> direction{};
  std::array<double, 3> velocity{};

  /// Such a node can bear a spring that an explicit cycle could not follow.
  bool yields() const { return inverse_mass > 0.0 && held < 3; }
};

/// What the stiff springs of a pair see of a cycle: nodal arrays (4 a node) and the increments before and behind the instant.
struct StiffCycle {
  const double* position = nullptr;
  const double* velocity = nullptr;  // over the increment before
  double previous = 0.0, next = 0.0;
};

class RigidContact {
 public:
  /// Of a pair whose master deforms (mesh_contact.hpp): no points.
  RigidContact() = default;
  /// Nodes of the slave surface on this rank, each with its tributary area and penalty stiffness, computed from the
  /// whole model so that every copy of a node has the same bits. @throws InputError where the surfaces cannot form a
  /// pair (slave without faces or nodes, master not rigid or on no rigid body, slave facing away from the master
  /// everywhere: normals tell).
  RigidContact(const Model& model, std::int32_t pair, const Domain& domain);

  std::int32_t size() const { return static_cast<std::int32_t>(nodes_.size()); }
  std::span<const std::int32_t> nodes() const { return nodes_; }  // local slave nodes
  std::int32_t master_body() const { return master_body_; }       // row of Model::rigid_bodies; -1: the master deforms
  double area(std::int32_t point) const { return area_[point]; }
  double normal_stiffness(std::int32_t point) const { return stiffness_[point]; }
  /// From now on the points press and rub so.
  void set_interaction(const Interaction& interaction);
  void set_friction(double coefficient) { friction_ = coefficient; }
  /// Whether the deck gives a law of pressure, which is not augmented then and has no stiff springs.
  bool is_soft() const { return law_.is_soft(); }

  /// At the start of a step: points of a pair that is not `active` open, and open points stand over the surface where
  /// they are, so that nothing is remembered from before a pair rested. Slip and dissipation stay.
  void start_step(const double* position, const RigidBodyState& master, bool active,
                  std::vector<ContactPoint>& points) const;

  /// Explicit: adds the contact force of every slave node on this rank (copies of shared nodes compute the same bits)
  /// to `force`, rounded with each node's constant, and advances the points. Call between Halo::begin_sum and
  /// finish_sum.
  void add_forces(const double* position, const RigidBodyState& master, std::vector<ContactPoint>& points,
                  double* force) const;

  /// Where a step brings another law of pressure: closed points begin with that alone.
  void forget_springs(bool implicit, std::vector<ContactPoint>& points) const;
  /// Gives all points the springs of the implicit solver; the force of a closed point stays.
  void choose_implicit_springs(const double* position, const RigidBodyState& master, std::vector<ContactPoint>& points) const;
  /// Those of an explicit step: the stiff spring to points that `stiff` names, that of the pair to the others. As above.
  void choose_springs(const double* position, const RigidBodyState& master, const std::vector<bool>& stiff,
                      std::vector<ContactPoint>& points) const;

  /// Explicit: as add_forces, for the points with stiff springs, which add_forces leaves out. `force` must be whole (all ranks
  /// and sources), `freedom` has an entry a point. A multiplier from statics ends with the contact: it shrinks
  /// when its point rises. Friction is part of it, as stiff as the normal spring but for an ELASTIC SLIP of the deck.
  void add_stiff_forces(const StiffCycle& cycle, const RigidBodyState& master, std::span<const SlaveFreedom> freedom,
                        std::vector<ContactPoint>& points, double* force) const;

  /// Deepest point below the surface on this rank, of those that are open or of all.
  struct Deepest {
    double depth = 0.0;
    std::int32_t node = -1;  // local
  };
  enum class Which { open, all };
  Deepest deepest(const double* position, const RigidBodyState& master, const std::vector<ContactPoint>& points,
                  Which which) const;
  /// Whether a closed point on this rank stands where the master's profile had ended.
  bool past_end(const double* position, const RigidBodyState& master, const std::vector<ContactPoint>& points) const;

  /// Sum of the forces on the master body and of their moments about its reference node, over the slave nodes owned by
  /// this rank, exact in any order. For masters that are free to move.
  void add_master_resultant(const double* position, const RigidBodyState& master,
                            const std::vector<ContactPoint>& points, std::span<ExactSum, 6> force_and_moment) const;

  /// Implicit: force and derivative of one point whose history at the start of the increment is `old`; `updated`
  /// receives the history. `sticks`: the derivative is that of a point that sticks, sliding or not, about the same force; so it is
  /// where friction turned back since `last_slip`: the point went past the place where it sticks, of which sliding tells nothing.
  ContactTangent linearize(std::int32_t point, const double* position, const RigidBodyState& master, const ContactPoint& old,
                           ContactPoint& updated, bool sticks = false, const Vector3<double>& last_slip = {}) const;

  /// Augmented Lagrange: adds the spring's part to the multipliers, and changes nothing else, so that `points` may be
  /// the history at the start of the increment that is being solved. @return greatest gap or penetration of a closed
  /// point on this rank before the update.
  double augment(const double* position, const RigidBodyState& master, std::vector<ContactPoint>& points) const;
  /// Takes from the multipliers what pushes across a gap.
  void lower_multipliers(const double* position, const RigidBodyState& master, std::vector<ContactPoint>& points) const;

  /// Gap, pressure and tangential traction of a point, and its forces (global directions, on the slave), for output.
  /// The energy is what both springs hold. A point that `state` says is open has no force, wherever it is: its pair may
  /// not be active.
  struct Output {
    double gap = 0.0, pressure = 0.0, shear = 0.0, slip = 0.0;
    Point normal_force{}, friction_force{};
    double spring_energy = 0.0;
  };
  Output output(std::int32_t point, const double* position, const RigidBodyState& master,
                const ContactPoint& state) const;

  /// Resultant over all ranks. Collective, exact.
  ContactResultant resultant(const Communicator& communicator, const double* position, const RigidBodyState& master,
                             const std::vector<ContactPoint>& points) const;

  /// Adds the stiffness of the springs that an explicit cycle must follow to `sum` (one a node): of points that `stiff` does not
  /// name.
  void add_spring_stiffness(const std::vector<bool>& stiff, std::span<double> sum) const;

 private:
  /// Of the spring that `state` has.
  PenaltyParameters parameters(std::int32_t point, const ContactPoint& state) const {
    const double chosen = std::max(state.stiff_spring, state.implicit_spring);  // one of them is zero
    return {.stiffness = chosen > 0.0 ? chosen : stiffness_[point],
            .friction = friction_,
            .elastic_slip = elastic_slip_,
            .shear_limit = shear_stress_limit_ * area_[point],
            .law = is_curved() ? &law_ : nullptr,
            .area = area_[point],
            .straight_from = state.implicit_spring > 0.0 ? std::numeric_limits<double>::infinity() : straight_from_[point]};
  }
  /// Force of a point whose history `state` is up to date.
  ContactForce<double> acting_force(std::int32_t point, const Vector3<double>& place, const ContactPoint& state) const;
  struct StiffMotion;
  /// Stiffnesses as ContactPoint has them.
  struct Springs {
    double stiff = 0.0, implicit = 0.0;
  };
  void change_springs(const MasterFrame& frame, const double* position, std::int32_t point, const Springs& springs,
                      ContactPoint& state) const;
  void keep_force(std::int32_t point, const Vector3<double>& place, const Springs& springs, ContactPoint& state) const;
  bool is_curved() const { return law_.is_soft() && law_.kind != PressureLaw::Kind::linear; }
  double implicit_spring(std::int32_t point) const {
    if (!is_soft()) return stiff_factor * stiffness_[point];
    return is_curved() ? stiffness_[point] : 0.0;
  }
  void choose_soft_spring(std::int32_t point, const Vector3<double>& place, double spring, ContactPoint& state) const;
  void add_stiff_force(std::int32_t point, const StiffCycle& cycle, const RigidBodyState& master,
                       const SlaveFreedom& freedom, ContactPoint& state, double* force) const;
  void advance_stiff_friction(std::int32_t point, const MasterFrame& frame, const StiffMotion& motion, const SlaveFreedom& freedom,
                              const SurfacePoint<double>& nearest, double old_pressure, ContactPoint& state) const;

  std::int32_t master_body_ = -1;
  MasterSurface surface_;
  std::vector<std::int32_t> nodes_;  // in the order of their model rows
  std::vector<bool> owned_;
  std::vector<double> area_, stiffness_, straight_from_;
  std::vector<double> penalty_;  // stiffness of hard contact, with:
  double penalty_scale_ = 1.0;
  PressureLaw law_;
  double friction_ = 0.0, elastic_slip_ = 0.0, shear_stress_limit_ = std::numeric_limits<double>::infinity();
};

}  // namespace balocco
