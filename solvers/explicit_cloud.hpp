// The cloud of a distributing coupling in the explicit loop, of nodes that nothing else joins, holds or carries. The coupling's gaps know
// of them by twelve sums alone, and multipliers change these sums by constants of the masses: a linkage solves for six multipliers without
// looking at a node, which streams through memory once before and once behind that.
#pragma once

#include <cstdint>
#include <vector>

#include "constraints/distributing_coupling.hpp"
#include "math/six.hpp"

namespace balocco {

class ExplicitCloud {
 public:
  /// `nodes`: local, in the coupling's order, which its lifetime must cover.
  ExplicitCloud(const DistributingConstraint& coupling, const std::vector<std::int32_t>& nodes, const std::vector<double>& inverse_mass);
  void take_inertia(const std::vector<double>& inverse_mass);
  bool has(std::int32_t node) const;
  double inverse_mass(std::int32_t node) const;
  template <class Visit>
  void for_each_node(Visit visit) const {
    for (const auto& each : nodes_) visit(each.node);
  }

  /// Sums over places (arrays of 4 doubles a node);
  void find_places(const double* position, const Vector3<double>& origin);
  const CloudMoments& places() const { return places_; }
  /// and over velocities without constraint forces, v + average f / m; either may be null.
  void find_velocities(const double* velocity, const double* force, double average);

  // Multipliers, and rates of gaps, are by components: those of the mean's place, then those of the moment; `rotation` is that of the
  // reference node, by which the arms have turned.

  /// Of places after an increment `next` with forces that act over `average`.
  CloudMoments places_after(double next, double average, const Matrix3<double>& rotation, const Vector6& multipliers) const;
  /// Rates of the gaps, of velocities with such forces.
  Vector6 rates(double average, const Matrix3<double>& rotation, const Vector6& multipliers) const;
  /// sum G 1/m G^T, G the gradient of the gaps by a node's place.
  Matrix6 response(const Matrix3<double>& rotation) const;
  /// How velocities change from what they were to what forces (null: none) and multipliers make of them.
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
  Vector3<double> constraint_force(const Node& node, const Matrix3<double>& rotation, const Vector6& multipliers) const;

  double lever_;
  std::vector<Node> nodes_;
  std::vector<Vector3<double>> change_;
  CloudMoments places_, velocities_;
  // sum w^2 / m times 1, the arm, and its dyad
  double mobility_ = 0.0;
  Vector3<double> first_{};
  Matrix3<double> second_{};
};

}  // namespace balocco
