// Passes over the nodes of a rank in the explicit loop: contiguous, without branches, four doubles at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace balocco {

/// Local nodes with consecutive numbers.
struct NodeRun {
  std::size_t first = 0, count = 0;

  /// Their part of what has `width` values a node.
  template <std::size_t width = 4>
  std::span<double> of(std::vector<double>& nodal) const {
    return std::span(nodal).subspan(width * first, width * count);
  }
};
/// Of the nodes [0, size) those that are `chosen`.
std::vector<NodeRun> find_runs(std::int32_t size, const std::function<bool(std::int32_t)>& chosen);

/// Zeroes the vectors, of all nodes or of some, and leaves the fourth slots alone.
void clear_vectors(std::span<double> nodal);
void clear_vectors(std::span<double> nodal, std::span<const std::int32_t> nodes);

/// sum += addend at some nodes, fourth slots excepted.
void add_vectors(std::span<double> sum, std::span<const double> addend, std::span<const std::int32_t> nodes);

/// damping force = coefficient * velocity, and force -= damping force.
void add_mass_damping(std::span<double> force, std::span<double> damping_force, std::span<const double> coefficient,
                      std::span<const double> velocity);

/// velocity += increment * force / mass (`inverse_mass` zero: left alone). @return false if a force has outgrown the
/// sum that its rounding constant (fourth slot) was made for, or is not a number: the run has blown up.
bool kick(std::span<double> velocity, std::span<const double> force, std::span<const double> inverse_mass,
          double increment);

/// position += increment * velocity.
void drift(std::span<double> position, std::span<const double> velocity, double increment);

struct NodalPass {
  std::span<double> position, velocity, force;  // 4 a node
  std::span<const double> inverse_mass;
};
/// kick over `average` and drift over `increment`, after which forces are cleared: a few nodes at a time, so that they come through
/// the caches once. @return false as kick does; from the first such nodes on, forces are left as they are.
bool kick_and_drift(const NodalPass& nodes, double average, double increment);

/// Turns nodes over an increment: orientations (unit quaternions) by the exponential of increment * spin, and the accumulated
/// rotation vectors. 4 doubles a node each.
void drift_rotations(std::span<double> orientation, std::span<double> rotation, std::span<const double> angular_velocity,
                     double increment);

/// True if the force of one node is what `kick` refuses.
bool has_outgrown(const double* force);

}  // namespace balocco
