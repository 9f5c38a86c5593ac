#include "explicit_linkages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "constraints/rigid_body.hpp"
#include "math/rotation.hpp"
#include "model/diagnostics.hpp"
#include "vectors.hpp"

namespace balocco {

namespace {

/// Greatest turn of the line from the first node to another, relative stretch included.
double turn_of_lines(std::span<const NodePlace> before, std::span<const NodePlace> after, double shortest) {
  double square = 0.0;
  for (std::size_t i = 1; i < before.size(); ++i) {
    const auto line = before[i].position - before[0].position, change = after[i].position - after[0].position - line;
    const double length = dot(line, line);
    if (length > shortest * shortest) square = std::max(square, dot(change, change) / length);
  }
  return std::sqrt(square);
}

/// Of all components together, whose squares must not vanish.
double relative_change(const Matrix3<double>& before, const Matrix3<double>& after) {
  double size = 0.0, change = 0.0;
  for (std::size_t i = 0; i < 9; ++i) {
    size += before.component[i] * before.component[i];
    change += (after.component[i] - before.component[i]) * (after.component[i] - before.component[i]);
  }
  return size > 0.0 ? std::sqrt(change / size) : 0.0;
}

constexpr int most_iterations = 8, most_passes = 16;
/// Relative to the size of the model: what iterations must not leave.
constexpr double largest_gap = 1e-3;
/// Likewise: farther from its reference node no part of a cloud is, nor moves in an increment.
constexpr double farthest = 16.0;

}  // namespace

void ExplicitLinkages::find_places(const Analysis& analysis, System& system) const {
  for (auto& mover : system.movers) {
    if (mover.kind != Mover::Kind::body) continue;
    const auto& state = analysis.current.rigid_bodies[mover.index];
    mover.position = vector_of(state.position);
    mover.rotation = rotation_matrix(state);
  }
  for (auto& member : system.members) {
    member.places.resize(member.nodes.size());
    for (std::size_t i = 0; i < member.nodes.size(); ++i) {
      auto& use = member.nodes[i];
      member.places[i] = place_now(analysis, system, use);
      if (use.carried) use.arm = system.movers[use.translation].rotation * vector_of(use.offset);
    }
  }
}

NodePlace ExplicitLinkages::place_now(const Analysis& analysis, const System& system, const NodeUse& use) const {
  const auto row = analysis.domain.node_row[use.node];
  if (!use.stands_with_body) return analysis.place_of(row);
  const std::size_t at = 4 * static_cast<std::size_t>(use.node);
  const auto& state = analysis.current;
  return {vector_of(&state.position[at]), system.movers[use.rotation].rotation, vector_of(&state.rotation[at])};
}

void ExplicitLinkages::sum_clouds(const Analysis& analysis, const ExplicitCloud::Motion& motion, double fastest) {
  const auto for_each_cloud = [&](auto visit) {
    for (auto& system : systems_)
      for (auto& member : system.members)
        if (member.cloud) visit(system, member, analysis.place_of(member.coupling->nodes().front()).position);
  };
  for_each_cloud([&](const System& system, Member& member, const Vector3<double>& reference) {
    member.cloud->sum(ExplicitCloud::Share::owned, motion, reference, {.place = farthest * size_, .rate = fastest});
    if (member.shared_sums >= 0) std::ranges::copy(member.cloud->sums(), shared_sums_.begin() + member.shared_sums);
  });
  if (!shared_sums_.empty()) analysis.communicator.sum(std::span<double>(shared_sums_));
  for_each_cloud([&](const System&, Member& member, const Vector3<double>& reference) {
    if (member.shared_sums >= 0) std::copy_n(shared_sums_.begin() + member.shared_sums, ExplicitCloud::sum_count, member.cloud->sums().begin());
    member.cloud->take_sums(reference);
  });
}

void ExplicitLinkages::find_gradient(const Analysis& analysis, System& system) const {
  for (auto& member : system.members) {
    const auto& constraint = *analysis.constraints[member.constraint];
    const auto width = 6 * member.nodes.size();
    gradient_.resize(static_cast<std::size_t>(constraint.rows()) * width);
    if (member.cloud)
      member.coupling->reference_gradient(member.cloud->places(), member.places.front().rotation, gradient_);
    else
      constraint.gradient(member.places, gradient_);
    take_gradient(member);
  }
}

void ExplicitLinkages::take_gradient(Member& member) const {
  const auto width = 6 * member.nodes.size();
  gradient_lanes_.resize(width);
  for (std::size_t k = 0; k < width; ++k) {
    Lanes& lanes = gradient_lanes_[k] = {};
    for (std::size_t row = 0; row < member.rows.size(); ++row)
      lanes[static_cast<int>(row)] = gradient_[static_cast<std::size_t>(member.rows[row]) * width + k];
  }
  std::ranges::fill(member.gradient, Lanes{});
  const auto add = [&](std::size_t column, const Vector3<Pack>& addend) {
    for (int c = 0; c < 3; ++c) member.gradient[column + c].set(member.gradient[column + c].pack() + addend[c]);
  };
  const Lanes* lanes = gradient_lanes_.data();
  for (const auto& use : member.nodes) {
    const Vector3<Pack> force{lanes[0].pack(), lanes[1].pack(), lanes[2].pack()};
    add(use.column, force);
    if (use.carried) add(use.column + 3, cross(Vector3<Pack>{use.arm[0], use.arm[1], use.arm[2]}, force));
    if (use.rotation >= 0) add(use.rotation_column, {lanes[3].pack(), lanes[4].pack(), lanes[5].pack()});
    lanes += 6;
  }
}

void ExplicitLinkages::find_constraint_forces(System& system) const {
  for (auto& mover : system.movers) mover.constraint_force = {};
  for (const auto& member : system.members) {
    Lanes multipliers;
    for (std::size_t i = 0; i < member.rows.size(); ++i) multipliers[static_cast<int>(i)] = system.solution[member.first_row + i];
    const Lanes* column = member.gradient.data();
    for (const auto m : member.movers) {
      auto& mover = system.movers[m];
      for (int c = 0; c < mover.size; ++c) mover.constraint_force[c] += sum_of(multipliers.pack() * (column++)->pack());
    }
  }
}

void ExplicitLinkages::find_base(const Analysis& analysis, System& system, const Instant& instant, const NodalForces& forces) const {
  const auto& state = analysis.current;
  for (auto& mover : system.movers) {
    if (mover.kind == Mover::Kind::body) {
      mover.old_velocity = bodies_.velocity(analysis, static_cast<std::size_t>(mover.index));
      continue;
    }
    const bool translates = mover.kind == Mover::Kind::translation;
    const std::ptrdiff_t at = 4 * static_cast<std::ptrdiff_t>(mover.index);
    const double* const force = (translates ? forces.force : forces.moment) + at;
    const double* const velocity = (translates ? state.velocity : state.angular_velocity).data() + at;
    for (int c = 0; c < 3; ++c) {
      mover.load[c] = force[c];
      mover.old_velocity[c] = velocity[c];
    }
    mover.base = {};
    for (const auto& direction : mover.directions)
      if (mover.first_unknown < 0)
        add_along(mover.base, along(mover.old_velocity, direction) + instant.average() * mover.inverse_inertia * along(mover.load, direction),
            direction);
    for (const auto* condition : mover.conditions) add_along(mover.base, condition->new_velocity, condition->direction);
  }
}

void ExplicitLinkages::find_node_velocity(System& system, Mover& mover, double average) const {
  mover.velocity = mover.base;
  for (std::size_t k = 0; k < mover.directions.size(); ++k) {
    const double change = mover.first_unknown >= 0 ? system.solution[mover.first_unknown + k]
                                                   : average * mover.inverse_inertia * along(mover.constraint_force, mover.directions[k]);
    add_along(mover.velocity, change, mover.directions[k]);
  }
}

void ExplicitLinkages::find_velocities(const Analysis& analysis, System& system, const Instant& instant) const {
  system.largest_turn = 0.0;
  for (auto& mover : system.movers) {
    switch (mover.kind) {
      case Mover::Kind::body:
        mover.velocity = bodies_.predicted_velocity(analysis, static_cast<std::size_t>(mover.index), instant, mover.constraint_force);
        break;
      case Mover::Kind::gyroscopic: {
        const auto spin = gyroscopic_.predicted_spin(analysis, step_, instant, mover.index, (mover.load + mover.constraint_force).translation());
        for (int c = 0; c < 3; ++c) mover.velocity[c] = spin[c];
        break;
      }
      default:
        find_node_velocity(system, mover, instant.average());
    }
    if (mover.kind == Mover::Kind::translation) continue;
    const auto turn = instant.next * mover.spin();
    mover.turn = rotation_matrix(exponential(turn));
    if (mover.kind == Mover::Kind::body) mover.rotation_after = mover.turn * mover.rotation;
    system.largest_turn = std::max(system.largest_turn, std::sqrt(dot(turn, turn)));
  }
}

NodePlace ExplicitLinkages::place_after(const System& system, const Member& member, std::size_t node, double next) {
  const auto& use = member.nodes[node];
  const auto& place = member.places[node];
  const auto& mover = system.movers[use.translation];
  const auto path = next * mover.velocity.translation();
  const auto position = use.carried ? mover.position + path + mover.turn * use.arm : place.position + path;
  if (use.rotation < 0) return {position, place.rotation, place.turn};
  const auto& turner = system.movers[use.rotation];
  return {position, use.stands_with_body ? turner.rotation_after : turner.turn * place.rotation, place.turn + next * turner.spin()};
}

void ExplicitLinkages::find_places_after(const System& system, const Member& member, double next) const {
  places_.resize(member.nodes.size());
  for (std::size_t i = 0; i < places_.size(); ++i) places_[i] = place_after(system, member, i, next);
}

double ExplicitLinkages::System::rate(const Member& member, std::size_t row, Vector6 Mover::*velocity) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < member.columns.size(); ++k) {
    const auto [mover, component] = mover_of_column[member.columns[k]];
    sum += member.gradient[k][static_cast<int>(row)] * (movers[mover].*velocity)[component];
  }
  return sum;
}

