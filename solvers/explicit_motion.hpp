// Motions that boundary conditions prescribe in an explicit step: of rigid bodies and of ordinary nodes alike.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "explicit_time.hpp"

namespace balocco {

/// Component of a motion before an increment, along the direction of a boundary condition.
struct MotionComponent {
  double displacement = 0.0;  // at the instant
  double velocity = 0.0;      // at the middle of the previous increment
};

/// Velocity that a boundary condition wants at the middle of the next increment (at the instant itself if there is
/// none). A displacement without amplitude holds the node where it is.
double prescribed_velocity(const Model& model, const Step& step, const BoundaryCondition& condition,
                           const Instant& instant, const MotionComponent& motion);

/// Velocity at the start of the first dynamic step, in which boundary conditions override initial conditions; of a displacement the slope
/// of its course.
double prescribed_initial_velocity(const Model& model, const Step& step, const BoundaryCondition& condition,
                                   const Instant& instant, const MotionComponent& motion);

/// @throws InputError where a displacement without amplitude would make the node jump from `displacement`.
void refuse_jump(const Model& model, const BoundaryCondition& condition, double displacement);

enum class NodalFreedom { translation, rotation };

/// Boundary conditions on translations, or on rotations, of ordinary nodes of this rank, in the nodes' own directions. "Forces" are
/// moments, velocities spins and displacements accumulated rotations where the freedoms are rotations.
class NodalConstraints {
 public:
  /// @throws InputError for a condition on a node that a rigid body carries (rotations: turns).
  NodalConstraints(const Analysis& analysis, const Step& step, NodalFreedom freedom);

  void refuse_jumps(const Analysis& analysis) const;
  void set_initial_velocities(Analysis& analysis, const Step& step, const Instant& instant) const;

  struct Constraint {
    std::int32_t node = -1;  // local
    Point direction{};
    const BoundaryCondition* condition = nullptr;
    double old_velocity = 0.0, new_velocity = 0.0, reaction = 0.0;
    Point position{};  // of the node (translations) when find_velocities() was called
  };
  /// Those of a local node.
  std::span<const Constraint> of_node(std::int32_t node) const;

  /// Before velocities change: what they are and shall become;
  void find_velocities(const Analysis& analysis, const Step& step, const Instant& instant);
  /// then the forces that constraints exert for it.
  void find_reactions(const Analysis& analysis, const Instant& instant, const double* force);
  /// Forces more on a node (of constraints, which find_reactions() did not know).
  void add_to_reactions(std::int32_t node, const Point& force);
  /// After velocities changed: sets the prescribed components and adds the work of the reactions.
  void enforce(Analysis& analysis, const Instant& instant) const;

  /// Of translations, after enforce(), where nodes have moved over the next increment with other velocities: puts them where these
  /// take them.
  void move_again(Analysis& analysis, const Instant& instant) const;

  /// Adds reactions, what they do to accelerations, and their work ahead, to the analysis' arrays for output.
  void add_to_output(Analysis& analysis, const Instant& instant) const;
  /// Takes the constrained components out of a nodal vector (4 a node).
  void remove_constrained(double* vector) const;
  /// Sum of the squares of those components on owned nodes, each times `factor(node)`.
  double squared_constrained(const Domain& domain, const double* vector,
                             const std::function<double(std::size_t)>& factor) const;

 private:
  MotionComponent motion(const Analysis& analysis, const Constraint& constraint) const;
  std::vector<double>& velocity(Analysis& analysis) const;
  const std::vector<double>& inertia(const Analysis& analysis) const;

  NodalFreedom freedom_;
  std::vector<Constraint> constraints_;  // sorted by node
};

}  // namespace balocco
