// The cloud of a distributing coupling in the explicit loop, of nodes that nothing else joins, holds or carries. The coupling's gaps know
// of them by twelve sums alone, and multipliers change these sums by constants of the masses: a linkage solves for six multipliers without
// looking at a node, which streams through memory once before and once behind that. Each rank sums and moves the nodes that it computes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "constraints/distributing_coupling.hpp"
#include "domain.hpp"
#include "math/six.hpp"

namespace balocco {

class ExplicitCloud {
 public:
  /// What places (from the reference node) and their rates do not exceed: sums of what is smaller are exact, hence order-free.
  struct Largest {
    double place = 1.0, rate = 1.0;
  };

  /// `nodes`: local, in the coupling's order, which its lifetime must cover.
  ExplicitCloud(const DistributingConstraint& coupling, const std::vector<std::int32_t>& nodes, const Domain& domain,
                const std::vector<double>& inverse_mass);
  void take_inertia(const std::vector<double>& inverse_mass);
  bool has(std::int32_t node) const;
  double inverse_mass(std::int32_t node) const;
  /// Of all ranks.
  template <class Visit>
  void for_each_node(Visit visit) const {
    for (const auto& each : nodes_) visit(each.node);
  }

  /// What nodes are summed: arrays of 4 doubles a node. Rates are velocities without constraint forces, v + average f / m; velocity or
  /// force may be null.
  struct Motion {
    const double *position, *velocity, *force;
    double average = 0.0;
  };
  enum class Share { owned, whole };
  /// Sums over the nodes that this rank owns, or over all in one order, where it knows how all move;
  void sum(Share share, const Motion& motion, const Vector3<double>& reference, const Largest& largest);
  /// to which the ranks add theirs,
  static constexpr std::size_t sum_count = 64;
  std::span<double, sum_count> sums() { return sums_; }
  /// before they are read.
  void take_sums(const Vector3<double>& reference);
  const CloudMoments& places() const { return places_; }

  // Multipliers, and rates of gaps, are by components: those of the mean's place, then those of the moment; `rotation` is that of the
  // reference node, by which the arms have turned.

  /// Of places after an increment `next` with forces that act over `average`.
  CloudMoments places_after(double next, double average, const Matrix3<double>& rotation, const Vector6& multipliers) const;
  /// Rates of the gaps, of velocities with such forces.
  Vector6 rates(double average, const Matrix3<double>& rotation, const Vector6& multipliers) const;
  /// sum G 1/m G^T, G the gradient of the gaps by a node's place.
  Matrix6 response(const Matrix3<double>& rotation) const;
  /// How velocities of the nodes that this rank computes change from what they were to what forces (null: none) and multipliers make of them.
  void find_changes(const double* force, double average, const Matrix3<double>& rotation, const Vector6& multipliers);
  void add_changes(double* velocity) const;
  void set_accelerations(double average, double* acceleration) const;
  void add_constraint_forces(const Matrix3<double>& rotation, const Vector6& multipliers, double* force) const;

 private:
  struct Node {
    std::int32_t node = -1;
    double weight = 0.0, inverse_mass = 0.0;
    Vector3<double> arm;  // from the mean, at the start
  };
  std::span<const Node> computed() const { return std::span(nodes_).first(computed_); }
  Vector3<double> constraint_force(const Node& node, const Matrix3<double>& rotation, const Vector6& multipliers) const;

  double lever_, reach_ = 0.0;  // reach: the longest component of an arm
  std::vector<Node> nodes_;     // those that this rank owns, others that it computes, and the rest
  std::size_t owned_ = 0, computed_ = 0;
  std::vector<std::size_t> in_order_;  // the same in the order of the coupling
  std::vector<Vector3<double>> change_;
  std::array<double, sum_count> sums_{};
  CloudMoments places_, velocities_;
  // sum w^2 / m times 1, the arm, and its dyad
  double mobility_ = 0.0;
  Vector3<double> first_{};
  Matrix3<double> second_{};
};

}  // namespace balocco