Vector6 ExplicitLinkages::System::multipliers(const Member& member) const {
  Vector6 multipliers{};
  for (std::size_t i = 0; i < member.rows.size(); ++i) multipliers[member.components[member.rows[i]]] = solution[member.first_row + i];
  return multipliers;
}

void ExplicitLinkages::find_gaps(const Analysis& analysis, System& system, const Member& member, double next) const {
  constexpr double apart = 1e-9;  // of nodes that are not in one place
  const auto& constraint = *analysis.constraints[member.constraint];
  find_places_after(system, member, next);
  gaps_.resize(static_cast<std::size_t>(constraint.rows()));
  if (!member.cloud) {
    constraint.gaps(places_, gaps_);
    system.largest_turn = std::max(system.largest_turn, turn_of_lines(member.places, places_, apart * size_));
    return;
  }
  const auto before = member.cloud->places();
  const auto after = member.cloud->places_after(next, system.average, member.places.front().rotation, system.multipliers(member));
  member.coupling->gaps_of(after, places_.front(), gaps_);
  system.largest_turn = std::max(system.largest_turn, relative_change(before.spread, after.spread));
}

double ExplicitLinkages::find_residual(const Analysis& analysis, System& system, double next, bool from_rest) const {
  double largest = 0.0;
  for (const auto& member : system.members) {
    if (next > 0.0) find_gaps(analysis, system, member, next);
    const auto rates = next == 0.0 && member.cloud
                           ? member.cloud->rates(system.average, member.places.front().rotation, system.multipliers(member))
                           : Vector6{};
    for (std::size_t i = 0; i < member.rows.size(); ++i) {
      double& rate = system.residual[member.first_row + i];
      rate = 0.0;
      if (!system.holds[member.first_row + i]) continue;
      const auto* const law = member.is_guide ? &guides_.of(analysis.first_constraint_row[member.constraint] + member.rows[i]) : nullptr;
      if (next == 0.0) {
        if (member.cloud) rate = rates[member.components[member.rows[i]]];
        rate += system.rate(member, i, &Mover::velocity) - (law != nullptr && law->sticks() && !from_rest ? law->rate : 0.0);
        continue;
      }
      double gap = gaps_[member.rows[i]];
      if (law != nullptr) gap = guides_.motion(analysis, member.constraint, member.rows[i], gap) - law->held_at();
      largest = std::max(largest, std::abs(gap));
      rate = gap / next;
    }
  }
  for (const auto& mover : system.movers)
    for (std::size_t k = 0; mover.first_unknown >= 0 && k < mover.directions.size(); ++k)
      system.residual[mover.first_unknown + k] = along(mover.load + mover.constraint_force, mover.directions[k]);
  return largest;
}

