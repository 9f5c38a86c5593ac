// Contact in an explicit step: which springs its pairs have, when they push, and how far nodes have sunk in.
#pragma once

#include <vector>

#include "explicit_bodies.hpp"
#include "explicit_motion.hpp"

namespace balocco {

/// A node of a face that is free to move, against a master all whose motion is prescribed, has stiff springs: their forces are
/// found together with the motion they cause, so that they limit no increment. Nodes of rigid bodies, of node sets, nodes that are
/// held and nodes against free masters or such that deform have softer springs, which the increment must follow.
class ExplicitContact {
 public:
  ExplicitContact(const Analysis& analysis, const Step& step, const NodalConstraints& constraints,
                  const RigidDynamics& bodies, std::span<const double> inverse_mass);

  /// Takes over masses that have changed.
  void renew_inertia(const Analysis& analysis, const RigidDynamics& bodies, std::span<const double> inverse_mass);
  /// At the start of a step: gives closed points the springs of this step without changing their forces.
  void choose_springs(Analysis& analysis) const;
  /// Warns of nodes that start below a surface. Collective.
  void report_overclosure(const Analysis& analysis, Observer& observer) const;

  /// Deformable masters: before the halo's sums.
  void add_mesh_forces(Analysis& analysis, const Instant& instant, double* force) const;
  /// Soft springs: between the halo's two halves, alike on every copy of a node.
  void add_forces(Analysis& analysis, double* force) const;
  /// Stiff springs: when `force` is whole and NodalConstraints::find_velocities() has told what is prescribed.
  void add_stiff_forces(Analysis& analysis, const Instant& instant, double* force);

  /// Bounds of what the springs add to the squares of frequencies: stiffness / mass of each local node, over all pairs; the largest
  /// of them, of any rank; and the sum over all closed points against free masters, which is collective.
  const std::vector<double>& nodal_frequencies_squared() const { return nodal_frequency_squared_; }
  double largest_nodal_frequency_squared() const { return largest_nodal_frequency_squared_; }
  double frequency_squared_of_masters(const Analysis& analysis) const;
  /// Deepest penetration over all ranks and pairs. Collective.
  double largest_penetration(const Analysis& analysis) const;
  /// Tells once a step when a closed node has come to where the profile of its master had ended. Collective.
  void report_past_end(const Analysis& analysis, Observer& observer);

 private:
  struct Pair {
    std::int32_t row = -1;  // of Model::contact_pairs
    RigidDynamics::Yielding master;
    std::vector<SlaveFreedom> freedom;  // per point
    std::vector<bool> stiff;            // per point
    bool past_end_told = false;
  };
  /// A constraint that says how a point moves along one of its held directions.
  struct Held {
    std::size_t pair, point;
    int direction;
    const NodalConstraints::Constraint* constraint;
  };

  void find_nodal_frequency(const Analysis& analysis);
  void tell_overclosure(const Analysis& analysis, std::int32_t row, double depth, std::int32_t node, bool thrown, Observer& observer) const;

  std::vector<Pair> pairs_;
  std::vector<std::int32_t> mesh_pairs_;  // rows of those whose masters deform
  std::vector<Held> held_;
  std::vector<double> stiffness_;  // of springs, per local node
  std::vector<double> nodal_frequency_squared_;  // likewise
  double largest_nodal_frequency_squared_ = 0.0;
  bool free_masters_ = false;
};

}  // namespace balocco
