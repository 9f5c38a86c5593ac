// How a step begins: the velocities that a linkage allows, and the forces that hold it where nothing moves.
#include <algorithm>

#include "explicit_linkages.hpp"
#include "vectors.hpp"

namespace balocco {

void ExplicitLinkages::make_velocities_consistent(Analysis& analysis) {
  auto& state = analysis.current;
  guides_.begin_increment(analysis);
  guides_.refuse_jumps(analysis);
  guides_.aim(analysis, {state.step_time, state.total_time, 0.0, 0.0});
  guides_.guess(analysis);
  for (auto& system : systems_) {
    find_places(analysis, system);
    find_gradient(analysis, system);
    find_responses(analysis, system);
    take_guides(analysis, system);
    for (const auto& member : system.members)  // friction brakes in time
      for (std::size_t i = 0; i < member.rows.size() && member.is_guide; ++i) {
        const auto& law = guides_.of(analysis.first_constraint_row[member.constraint] + member.rows[i]);
        if (law.sticks() && law.friction != GuideLaw::unbounded) system.holds[member.first_row + i] = false;
      }
    factorize(analysis, system, 1.0);
    std::ranges::fill(system.solution, 0.0);
    std::ranges::fill(system.residual, 0.0);
    for (auto& mover : system.movers) {
      const std::size_t at = 4 * static_cast<std::size_t>(mover.index);
      mover.velocity = {};
      if (mover.kind == Mover::Kind::body)
        mover.velocity = bodies_.velocity(analysis, static_cast<std::size_t>(mover.index));
      else
        std::copy_n(&(mover.kind == Mover::Kind::translation ? state.velocity : state.angular_velocity)[at], 3, mover.velocity.component.begin());
      if (mover.first_unknown >= 0)
        for (const auto& direction : mover.directions) add_along(mover.velocity, -along(mover.velocity, direction), direction);
      mover.load = {};
      mover.constraint_force = {};
    }
    for (auto& member : system.members)
      if (member.cloud) sum_whole_cloud(analysis, member);
    find_residual(analysis, system, 0.0);
    correct(system);
    find_constraint_forces(system);
    for (auto& member : system.members)
      if (member.cloud) member.cloud->find_changes(nullptr, 1.0, member.places.front().rotation, system.multipliers(member));
    for (auto& mover : system.movers) {
      Vector6 change = mover.response * mover.constraint_force;
      for (std::size_t k = 0; mover.first_unknown >= 0 && k < mover.directions.size(); ++k)
        add_along(change, system.solution[mover.first_unknown + k], mover.directions[k]);
      mover.velocity += change;
      if (mover.kind == Mover::Kind::body) bodies_.set_velocity(analysis, static_cast<std::size_t>(mover.index), mover.velocity);
    }
    system.factorized_for = 0.0;
  }
  clusters_.make_velocities_consistent(analysis);
  set_velocities(analysis);
}

void ExplicitLinkages::add_resting_forces(const Analysis& analysis, const NodalForces& forces) {
  const double least = analysis.undeformed_increment;
  sum_clouds(analysis, {analysis.current.position.data(), nullptr, forces.force, 1.0}, size_ / (least * least));
  for (auto& system : systems_) {
    find_places(analysis, system);
    find_gradient(analysis, system);
    find_responses(analysis, system);
    std::ranges::fill(system.solution, 0.0);
    take_guides(analysis, system);
    factorize(analysis, system, 1.0);
    for (auto& mover : system.movers) {
      const std::ptrdiff_t at = 4 * static_cast<std::ptrdiff_t>(mover.index);
      mover.load = {};
      mover.constraint_force = {};
      if (mover.kind == Mover::Kind::body)
        mover.load = bodies_.force(static_cast<std::size_t>(mover.index));
      else
        std::copy_n((mover.kind == Mover::Kind::translation ? forces.force : forces.moment) + at, 3, mover.load.component.begin());
      mover.velocity = mover.response * mover.load;  // accelerations, of nodes at rest
    }
    find_residual(analysis, system, 0.0, true);
    correct(system);
    find_constraint_forces(system);
    for (const auto& member : system.members)
      if (member.cloud) member.cloud->add_constraint_forces(member.places.front().rotation, system.multipliers(member), forces.force);
    for (const auto& mover : system.movers) {
      if (mover.kind == Mover::Kind::body) {
        bodies_.add_force(static_cast<std::size_t>(mover.index), mover.constraint_force);
        continue;
      }
      double* const sum = (mover.kind == Mover::Kind::translation ? forces.force : forces.moment) + 4 * static_cast<std::ptrdiff_t>(mover.index);
      for (int c = 0; c < 3; ++c) sum[c] += mover.constraint_force[c];
    }
    system.factorized_for = 0.0;
  }
  clusters_.add_resting_forces(analysis, forces);
}

}  // namespace balocco
