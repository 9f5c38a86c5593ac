// Free nodes on rigid arms in the explicit loop: spot welds, *MPC BEAM, couplings of nodes that nothing else moves. Such a cluster moves
// as one body, so its motion is found in closed form, where a linkage has a system of equations. It is the motion that the constraints of
// explicit_linkages.hpp would lead to: momenta grow by the impulses of all nodes, and the nodes end where the arms put them, to round-off.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis.hpp"
#include "constraints/linkages.hpp"
#include "explicit_gyroscopic.hpp"
#include "explicit_motion.hpp"

namespace balocco {

class RigidClusters {
 public:
  /// What else may move nodes.
  struct Beside {
    const NodalConstraints &translations, &rotations;
    const GyroscopicNodes& gyroscopic;
  };

  /// Takes over a linkage that is a tree of rigid arms between nodes that nothing else moves. @return false: it is not.
  bool take(const Analysis& analysis, const Linkage& linkage, const Beside& beside);
  /// When all are taken: ends, and the nodes of clusters that follow each other, come one after the other in memory.
  void line_up();
  bool empty() const { return clusters_.empty(); }
  void renew_inertia(const Analysis& analysis);
  template <class Visit>
  void for_each_node(Visit visit) const {  // visit(local node, whether the cluster turns it)
    for (const auto& cluster : clusters_)
      for (const auto& end : cluster.ends) visit(end.node, end.turns);
  }
  /// All nodes of the cluster that moves (turns) a local node; none: no cluster does.
  std::vector<std::int32_t> company(std::int32_t node, bool rotation) const;
  /// Bound of the acceleration per force (moment) on such a node.
  double mobility(std::int32_t node, bool rotation) const;

  /// As the verbs of ExplicitLinkages.
  void make_velocities_consistent(Analysis& analysis);
  void add_resting_forces(const Analysis& analysis, const NodalForces& forces);
  /// @throws AnalysisError where a cluster turns too far in an increment.
  void find_motion(Analysis& analysis, const Instant& instant, const NodalForces& forces);
  void set_velocities(Analysis& analysis) const;
  /// Multipliers too: nothing else asks for them.
  void add_to_output(Analysis& analysis) const;

 private:
  struct End {
    std::int32_t node = -1;  // local
    bool turns = false;      // with the cluster; else it is a point at the end of its arm
    Vector3<double> offset;  // from the centre of mass, in the configuration of the start
    double mass = 0.0, rotary = 0.0;
    // At the instant:
    Vector3<double> arm, old_velocity, old_spin, velocity, spin;
    Vector3<double> gap, turn;  // that it lacks to stand as the masses do, and as the first end does
    Vector3<double> load, moment;
  };
  struct Arm {
    std::int32_t constraint = -1;
    std::int32_t inner = -1, outer = -1;  // ends; the outer one hangs on the cluster by this arm alone
    bool outer_is_second = true;          // of the joint
  };
  struct Cluster {
    std::span<End> ends;    // the first one turns, and its rotation is that of the cluster
    std::vector<Arm> arms;  // each behind the one that its inner end hangs on
    double mass = 0.0, rotary = 0.0;
    Matrix3<double> inertia{};   // of the masses, about their centre, at the start
    Matrix3<double> mobility{};  // inverse of it and the rotary inertias
    double average = 0.0;        // increment of the last motion
    Matrix3<double> rotation{};  // at the instant
  };
  /// Momenta about the centre of mass.
  struct Momenta {
    Vector3<double> linear, angular;
  };

  static bool lists_ends(const Analysis& analysis, const Linkage& linkage, const Beside& beside, std::vector<End>& ends, std::vector<Arm>& arms);
  static bool takes_inertia(const Analysis& analysis, Cluster& cluster);
  static void read_state(const Analysis& analysis, Cluster& cluster);
  static void read_loads(const NodalForces& forces, Cluster& cluster);
  static Momenta momenta(const Cluster& cluster, double average);
  /// Velocities of a cluster that turns from where it stands, without an increment to come;
  static void find_velocities(Cluster& cluster, double average);
  /// and over the next one. @return false where the cluster turns too far in it.
  static bool find_velocities(const Analysis& analysis, Cluster& cluster, double average, double next);
  static void complete_momenta(Cluster& cluster, const Momenta& sum);
  static void store_multipliers(Analysis& analysis, const Cluster& cluster);
  const Cluster* cluster_of(std::int32_t node, bool rotation) const;

  std::vector<Cluster> clusters_;
  std::vector<End> ends_;                // of all clusters
  std::vector<std::vector<End>> taken_;  // until they are lined up
};

}  // namespace balocco