/// They are close to the new ones. From the state, so that a restart begins alike.
void ExplicitLinkages::begin_with_last_multipliers(const Analysis& analysis, System& system) const {
  std::ranges::fill(system.solution, 0.0);
  for (const auto& member : system.members)
    for (std::size_t i = 0; i < member.rows.size(); ++i)
      system.solution[member.first_row + i] = -analysis.current.multiplier[analysis.first_constraint_row[member.constraint] + member.rows[i]];
}

double ExplicitLinkages::solve(Analysis& analysis, System& system, const Instant& instant) {
  constexpr double resolution = 4.0 * std::numeric_limits<double>::epsilon();
  begin_with_last_multipliers(analysis, system);
  take_guides(analysis, system);
  double gap = 0.0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    find_constraint_forces(system);
    find_velocities(analysis, system, instant);
    const double before = gap;
    gap = find_residual(analysis, system, instant.next);
    const bool resolved = gap <= resolution * size_ || (iteration > 1 && !(gap <= 0.5 * before));
    if (iteration > 0 && (instant.next == 0.0 || resolved)) break;
    correct(system);
    // The matrix is that of the start of the increment: a correction leaves as much of a gap as gradients change until its end.
    constexpr double safety = 10.0;
    if (system.has_guides || instant.next == 0.0 || !(safety * system.largest_turn * gap <= resolution * size_)) continue;
    find_constraint_forces(system);
    for (auto& mover : system.movers)
      if (mover.kind == Mover::Kind::translation || mover.kind == Mover::Kind::rotation) find_node_velocity(system, mover, instant.average());
    break;
  }
  return gap;
}

