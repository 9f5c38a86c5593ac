// Rigid bodies in an explicit step: six degrees of freedom at the reference node, prescribed or free one by one.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "explicit_motion.hpp"
#include "math/exact_sum.hpp"
#include "math/six.hpp"

namespace balocco {

/// Every rank computes the motion of every body, alike: forces are summed exactly. With reference acceleration a,
/// angular acceleration alpha, spin w, mass m, vector c from the reference node to the centre of mass, inertia I about
/// the reference node:
///   F = m (a + alpha x c + w x (w x c)),   T = m c x a + I alpha + w x (I w)
/// restricted to the free degrees of freedom; the others give the reactions.
class RigidDynamics {
 public:
  /// Collective. @throws InputError where a free degree of freedom has no mass or inertia.
  RigidDynamics(const Analysis& analysis, const Step& step);

  /// How much a body gives way where it is free: inverse mass, and inverse of its smallest principal moment of inertia about
  /// the reference node; zero where the motion is prescribed.
  struct Yielding {
    double inverse_mass = 0.0, inverse_inertia = 0.0;
    bool yields() const { return inverse_mass > 0.0 || inverse_inertia > 0.0; }
  };
  Yielding yielding(std::size_t body) const;

  bool empty() const { return bodies_.empty(); }
  /// Takes over masses that have changed. Collective.
  void renew_inertia(const Analysis& analysis);
  void refuse_jumps(const Analysis& analysis) const;
  /// Prescribed components of the motion at the start of the first dynamic step, then the velocities of all carried
  /// nodes.
  void set_initial_velocities(Analysis& analysis, const Instant& instant) const;

  /// Bodies that are held where they stand in all degrees of freedom need no forces, except for output.
  enum class Which { all, that_need_it };
  /// Force and moment about the reference node of all nodal forces, of moments on nodes that the body turns, of contact on
  /// masters, of gravity on what the body carries (which nodal forces leave out), and of `moments`; zero for bodies that need none. Collective.
  void sum_forces(const Analysis& analysis, const NodalForces& forces, const std::vector<Point>& moments,
                  const Instant& instant, Which which);
  /// By local node, what a step wants of it.
  struct Uses {
    std::vector<bool> pushed;  // an element, a contact, a load or damping may act there
    std::vector<bool> asked;   // so may a constraint, which wants its place and gives its force to the body
  };
  /// Nodes of which nothing is wanted need not follow their body before somebody looks; nor are forces summed where none can be. Collective.
  void rest_nodes(const Analysis& analysis, const Uses& uses);
  /// Where somebody looks: puts those nodes where their bodies are, with their velocities over the next increment.
  void bring_resting_nodes(Analysis& analysis, double increment) const;
  /// Whether a local node that turns has its orientation from a body.
  bool orients(std::int32_t node) const { return !orients_.empty() && orients_[node]; }

  /// Accelerations, reactions and their work; then the velocities of bodies and of their nodes over the next increment.
  void accelerate(Analysis& analysis, const Instant& instant, const std::vector<Point>& moments);
  /// Moves bodies over an increment and puts their nodes where they belong.
  void advance(Analysis& analysis, double increment) const;

  /// Reactions, their work ahead, and accelerations of bodies and of their nodes, for output.
  void add_to_output(Analysis& analysis, const Instant& instant, const std::vector<Point>& moments) const;

  /// What linkages (explicit_linkages.hpp) ask of a body, all in global directions, translations first. Accelerations by forces and
  /// moments at the reference node:
  Matrix6 response(const Analysis& analysis, std::size_t body) const;
  /// The velocity over the next increment that accelerate() would give it under a force more;
  Vector6 predicted_velocity(const Analysis& analysis, std::size_t body, const Instant& instant, const Vector6& more) const;
  /// and what it adds to the forces and moments.
  void add_force(std::size_t body, const Vector6& force);
  Vector6 force(std::size_t body) const;
  static Vector6 velocity(const Analysis& analysis, std::size_t body);
  void set_velocity(Analysis& analysis, std::size_t body, const Vector6& velocity) const;

  /// Greatest acceleration per force at a local node that a body carries, in any direction, with its free degrees of freedom.
  double mobility(const Analysis& analysis, std::size_t body, std::int32_t node) const;
  /// Greatest angular acceleration per moment, likewise.
  double rotary_mobility(const Analysis& analysis, std::size_t body) const;

  /// Squares of the unbalanced forces on free degrees of freedom and of the reactions; moments count with 1 / reach of
  /// the body.
  struct Balance {
    double unbalanced = 0.0, reactions = 0.0, gravity = 0.0;
  };
  Balance balance() const;

