// Constraints in the explicit loop. The forces that they exert are found together with the motion, so that the places of the nodes
// at the end of every increment satisfy them to round-off (SHAKE: Ryckaert, Ciccotti, Berendsen 1977; here for nodes, nodes that turn
// and rigid bodies): no penalty, no drift, no bound on the increment.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "constraints/linkages.hpp"
#include "explicit_bodies.hpp"
#include "explicit_cloud.hpp"
#include "explicit_gyroscopic.hpp"
#include "explicit_motion.hpp"
#include "explicit_rigid_clusters.hpp"
#include "guide_laws.hpp"
#include "math/block_solver.hpp"
#include "math/pivoting_solver.hpp"
#include "sparse_solver.hpp"

namespace balocco {

/// Inverse masses and rotary inertias of nodes: zero where there are none, or where something else moves the node.
struct InverseInertia {
  std::vector<double> mass, rotary;
};

/// Nodes in constraints are moved by this class alone; bodies and nodes with inertia tensors get its forces. Every rank that holds a
/// linkage computes it alike.
class ExplicitLinkages {
 public:
  /// Sets `inverse` to zero for the nodes that linkages move. Which rows others imply is found when the step begins, and kept in the state.
  ExplicitLinkages(Analysis& analysis, const Step& step, const NodalConstraints& translations, const NodalConstraints& rotations,
                   GyroscopicNodes& gyroscopic, RigidDynamics& bodies, InverseInertia& inverse);

  /// Of all ranks, whose clouds are summed together.
  bool empty() const { return systems_.empty() && clusters_.empty() && shared_sums_.empty(); }
  /// Whether a linkage moves (turns) a local node.
  bool moves(std::int32_t node) const { return moves_[node]; }
  bool turns(std::int32_t node) const { return node < static_cast<std::int32_t>(turns_.size()) && turns_[node]; }
  /// Whether a local node is in a cloud, so that ranks that do not compute it need not know how it moves.
  bool in_cloud(std::int32_t node) const { return in_cloud_[node]; }
  /// What the nodes had before.
  const InverseInertia& inverse() const { return inverse_; }
  /// Bound of the acceleration per force, where the constraints let a node move (turn) that they move.
  double mobility(const Analysis& analysis, std::int32_t node, bool rotation);
  /// All that the linkage moves that moves (turns) a local node: local nodes and bodies.
  struct Company {
    std::vector<std::int32_t> nodes, bodies;
  };
  Company company(std::int32_t node, bool rotation) const;
  /// Takes over masses that have changed; sets `inverse` to zero as the constructor does.
  void renew_inertia(const Analysis& analysis, InverseInertia& inverse);
  /// Velocities at the start of a step: the nearest ones, by mass, that the constraints allow. As the next two: @throws AnalysisError, on the
  /// ranks of a linkage alone, where its motion is not determined.
  void make_velocities_consistent(Analysis& analysis);
  /// Forces that hold the constraints where nothing moves: added to `forces` and to the bodies.
  void add_resting_forces(const Analysis& analysis, const NodalForces& forces);

  /// When all other forces are known, and what is prescribed over the next increment: finds velocities and constraint forces, gives
  /// bodies theirs and stores the multipliers.
  void find_motion(Analysis& analysis, const Instant& instant, const NodalForces& forces);
  /// Adds the constraint forces on nodes to the reactions of boundary conditions;
  void add_to_reactions(NodalConstraints& translations, NodalConstraints& rotations) const;
  /// gives nodes their velocities over the next increment;
  void set_velocities(Analysis& analysis) const;
  /// and adds moments on nodes with inertia tensors.
  void add_gyroscopic_moments(double* moment) const;
  /// Accelerations of the nodes that linkages move.
  void add_to_output(Analysis& analysis) const;
  /// Work of guides over half an increment: the last one, with velocities before find_motion(), or the next one.
  enum class Half { last, next };
  void add_guide_work(const Analysis& analysis, Half half, double increment, std::vector<NodalWork>& work) const;

 private:
  /// Something with a velocity of its own: displacement or rotation of a node, or a body with both.
  struct Mover {
    enum class Kind { translation, rotation, gyroscopic, body } kind = Kind::translation;
    std::int32_t index = -1;                                      // local node, or body
    int first = 0, size = 3;                                      // columns
    std::vector<Point> directions;                                // nodes: those that are free
    std::vector<const NodalConstraints::Constraint*> conditions;  // nodes: on the others
    double inverse_inertia = 0.0;                                 // nodes; 0: massless, its velocities are unknowns
    int first_unknown = -1;                                       // of these
    Matrix6 response;                                             // acceleration by force
    // At the instant:
    Vector6 base;                                                 // velocity without constraint forces
    Vector6 old_velocity, velocity, load, constraint_force;
    Vector3<double> position;                                     // of a body
    Matrix3<double> rotation;                                     // likewise, as it stands
    Matrix3<double> turn;                                         // over the next increment, of what turns
    Matrix3<double> rotation_after;                               // of a body

