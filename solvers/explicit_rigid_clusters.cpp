#include "explicit_rigid_clusters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "constraints/joint.hpp"
#include "math/rotation.hpp"
#include "model/diagnostics.hpp"
#include "vectors.hpp"

namespace balocco {

namespace {

Quaternion<double> orientation(const Analysis& analysis, std::int32_t node) {
  const double* const q = &analysis.current.orientation[4 * static_cast<std::size_t>(node)];
  return {q[0], q[1], q[2], q[3]};
}

struct Wrench {
  Vector3<double> force, moment;
};

double trace(const Matrix3<double>& m) { return m(0, 0) + m(1, 1) + m(2, 2); }

/// Adds factor * (a . a 1 - a a^T).
void add_inertia(Matrix3<double>& inertia, double factor, const Vector3<double>& a) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inertia(i, j) += factor * ((i == j ? dot(a, a) : 0.0) - a[i] * a[j]);
}

/// What exp(turn) adds to a vector.
Vector3<double> change_by(const Vector3<double>& turn, const Vector3<double>& a) {
  const auto q = exponential(turn);
  const Vector3<double> axial{{q[1], q[2], q[3]}};
  const auto across = cross(axial, a);
  return 2.0 * q[0] * across + 2.0 * cross(axial, across);
}

/// A rigid arm: the second node keeps its place in the first one's frame, and its rotation where the joint speaks of it.
bool is_rigid_arm(const ConstraintDefinition& definition, const Constraint& constraint) {
  const auto* joint = std::get_if<Joint>(&definition.kind);
  if (joint == nullptr || joint->second_axes != joint->axes || !constraint.turns(0)) return false;
  const auto holds_all = [&](std::size_t piece, Joint::Part part) {
    return joint->pieces[piece].part == part && joint->pieces[piece].along == std::array{true, true, true};
  };
  if (joint->pieces.empty() || !holds_all(0, Joint::Part::offset)) return false;
  return joint->pieces.size() == 1 || (joint->pieces.size() == 2 && holds_all(1, Joint::Part::align));
}

}  // namespace

bool RigidClusters::take(const Analysis& analysis, const Linkage& linkage, const Beside& beside) {
  Cluster cluster;
  std::vector<End> ends;
  if (linkage.has_bodies || !lists_ends(analysis, linkage, beside, ends, cluster.arms)) return false;
  cluster.ends = ends;
  if (!takes_inertia(analysis, cluster)) return false;
  clusters_.push_back(std::move(cluster));
  taken_.push_back(std::move(ends));  // where the cluster still finds them
  return true;
}

bool RigidClusters::lists_ends(const Analysis& analysis, const Linkage& linkage, const Beside& beside, std::vector<End>& ends,
                               std::vector<Arm>& arms) {
  if (linkage.nodes.size() != linkage.constraints.size() + 1) return false;
  for (const auto index : linkage.constraints)
    if (!is_rigid_arm(analysis.model.constraints[index], *analysis.constraints[index])) return false;
  for (const auto row : linkage.nodes) {
    const auto node = analysis.domain.local_node[row];
    if (!beside.translations.of_node(node).empty() || !beside.rotations.of_node(node).empty()) return false;
    if (node < analysis.domain.turning && beside.gyroscopic.contains(node)) return false;
  }
  const auto end_of = [&](std::int32_t row) {
    const auto node = analysis.domain.local_node[row];
    return static_cast<std::int32_t>(std::ranges::find(ends, node, &End::node) - ends.begin());
  };
  const auto is_known = [&](std::int32_t end) { return end < static_cast<std::int32_t>(ends.size()); };
  const auto first = analysis.constraints[linkage.constraints.front()]->nodes()[0];
  ends.push_back({.node = analysis.domain.local_node[first], .turns = true});
  for (auto rest = linkage.constraints; !rest.empty();) {
    const auto next = std::ranges::find_if(rest, [&](std::int32_t index) {
      const auto& nodes = analysis.constraints[index]->nodes();
      return is_known(end_of(nodes[0])) || is_known(end_of(nodes[1]));
    });
    const auto& constraint = *analysis.constraints[*next];
    const bool outer_is_second = is_known(end_of(constraint.nodes()[0]));
    const auto inner = end_of(constraint.nodes()[outer_is_second ? 0 : 1]);
    if (!ends[inner].turns || !constraint.turns(outer_is_second ? 0 : 1)) return false;
    arms.push_back({*next, inner, static_cast<std::int32_t>(ends.size()), outer_is_second});
    const bool turns = constraint.turns(outer_is_second ? 1 : 0);
    ends.push_back({.node = analysis.domain.local_node[constraint.nodes()[outer_is_second ? 1 : 0]], .turns = turns});
    rest.erase(next);
  }
  return true;
}

