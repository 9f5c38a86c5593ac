// Nodes with a ROTARYI tensor in an explicit step: their spins obey Euler's equations.
#pragma once

#include <array>
#include <vector>

#include "explicit_motion.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// T = I alpha + w x (I w), with I = R (tensor + J 1) R^T: the tensors of the node's ROTARYI elements, which turn with it, and the
/// inertia J that its elements give it. Restricted to the free degrees of freedom 4-6; the others give the reactions.
class GyroscopicNodes {
 public:
  /// Nodes that bodies turn are left to the bodies. @throws InputError where such a node is not the reference node, and where
  /// a free rotation has no inertia.
  GyroscopicNodes(const Analysis& analysis, const Step& step);

  bool contains(std::int32_t node) const;
  /// Takes over rotary inertias of elements that have changed.
  void renew_inertia(const Analysis& analysis);
  /// Angular accelerations under `moment` (4 a node), reactions and their work; then the spins over the next increment.
  void accelerate(Analysis& analysis, const Step& step, const Instant& instant, const double* moment);
  /// What linkages (explicit_linkages.hpp) ask: angular accelerations by moments, and the spin over the next increment under a moment.
  Matrix3<double> response(const Analysis& analysis, std::int32_t node) const;
  Vector3<double> predicted_spin(const Analysis& analysis, const Step& step, const Instant& instant, std::int32_t node,
                                 const Vector3<double>& moment) const;
  /// Adds reactions, angular accelerations and work ahead to the analysis' arrays for output.
  void add_to_output(Analysis& analysis, const Instant& instant) const;

 private:
  /// As a node stands, along the degrees of freedom.
  struct Inertia {
    std::array<double, 4> orientation{};  // for which it was found
    Matrix3<double> tensor{}, inverse{};  // the latter is zero in rows and columns of what is prescribed
  };
  struct Node {
    std::int32_t node = -1;                              // local
    std::int32_t section = -1;                           // row of Model::sections, for messages
    Matrix3<double> tensor{};                            // reference frame
    Matrix3<double> axes = Matrix3<double>::identity();  // rows: directions of the degrees of freedom
    std::array<const BoundaryCondition*, 3> condition{};
    Vector3<double> acceleration{}, reaction{};          // along the degrees of freedom, at the instant
    mutable Inertia inertia_now;                         // found again when the node has turned
  };
  /// Along the degrees of freedom.
  struct Motion {
    Vector3<double> acceleration{}, reaction{}, old_spin{}, new_spin{};
  };
  const Node& at(std::int32_t node) const { return nodes_[index_[node]]; }
  static const Inertia& inertia(const Node& node, const Analysis& analysis);
  Motion solve(const Node& node, const Analysis& analysis, const Step& step, const Vector3<double>& moment, const Instant& instant) const;

  std::vector<Node> nodes_;
  std::vector<std::int32_t> index_;  // of local nodes that turn, among these; -1: none
};

}  // namespace balocco