    Vector3<double> spin() const { return kind == Kind::body ? velocity.rotation() : velocity.translation(); }
  };
  /// How a node of a constraint moves.
  struct NodeUse {
    std::int32_t node = -1;                          // local
    std::int32_t translation = -1, rotation = -1;    // movers; -1: it does not turn
    std::size_t column = 0, rotation_column = 0;     // of their velocities among those of the member
    bool stands_with_body = false;                   // has the rotation of the body that moves and turns it
    bool carried = false;                            // by a body, at:
    Point offset{};
    Vector3<double> arm{};                           // likewise, as the body stands
  };
  /// A mover that two members share: where its columns begin in each, and the block of the matrix that it adds to.
  struct Shared {
    std::size_t member = 0, first = 0, other_first = 0;
    int size = 3;
    std::int32_t block = -1;
  };
  /// Rows of a constraint: as many as a pack has lanes, at most.
  struct Member {
    std::int32_t constraint = -1;
    bool is_guide = false;
    const DistributingConstraint* coupling = nullptr;  // whose cloud stands aside:
    std::optional<ExplicitCloud> cloud;
    std::ptrdiff_t shared_sums = -1;                   // its place among those that ranks add up
    std::vector<int> components;                       // of the coupling's rows
    std::vector<NodeUse> nodes;                        // all, or the reference node alone
    std::vector<int> rows;  // of the constraint that are solved for
    int first_row = 0;
    std::vector<std::int32_t> movers;
    std::vector<int> columns;      // of all its movers, in turn
    std::vector<NodePlace> places;  // of the nodes, at the instant
    std::vector<Lanes> gradient;    // by column, the rows in lanes
    std::vector<Lanes> answer;      // change of velocities by multipliers, likewise
    std::ptrdiff_t hub_column = -1;  // where those of the hub begin
    std::vector<Shared> shared;     // with itself and members that are eliminated behind it
  };
  struct System {
    std::vector<Mover> movers;
    std::vector<Member> members;
    std::vector<std::pair<std::int32_t, int>> mover_of_column;
    int rows = 0, unknowns = 0;  // multipliers; these, and velocities of massless directions
    /// A body that many members of a large system share: its velocity stays unknown, as eliminating it would couple them all.
    std::int32_t hub = -1;
    bool is_linear = true;       // the gradient is the same everywhere
    bool has_guides = false;
    double average = 0.0;        // increment over which forces act
    BlockSolver blocks;          // a block a member, and one of the hub
    bool pivots = false;         // massless directions move, or blocks fail: one of the next two is used
    PivotingSolver pivoting_factors;
    SparseSolver sparse_factors;             // of large ones
    std::vector<SparseSolver::Entry> entries;
    std::vector<double> matrix;              // unknowns x unknowns, of small ones
    double factorized_for = 0.0;             // average increment; 0: none
    std::vector<double> solution, residual;  // multipliers and velocities
    double largest_turn = 0.0;               // and relative stretch, over the next increment: what changes gradients
    std::vector<bool> holds;                 // of rows: else the multiplier is given

    /// With the hub.
    int equations() const { return static_cast<int>(residual.size()); }
    /// Larger systems are solved by a sparse factorisation, where they need pivots.
    bool is_small() const { return unknowns <= 60; }
    bool is_definite() const { return unknowns == rows; }
    /// Of a row's gap, with the velocities of the movers before or after the instant.
    double rate(const Member& member, std::size_t row, Vector6 Mover::*velocity) const;
    /// Of a member with a cloud, by components.
    Vector6 multipliers(const Member& member) const;
  };