bool RigidClusters::takes_inertia(const Analysis& analysis, Cluster& cluster) {
  const auto& inertia = analysis.scaled_inertia();
  cluster.mass = cluster.rotary = 0.0;
  Vector3<double> centre{};
  for (auto& end : cluster.ends) {
    end.mass = inertia.mass[end.node];
    end.rotary = end.turns ? inertia.rotary[end.node] : 0.0;
    end.offset = vector_of(analysis.model.nodes.coordinates[analysis.domain.node_row[end.node]].data());
    cluster.mass += end.mass;
    cluster.rotary += end.rotary;
    centre = centre + end.mass * end.offset;
  }
  if (!(cluster.mass > 0.0)) return false;
  centre = (1.0 / cluster.mass) * centre;
  cluster.inertia = {};
  for (auto& end : cluster.ends) {
    end.offset = end.offset - centre;
    add_inertia(cluster.inertia, end.mass, end.offset);
  }
  const auto total = cluster.inertia + cluster.rotary * Matrix3<double>::identity();
  const auto cofactors = cofactor(total);
  const double volume = determinant(total, cofactors), mean = trace(total) / 3.0;
  constexpr double thin = 1e-9;  // masses in a line, or a single one, without rotary inertia
  if (!(volume > thin * mean * mean * mean)) return false;
  cluster.mobility = (1.0 / volume) * transpose(cofactors);
  return true;
}

void RigidClusters::renew_inertia(const Analysis& analysis) {
  for (auto& cluster : clusters_) takes_inertia(analysis, cluster);
}

const RigidClusters::Cluster* RigidClusters::cluster_of(std::int32_t node, bool rotation) const {
  for (const auto& cluster : clusters_)
    for (const auto& end : cluster.ends)
      if (end.node == node && (end.turns || !rotation)) return &cluster;
  return nullptr;
}

std::vector<std::int32_t> RigidClusters::company(std::int32_t node, bool rotation) const {
  std::vector<std::int32_t> nodes;
  if (const auto* cluster = cluster_of(node, rotation))
    for (const auto& end : cluster->ends) nodes.push_back(end.node);
  return nodes;
}

double RigidClusters::mobility(std::int32_t node, bool rotation) const {
  const auto* cluster = cluster_of(node, rotation);
  if (cluster == nullptr) return 0.0;
  if (rotation) return trace(cluster->mobility);
  const auto& arm = std::ranges::find(cluster->ends, node, &End::node)->offset;
  return 1.0 / cluster->mass + dot(arm, arm) * trace(cluster->mobility);
}

void RigidClusters::line_up() {
  std::ranges::stable_sort(clusters_, {}, [](const Cluster& cluster) { return cluster.ends.front().node; });
  std::size_t count = 0;
  for (const auto& cluster : clusters_) count += cluster.ends.size();
  ends_.reserve(count);
  for (auto& cluster : clusters_) {
    ends_.insert(ends_.end(), cluster.ends.begin(), cluster.ends.end());
    cluster.ends = std::span(ends_).last(cluster.ends.size());
  }
  taken_.clear();
}

void RigidClusters::read_state(const Analysis& analysis, Cluster& cluster) {
  const auto& state = analysis.current;
  const auto first = orientation(analysis, cluster.ends.front().node);
  cluster.rotation = rotation_matrix(first);
  for (auto& end : cluster.ends) {
    const std::size_t at = 4 * static_cast<std::size_t>(end.node);
    end.arm = cluster.rotation * end.offset;
    end.old_velocity = vector_of(&state.velocity[at]);
    end.old_spin = end.turn = {};
    if (!end.turns) continue;
    end.old_spin = vector_of(&state.angular_velocity[at]);
    if (&end == &cluster.ends.front()) continue;
    const auto q = orientation(analysis, end.node);
    end.turn = rotation_vector(product(first, {q[0], -q[1], -q[2], -q[3]}));
  }
}

