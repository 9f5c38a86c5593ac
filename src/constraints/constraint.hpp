// Constraints between nodes: rows g(places of the nodes) = 0, which both solvers satisfy exactly with multipliers. In statics a
// multiplier is an unknown like a displacement; in the explicit loop they are found with the motion (solvers/explicit_linkages.hpp).
// Nodes may be carried by rigid bodies or stand in several constraints: chains resolve by themselves.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "math/tensor.hpp"
#include "model/model.hpp"

namespace balocco {

/// Where a node is. `rotation` turns the reference configuration into the present one; `turn` is the accumulated rotation vector.
/// Both stay as they were for nodes that do not turn.
struct NodePlace {
  Vector3<double> position;
  Matrix3<double> rotation = Matrix3<double>::identity();
  Vector3<double> turn{};
};

class GuideConstraint;

/// Rows are lengths, or lengths times angles. Columns of a gradient: 6 for each node, displacement and spin (global axes; a spin s
/// turns R into exp(s) R).
class Constraint {
 public:
  virtual ~Constraint() = default;

  const std::vector<std::int32_t>& nodes() const { return nodes_; }  // model rows
  int rows() const { return rows_; }
  int columns() const { return 6 * static_cast<int>(nodes_.size()); }
  /// Whether the constraint speaks of the rotation of its node number `i`.
  virtual bool turns(int i) const = 0;
  /// Whether it may speak of a degree of freedom of that node: 0-2 along, 3-5 about the node's own directions.
  virtual bool uses(int i, int dof) const { return dof < 3 || turns(i); }
  /// Whether gradient() is the same everywhere.
  virtual bool is_linear() const { return false; }

  /// Whether g <= 0 suffices, so that the constraint pulls with a positive multiplier or not at all.
  virtual bool is_one_sided() const { return false; }
  /// Whether curvature couples any two nodes: add_curvature() then fills columns() x columns() values.
  virtual bool couples_all() const { return false; }
  /// Where g are relative motions, of which laws of the step say what holds; else all of them vanish.
  virtual const GuideConstraint* guide() const { return nullptr; }

  /// g, rows() values.
  virtual void gaps(std::span<const NodePlace> places, std::span<double> g) const = 0;
  /// dg, rows() x columns(), row-major.
  virtual void gradient(std::span<const NodePlace> places, std::span<double> dg) const = 0;
  /// Adds the derivative of (multiplier * dg) by displacements and spins: 12 x 12 values (row-major) for each node but the first, over
  /// the 6 columns of the first node and the 6 of that one; no other nodes are coupled, and what couples the first with itself may
  /// stand in any of them. Row i is the change of the force that the constraint exerts along column i.
  virtual void add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers, std::span<double> pairs) const = 0;

 protected:
  std::vector<std::int32_t> nodes_;
  int rows_ = 0;
};

/// All constraints of a model, in its order.
std::vector<std::unique_ptr<Constraint>> make_constraints(const Model& model);

}  // namespace balocco