void ExplicitLinkages::find_motion(Analysis& analysis, const Instant& instant, const NodalForces& forces) {
  guides_.begin_increment(analysis);
  guides_.aim(analysis, instant);
  guides_.guess(analysis);
  const auto& state = analysis.current;
  const double average = instant.average();
  sum_clouds(analysis, {state.position.data(), state.velocity.data(), forces.force, average}, farthest * size_ / average);
  for (auto& system : systems_) {
    find_places(analysis, system);
    take_guides(analysis, system);
    const bool constant = system.is_linear && system.factorized_for == instant.average();
    if (!constant) {
      find_gradient(analysis, system);
      find_responses(analysis, system);
      factorize(analysis, system, instant.average());
    }
    system.average = instant.average();
    find_base(analysis, system, instant, forces);
    double gap = solve(analysis, system, instant);
    for (int pass = 0; pass < most_passes && settle_guides(analysis, system, instant.next); ++pass) {
      take_guides(analysis, system);
      factorize(analysis, system, instant.average());
      gap = solve(analysis, system, instant);
    }
    if (!(gap <= largest_gap * size_)) report_apart(analysis, system, gap);
    for (const auto& member : system.members)
      for (std::size_t i = 0; i < member.rows.size(); ++i)
        analysis.current.multiplier[analysis.first_constraint_row[member.constraint] + member.rows[i]] = -system.solution[member.first_row + i];
    for (const auto& mover : system.movers)
      if (mover.kind == Mover::Kind::body) bodies_.add_force(static_cast<std::size_t>(mover.index), mover.constraint_force);
    for (auto& member : system.members)
      if (member.cloud)
        member.cloud->find_changes(forces.force, system.average, member.places.front().rotation, system.multipliers(member));
  }
  clusters_.find_motion(analysis, instant, forces);
}

void ExplicitLinkages::add_to_reactions(NodalConstraints& translations, NodalConstraints& rotations) const {
  for (const auto& system : systems_)
    for (const auto& mover : system.movers) {
      if (mover.conditions.empty()) continue;
      auto& constraints = mover.kind == Mover::Kind::translation ? translations : rotations;
      constraints.add_to_reactions(mover.index, mover.constraint_force.translation().component);
    }
}

void ExplicitLinkages::set_velocities(Analysis& analysis) const {
  for (const auto& system : systems_)
    for (const auto& mover : system.movers) {
      if (mover.kind != Mover::Kind::translation && mover.kind != Mover::Kind::rotation) continue;
      auto& velocity = mover.kind == Mover::Kind::translation ? analysis.current.velocity : analysis.current.angular_velocity;
      std::copy_n(mover.velocity.component.begin(), 3, &velocity[4 * static_cast<std::size_t>(mover.index)]);
    }
  for (const auto& system : systems_)
    for (const auto& member : system.members)
      if (member.cloud) member.cloud->add_changes(analysis.current.velocity.data());
  clusters_.set_velocities(analysis);
}

void ExplicitLinkages::add_gyroscopic_moments(double* moment) const {
  for (const auto& system : systems_)
    for (const auto& mover : system.movers)
      for (int c = 0; mover.kind == Mover::Kind::gyroscopic && c < 3; ++c)
        moment[4 * static_cast<std::ptrdiff_t>(mover.index) + c] += mover.constraint_force[c];
}

void ExplicitLinkages::add_to_output(Analysis& analysis) const {
  for (const auto& system : systems_)
    for (const auto& mover : system.movers) {
      if (mover.kind != Mover::Kind::translation && mover.kind != Mover::Kind::rotation) continue;
      auto& acceleration = mover.kind == Mover::Kind::translation ? analysis.acceleration : analysis.angular_acceleration;
      for (int c = 0; c < 3; ++c)
        acceleration[4 * static_cast<std::size_t>(mover.index) + c] = (mover.velocity[c] - mover.old_velocity[c]) / system.average;
    }
  for (const auto& system : systems_)
    for (const auto& member : system.members)
      if (member.cloud) member.cloud->set_accelerations(system.average, analysis.acceleration.data());
  clusters_.add_to_output(analysis);
}

}  // namespace balocco