void RigidClusters::read_loads(const NodalForces& forces, Cluster& cluster) {
  for (auto& end : cluster.ends) {
    const std::ptrdiff_t at = 4 * static_cast<std::ptrdiff_t>(end.node);
    end.load = vector_of(forces.force + at);
    end.moment = end.turns ? vector_of(forces.moment + at) : Vector3<double>{};
  }
}

RigidClusters::Momenta RigidClusters::momenta(const Cluster& cluster, double average) {
  Momenta sum;
  for (const auto& end : cluster.ends) {
    const auto linear = end.mass * end.old_velocity + average * end.load;
    sum.linear = sum.linear + linear;
    sum.angular = sum.angular + cross(end.arm, linear) + end.rotary * end.old_spin + average * end.moment;
  }
  return sum;
}

void RigidClusters::find_velocities(Cluster& cluster, double average) {
  for (auto& end : cluster.ends) end.velocity = end.spin = {};
  complete_momenta(cluster, momenta(cluster, average));
}

/// With the turn h w over the increment, s = sin / angle and c = (1 - cos) / angle^2 of it, and the inertias I of the masses and J of
/// rotations, the angular momentum is s I w + c h w x I w + J w: solved in the frame of the cluster, where I stays, by corrections with
/// the inertia at rest.
bool RigidClusters::find_velocities(const Analysis& analysis, Cluster& cluster, double average, double next) {
  constexpr double resolution = 4.0 * std::numeric_limits<double>::epsilon();
  constexpr int most_iterations = 60;
  constexpr double largest_change = 1e-9;
  const auto sum = momenta(cluster, average);
  auto angular = sum.angular;
  Vector3<double> centre_by_first{}, centre{};  // the latter from the former
  for (auto& end : cluster.ends) {
    const auto centre_by_end = vector_of(&analysis.current.position[4 * static_cast<std::size_t>(end.node)]) - end.arm;
    if (&end == &cluster.ends.front()) centre_by_first = centre_by_end;
    end.gap = centre_by_first - centre_by_end;
    centre = centre - (end.mass / cluster.mass) * end.gap;
  }
  for (auto& end : cluster.ends) {  // gaps that the last increments have left are closed
    end.gap = end.gap + centre;
    angular = angular - (end.mass / next) * cross(end.arm, end.gap) - (end.rotary / next) * end.turn;
  }

  const auto wanted = transpose(cluster.rotation) * angular;
  auto spin = cluster.mobility * wanted;
  double relative_change = 1.0;
  for (int iteration = 0; iteration < most_iterations && relative_change > resolution; ++iteration) {
    const double square = next * next * dot(spin, spin), angle = std::sqrt(square);
    const double sine = angle < 1e-2 ? 1.0 - square / 6.0 * (1.0 - square / 20.0) : std::sin(angle) / angle;
    const double versine = angle < 1e-2 ? 0.5 - square / 24.0 * (1.0 - square / 30.0) : (1.0 - std::cos(angle)) / square;
    const auto of_masses = cluster.inertia * spin;
    const auto lacking = wanted - sine * of_masses - (versine * next) * cross(spin, of_masses) - cluster.rotary * spin;
    const auto change = cluster.mobility * lacking;
    spin = spin + change;
    relative_change = dot(change, change) > 0.0 ? std::sqrt(dot(change, change) / dot(spin, spin)) : 0.0;
  }
  spin = cluster.rotation * spin;
  for (auto& end : cluster.ends) {
    end.velocity = (1.0 / next) * (change_by(next * spin, end.arm) + end.gap);
    if (end.turns) end.spin = spin + (1.0 / next) * end.turn;
  }
  complete_momenta(cluster, sum);
  return relative_change < largest_change;
}

/// Gives the cluster the rest of its momenta: of the angular one what rounding has left, which would add up over increments.
void RigidClusters::complete_momenta(Cluster& cluster, const Momenta& sum) {
  Momenta rest = sum;
  for (const auto& end : cluster.ends) {
    rest.linear = rest.linear - end.mass * end.velocity;
    rest.angular = rest.angular - end.mass * cross(end.arm, end.velocity) - end.rotary * end.spin;
  }
  const auto path = (1.0 / cluster.mass) * rest.linear;
  const auto spin = cluster.rotation * (cluster.mobility * (transpose(cluster.rotation) * rest.angular));
  for (auto& end : cluster.ends) {
    end.velocity = end.velocity + path + cross(spin, end.arm);
    if (end.turns) end.spin = end.spin + spin;
  }
}