 private:
  struct CarriedNode {
    std::int32_t node = -1;  // local
    bool owned = false, turns = false;  // turns: has a rotation, which is the body's
    bool oriented = false;              // its orientation too, as they have stood alike
    Point offset{};                     // in the body's frame
  };
  /// As a body stands, along the degrees of freedom.
  struct Inertia {
    std::array<double, 4> orientation{};  // for which it was found
    Vector3<double> first_moment{};
    Matrix3<double> rotary{};
    Matrix6 inverse{};               // accelerations by forces: zero for what is prescribed
  };
  struct Body {
    std::int32_t reference = -1;  // local node
    double mass = 0.0, reach = 0.0;
    Vector3<double> first_moment{};                      // body frame, about the reference node
    Matrix3<double> inertia{};                           // body frame, about the reference node
    Matrix3<double> axes = Matrix3<double>::identity();  // rows: directions of the degrees of freedom
    std::array<const BoundaryCondition*, 6> condition{};
    bool is_free = true;                                 // no degree of freedom is prescribed; axes are the global ones
    bool is_centred = false;                             // and the reference node is its centre of mass
    Matrix6 free_inverse{};                              // of the inertia of a free body, body frame
    std::vector<CarriedNode> nodes;
    std::size_t pushed = 0, active = 0;  // numbers of the first of them: those that are pushed, and asked where they are; the others rest
    Vector6 weight{};        // gravity on what it carries, about the reference node, global
    bool is_pushed = true;   // nodal forces or a contact may act on it, on some rank
    bool needs_force = true;  // in this increment
    std::int32_t sum = -1;   // its six sums start at 6 * sum; -1: there is nothing to sum in this increment
    // At the current instant, along the degrees of freedom:
    Vector6 force{}, acceleration{}, reaction{};
    Vector3<double> spin{};  // at the instant, global
    mutable Inertia inertia_now;  // found again when the body has turned
  };
  /// A gravity load, and what it acts on in each body: mass and first moment about the reference node, body frame.
  struct Gravity {
    const BodyLoad* load = nullptr;
    std::vector<double> mass;
    std::vector<Vector3<double>> first_moment;
  };
  struct Motion {
    Vector6 displacement, velocity;
  };
  /// To forces, along the degrees of freedom; the spin (global) is that of the instant.
  struct Response {
    Vector6 acceleration, reaction;
    Vector3<double> spin;
  };

  void add_nodes(const Analysis& analysis, std::size_t index);
  void sum_gravity(const Analysis& analysis);
  void find_weights(const Analysis& analysis, const Instant& instant);
  void sum_inertia(const Analysis& analysis);
  void add_rotary_inertia(const Analysis& analysis);
  void refuse_massless(const Analysis& analysis) const;
  double mobility(const Analysis& analysis, std::size_t index, const std::array<Vector6, 3>& arm) const;
  void invert_free(Body& body) const;
  static Matrix6 inverse(const Body& body, const Inertia& inertia);
  const Inertia& inertia(const Body& body, const RigidBodyState& state) const;
  Motion motion(const Analysis& analysis, const Body& body, std::size_t index) const;
  Vector6 prescribed(const Analysis& analysis, const Body& body, const Motion& motion, const Instant& instant) const;
  Response solve(const RigidBodyState& state, const Body& body, const Vector6& force, const Vector6& old_velocity, const Instant& instant,
                 const Vector6& wanted) const;
  /// Of a body without prescribed degrees of freedom.
  Response solve_free(const RigidBodyState& state, const Body& body, const Vector6& force, const Vector6& old_velocity, const Instant& instant) const;
  /// Before and over the next increment, along the degrees of freedom, and what a force does for it.
  struct NewMotion {
    Vector6 old_velocity, velocity;
    Response response;
  };
  NewMotion motion_under(const Analysis& analysis, std::size_t index, const Vector6& force, const Instant& instant) const;
  void place(Analysis& analysis, const RigidBodyState& state, std::span<const CarriedNode> nodes) const;
  void set_node_velocities(Analysis& analysis, std::size_t index, double increment, std::span<const CarriedNode> nodes) const;
  bool is_held_still(const Analysis& analysis, std::size_t index, const Instant& instant) const;
  void add_body_forces(const Analysis& analysis, const NodalForces& forces, std::size_t index, std::span<ExactSum, 6> sums) const;

  const Step& step_;
  std::vector<Body> bodies_;
  std::vector<Gravity> gravity_;
  std::vector<bool> orients_;   // by local node that turns
  std::vector<ExactSum> sums_;  // 6 for each body that needs them, room for all
};

}  // namespace balocco
