// Everything that a later step needs, and nothing else. Arrays are local to the rank; checkpoints store them in deck order.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "elements/nodal_motion.hpp"
#include "model/frequency_bound.hpp"
#include "model/model.hpp"

namespace balocco {

/// A node carried by a rigid body: its offset from the reference node in the body's frame.
struct RigidNode {
  std::int32_t node = -1;  // model row
  bool tie = true;         // a tied node also turns with the body
  Point offset{};
};

/// Motion of a rigid body, the same on every rank. The body frame coincides with the global one when `orientation` is 1,0,0,0.
struct RigidBodyState {
  Point position{};                          // of the reference node
  std::array<double, 4> orientation{1, 0, 0, 0};  // unit quaternion w, x, y, z
  Point velocity{}, angular_velocity{};      // half-step values, global directions
  Point rotation{};                          // accumulated rotation vector UR of the reference node (may exceed a turn)
  std::vector<RigidNode> nodes;              // sorted by model row
};

/// Memory of a contact point: a slave node, or a point of a slave face.
struct ContactPoint {
  double multiplier = 0.0;  // augmented-Lagrange normal force carried over from the implicit solver, >= 0
  double closed = 0.0;      // 1 while in contact
  Point anchor{};           // in the frame of the master body: sticking point; of an open point: where it is;
                            // of a deformable master: face of its surface (-1: none is near), and xi, eta there
  double slip = 0.0;        // accumulated sliding distance
  double frictional_dissipation = 0.0;
  double stiff_spring = 0.0;  // explicit: normal stiffness that `multiplier` goes with; 0: that of the pair
  double stiff_force = 0.0;   // and its force at the last instant, which where the point is does not tell
  Point stiff_friction{};     // and that of friction, on the slave, in the frame of the master body; of a deformable master: by how
                              // much the place has slipped, as a vector
  double implicit_spring = 0.0;  // implicit: stiffness that `multiplier` and `anchor` go with; 0: as for `stiff_spring`
};

/// What the alpha method of implicit dynamics goes on from, of three freedoms: global directions but for the force.
struct AlphaMemory {
  Point acceleration{};  // or angular acceleration
  Point force{};         // internal - external at the end of the last increment, or moment, in the freedoms' directions
};

/// Work done on a node, by kind: up to now, explicit: up to the middle of the increment to come. Copies of a shared node hold the same bits; sums are taken over owners.
struct NodalWork {
  double external = 0.0;  // loads, prescribed motion and reactions
  double damping = 0.0;   // mass-proportional Rayleigh damping; hits of stops of connectors
  double friction = 0.0;  // in connectors
  double mass_scaling = 0.0;  // kinetic energy that came with mass added to what moves
};

struct State {
  double total_time = 0.0;
  std::int32_t step = 0;            // row of Model::steps that is running or comes next
  double step_time = 0.0;           // time passed in it
  std::int64_t increment = 0;       // increments done in it
  bool dynamic = false;             // true once initial velocities have been applied
  double energy_at_start = 0.0;     // explicit: ETOTAL when the step began
  double largest_energy = 0.0;      // explicit: EnergyBalance::magnitude() at its largest in the step, as far as it was sampled
  // Explicit: bounds of springs and dashpots (explicit_time.hpp) when the step began, or masses were scaled last:
  double restraint_omega_square = 0.0, restraint_rate = 0.0;
  double restraint_increment = 0.0;  // explicit: what they allowed when the step began
  double least_stable = 0.0;        // explicit: smallest increment that was stable since the last look at raising it; 0: none yet
  double time_increment = 0.0;      // of the increment to come (static: as suggested), 0 at the end of a step
  bool linear = true;               // only geometrically linear steps so far: positions are the reference's + linear displacements
  bool easy = false;                // static: the last increment converged fast

  std::vector<double> position;     // 4 a node, one scratch node more than the domain has
  std::vector<double> velocity;     // 4 a node; explicit: in the middle of the increment to come
  // Nodes that turn, the first Domain::turning, have 4 values each of these:
  std::vector<double> orientation;       // unit quaternion w x y z of the rotation from the reference configuration
  std::vector<double> angular_velocity;  // global directions; explicit: in the middle of the increment to come
  std::vector<double> rotation;          // accumulated rotation vector UR (may exceed a turn)
  std::vector<NodalWork> nodal_work;
  std::vector<std::vector<double>> element_history;       // per element group
  std::vector<std::vector<double>> mass_scale;  // explicit: per element group, of each element; empty: all have their own mass
  /// Explicit: per element group, what springs and dashpots added to each element when the step began, or masses were scaled last;
  /// empty: nothing.
  std::vector<std::vector<FrequencyBound>> restrained;
  std::vector<std::vector<ContactPoint>> contact;         // per contact pair, per local point
  std::vector<RigidBodyState> rigid_bodies;
  // Of constraints, kept by the ranks that hold their nodes:
  std::vector<double> multiplier;          // per row of the model's constraints: force against its gradient, as of a spring that is pulled
  std::vector<double> guide_motion;        // per row: of guides the relative motion, angles counted on beyond half a turn
  std::vector<double> guide_locked;        // per row: 1 where a *CONNECTOR LOCK holds it
  std::vector<std::int32_t> implied_rows;  // explicit: rows that others implied when the step began, which are not solved for
  // Implicit dynamics, empty unless such a step has gone on: of nodes; of nodes that turn; of rigid bodies' rotations.
  std::vector<AlphaMemory> alpha_memory, alpha_memory_of_spins, alpha_memory_of_bodies;

  NodalMotion motion() const {
    return {.position = position.data(),
            .velocity = velocity.data(),
            .orientation = orientation.data(),
            .angular_velocity = angular_velocity.data(),
            .rotation = rotation.data()};
  }
};

}  // namespace balocco