  void add_system(Analysis& analysis, const Linkage& linkage);
  using Uses = std::map<std::int32_t, int>;  // in how many constraints of a linkage a node is
  std::optional<ExplicitCloud> cloud_of(const Analysis& analysis, const DistributingConstraint* coupling, const Uses& uses) const;
  /// Of a cloud alone, as when a step begins and every rank knows all places and velocities.
  void sum_whole_cloud(const Analysis& analysis, Member& member) const;
  /// Gives the clouds that several ranks know a place among the sums that they add up. Collective.
  void share_clouds(const Analysis& analysis);
  std::int32_t mover_of(const Analysis& analysis, System& system, Mover::Kind kind, std::int32_t index);
  NodeUse use_of(const Analysis& analysis, System& system, std::int32_t row, bool turns);
  void find_freedoms(const Analysis& analysis, Mover& mover) const;
  void take_inertia(Mover& mover) const;
  void list_columns(System& system) const;
  void find_implied_rows(Analysis& analysis, System& system) const;
  static void add_columns_of_cloud(const System& system, const Member& member, std::size_t row, SparseRow& columns);
  void drop_implied_rows(const Analysis& analysis, System& system) const;
  void number(System& system) const;
  void find_hub(System& system) const;
  void list_shared_movers(System& system) const;
  void take_over(const System& system, InverseInertia& inverse);
  void take_over_clusters(InverseInertia& inverse);

  /// Of all but clouds.
  void find_places(const Analysis& analysis, System& system) const;
  /// Of all clouds, by all ranks together. `fastest` is what no rate exceeds.
  void sum_clouds(const Analysis& analysis, const ExplicitCloud::Motion& motion, double fastest);
  void find_gradient(const Analysis& analysis, System& system) const;
  /// From what the constraint says of its nodes (gradient_) to the velocities of movers.
  void take_gradient(Member& member) const;
  void find_answers(System& system, double average) const;
  void find_responses(const Analysis& analysis, System& system) const;
  void find_matrix(System& system, double average) const;
  static void add_response_of_cloud(System& system, const Member& member, double average);
  /// Rows of guides that do not hold, and their columns, become those of the identity.
  static void let_go(System& system, const Member& member, const Shared& shared);
  void find_hub_blocks(System& system, double average) const;
  void list_entries(System& system) const;
  /// @return false where the motion is not determined.
  bool factorizes(System& system, double average) const;
  bool factorizes_with_pivots(System& system) const;
  void factorize(const Analysis& analysis, System& system, double average) const {
    if (!factorizes(system, average)) report_singular(analysis, system);
  }
  [[noreturn]] void report_singular(const Analysis& analysis, const System& system) const;
  [[noreturn]] void report_apart(const Analysis& analysis, const System& system, double gap) const;
  void correct(System& system) const;
  /// One motion by the rows that hold. @return the largest gap
  double solve(Analysis& analysis, System& system, const Instant& instant);
  /// Rows of guides, by their laws: takes over what holds and the multipliers that are given;
  void take_guides(const Analysis& analysis, System& system) const;
  /// what their motions or forces say of that. @return whether other rows hold now.
  bool settle_guides(const Analysis& analysis, System& system, double next);
  void begin_with_last_multipliers(const Analysis& analysis, System& system) const;
  void find_constraint_forces(System& system) const;
  void find_base(const Analysis& analysis, System& system, const Instant& instant, const NodalForces& forces) const;
  void find_velocities(const Analysis& analysis, System& system, const Instant& instant) const;
  void find_node_velocity(System& system, Mover& mover, double average) const;
  /// Gaps at the end of the next increment, over it (velocities, where there is none; or accelerations from rest). @return the largest gap.
  double find_residual(const Analysis& analysis, System& system, double next, bool from_rest = false) const;
  /// Gaps of a member at the end of an increment; sees to the largest turn.
  void find_gaps(const Analysis& analysis, System& system, const Member& member, double next) const;
  static NodePlace place_after(const System& system, const Member& member, std::size_t node, double next);
  /// Of all nodes of a member: fills places_.
  void find_places_after(const System& system, const Member& member, double next) const;
  NodePlace place_now(const Analysis& analysis, const System& system, const NodeUse& use) const;

  const Step& step_;
  double size_ = 0.0;  // diagonal of the box around the model, which positions are as exact as
  const NodalConstraints &translations_, &rotations_;
  GyroscopicNodes& gyroscopic_;
  RigidDynamics& bodies_;
  GuideLaws guides_;
  RigidClusters clusters_;  // simple linkages, solved in closed form
  std::vector<System> systems_;
  std::vector<double> shared_sums_;  // of clouds
  std::vector<bool> moves_, turns_, in_cloud_;
  InverseInertia inverse_;
  mutable std::vector<NodePlace> places_;          // scratch
  mutable std::vector<double> gaps_, gradient_;    // scratch
  mutable std::vector<Lanes> gradient_lanes_;      // scratch
};

}  // namespace balocco
