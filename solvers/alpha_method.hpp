// Implicit dynamics: the alpha method of Hilber, Hughes & Taylor (Earthq. Eng. Struct. Dyn. 5, 1977), in displacements.
//
//   M a(n+1) + (1 + alpha) f(n+1) - alpha f(n) = 0,   f = internal - external forces, with those of constraints, contact and damping
//   a(n+1) = (x(n+1) - x(n) - h v(n)) / (beta h^2) - (1 / (2 beta) - 1) a(n),   beta  = (1 - alpha)^2 / 4
//   v(n+1) = v(n) + h ((1 - gamma) a(n) + gamma a(n+1)),                        gamma = 1/2 - alpha
//
// Rotations follow the same formulas in the frame that turns with them (Simo & Vu-Quoc, Comput. Meth. Appl. Mech. Eng. 66, 1988): the
// rotation vector of the increment, the angular velocity and its rate in the place of x(n+1) - x(n), v and a. What rigid bodies carry
// moves with them, and its inertia acts on them. Geometrically linear steps leave out all products of velocities.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "implicit_configuration.hpp"
#include "implicit_mass.hpp"

namespace balocco {

class AlphaMethod {
 public:
  /// With contact beta is gamma / 2, less damped by a hair than Hilber's (1 - alpha)^2 / 4: so what rests on a surface stays at rest.
  AlphaMethod(Analysis& analysis, const ImplicitDofMap& map, double alpha, bool contact);

  /// What is computed from now on: a step of the method over `increment` from `start`, or the forces of an instant that nothing has
  /// moved from, with accelerations of zero, and a matrix M + tiny K that finds the true ones.
  void advance(const Configuration& start, double increment);
  void stand(const Configuration& start, double increment);
  /// Or the motion of the state itself, as it is.
  void hold(const Configuration& start);

  /// Weights of the forces' values at the end of the increment and at its start, and of their derivative.
  double weight() const { return weight_; }
  double old_weight() const { return old_weight_; }
  double tangent_weight() const { return tangent_weight_; }
  /// Those of contact, which acts over the whole increment as it is at its end (Kane, Repetto, Ortiz and Marsden, Comput. Methods Appl.
  /// Mech. Engrg. 180, 1999): it takes energy from an impact and never gives any. Accelerations that it causes are not gone on from.
  double contact_weight() const { return 1.0 / gamma_; }
  double contact_tangent_weight() const { return finds_accelerations() ? tangent_weight_ : contact_weight(); }
  /// Whether the matrix is of accelerations, not of motions, which change where forces act.
  bool finds_accelerations() const { return velocity_tangent_ == 0.0; }
  /// f(n) in the slots' directions.
  const std::vector<double>& old_forces() const { return old_forces_; }

  /// Velocities and accelerations of all nodes where the state stands, which `motion` is given.
  void follow();
  void lend(NodalMotion& motion) const;
  /// Velocity and acceleration of a node's freedom `dof` < 6, global axes.
  double velocity(std::int32_t node, int dof) const { return (dof < 3 ? velocity_ : spin_)[4 * node + dof % 3]; }

  /// What the functions below add, in their order.
  void record_damping(ImplicitStiffness& stiffness) const;
  void record_inertia(ImplicitStiffness& stiffness) const;
  /// Add mass-proportional damping, and inertia, to the forces of this rank's nodes (slots along global axes) and to the stiffness
  /// (null: to the forces alone).
  void add_damping(ImplicitStiffness* stiffness, std::span<double> force) const;
  void add_inertia(ImplicitStiffness* stiffness, std::span<double> force) const;
  /// What spinning bodies add to the stiffness. Their centripetal and gyroscopic forces are in add_inertia().
  void add_body_stiffness(ImplicitStiffness& stiffness) const;

  /// Makes the motion that follow() found that of the state, and `forces` (per slot) the ones to go on from.
  void commit(std::span<const double> forces);
  /// The same of accelerations (per slot) alone, where nothing has moved.
  void commit_accelerations(std::span<const double> slots, std::span<const double> forces);
  /// Half of velocity * mass * velocity of this rank's part of the mass, for output.
  void find_kinetic_energy() const;
  /// Motion of the slots that the start of the increment lets expect: h v + h^2 / 2 a.
  std::vector<double> prediction() const;

 private:
  using Three = Vector3<double>;
  struct Spinning {  // the rotation of a body or a node
    Three velocity{}, acceleration{};
  };
  void gather_start();
  Spinning spinning(std::span<const double> orientation, std::span<const double> start_orientation, const Point& turned,
                    const Spinning& start) const;
  Three acceleration_of(const Three& moved, const Three& velocity, const Three& acceleration) const;
  Three velocity_of(const Three& moved, const Three& velocity, const Three& acceleration) const;
  void record(InertiaKind kind, ImplicitStiffness& stiffness) const;
  void add_forces(InertiaKind kind, ImplicitStiffness* stiffness, double tangent, std::span<double> force) const;
  void remember(std::span<const double> forces);
  Point slot_components(std::span<const double> slots, std::int32_t first) const;

  Analysis& analysis_;
  const ImplicitDofMap& map_;
  const double alpha_, beta_, gamma_;
  Configuration start_;
  double increment_ = 0.0;
  double weight_ = 1.0, old_weight_ = 0.0, tangent_weight_ = 1.0;
  double mass_tangent_ = 0.0, velocity_tangent_ = 0.0;
  std::array<double, 3> acceleration_factor_{}, velocity_factor_{};  // of the motion, the velocity and the acceleration at the start
  std::vector<double> old_forces_;
  std::vector<double> velocity_, acceleration_, spin_, spin_acceleration_;  // 4 a node
  std::vector<Spinning> body_;
  std::vector<Matrix3<double>> second_moment_;  // of the lumped mass that bodies carry, about the reference node, in the body's frame
  std::vector<Three> first_moment_;
};

}  // namespace balocco