void RigidClusters::make_velocities_consistent(Analysis& analysis) {
  for (auto& cluster : clusters_) {
    read_state(analysis, cluster);
    find_velocities(cluster, 0.0);
  }
  set_velocities(analysis);
}

void RigidClusters::add_resting_forces(const Analysis& analysis, const NodalForces& forces) {
  for (auto& cluster : clusters_) {
    read_state(analysis, cluster);
    read_loads(forces, cluster);
    for (auto& end : cluster.ends) end.old_velocity = end.old_spin = {};
    find_velocities(cluster, 1.0);  // accelerations, from rest
    for (const auto& end : cluster.ends) {
      const std::ptrdiff_t at = 4 * static_cast<std::ptrdiff_t>(end.node);
      for (int c = 0; c < 3; ++c) {
        forces.force[at + c] = end.mass * end.velocity[c];
        if (end.turns) forces.moment[at + c] = end.rotary * end.spin[c];
      }
    }
  }
}

void RigidClusters::find_motion(Analysis& analysis, const Instant& instant, const NodalForces& forces) {
  for (auto& cluster : clusters_) {
    read_state(analysis, cluster);
    read_loads(forces, cluster);
    cluster.average = instant.average();
    if (instant.next == 0.0)
      find_velocities(cluster, cluster.average);
    else if (!find_velocities(analysis, cluster, cluster.average, instant.next)) {
      const auto& definition = analysis.model.constraints[cluster.arms.front().constraint];
      throw AnalysisError(fmt::format(
          "increment {}, time {:.6g}: the nodes joined by {} {} turn too far in an increment; reduce the increment, or look for loads "
          "that throw them",
          analysis.current.increment, analysis.current.total_time, definition.keyword,
          analysis.model.where({definition.file, definition.line})));
    }
  }
}

/// From the outermost ends inwards: what an arm exerts on the ends behind it is what they lack for their motion.
void RigidClusters::store_multipliers(Analysis& analysis, const Cluster& cluster) {
  std::vector<Wrench> lacking;
  for (const auto& end : cluster.ends)
    lacking.push_back({(end.mass / cluster.average) * (end.velocity - end.old_velocity) - end.load,
                      (end.rotary / cluster.average) * (end.spin - end.old_spin) - end.moment});
  for (std::size_t i = cluster.arms.size(); i-- > 0;) {
    const auto& arm = cluster.arms[i];
    const auto [force, moment] = lacking[arm.outer];
    const auto lever = cluster.ends[arm.outer].arm - cluster.ends[arm.inner].arm;
    const Wrench at_inner{force, moment + cross(lever, force)};
    lacking[arm.inner] = {lacking[arm.inner].force + at_inner.force, lacking[arm.inner].moment + at_inner.moment};
    const auto& joint = static_cast<const JointConstraint&>(*analysis.constraints[arm.constraint]);
    const std::span multipliers(&analysis.current.multiplier[analysis.first_constraint_row[arm.constraint]], joint.rows());
    if (arm.outer_is_second)
      joint.find_multipliers(-1.0 * force, -1.0 * moment, cluster.rotation, multipliers);
    else
      joint.find_multipliers(at_inner.force, at_inner.moment, cluster.rotation, multipliers);
  }
}

void RigidClusters::set_velocities(Analysis& analysis) const {
  auto& state = analysis.current;
  for (const auto& cluster : clusters_)
    for (const auto& end : cluster.ends) {
      const std::size_t at = 4 * static_cast<std::size_t>(end.node);
      std::copy_n(end.velocity.component.begin(), 3, &state.velocity[at]);
      if (end.turns) std::copy_n(end.spin.component.begin(), 3, &state.angular_velocity[at]);
    }
}

void RigidClusters::add_to_output(Analysis& analysis) const {
  for (const auto& cluster : clusters_) {
    store_multipliers(analysis, cluster);
    for (const auto& end : cluster.ends) {
      const std::size_t at = 4 * static_cast<std::size_t>(end.node);
      for (int c = 0; c < 3; ++c) {
        analysis.acceleration[at + c] = (end.velocity[c] - end.old_velocity[c]) / cluster.average;
        if (end.turns) analysis.angular_acceleration[at + c] = (end.spin[c] - end.old_spin[c]) / cluster.average;
      }
    }
  }
}

}  // namespace balocco
