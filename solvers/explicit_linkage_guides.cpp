// Guided components of connectors in linkages: which of their rows hold is found with the motion. A body that comes to a stop over an
// increment arrives there at its end and has lost its speed: hits are inelastic, and nothing shortens the increment.
#include "explicit_linkages.hpp"

namespace balocco {

void ExplicitLinkages::take_guides(const Analysis& analysis, System& system) const {
  for (const auto& member : system.members) {
    if (!member.is_guide) continue;
    for (std::size_t i = 0; i < member.rows.size(); ++i) {
      const auto& law = guides_.of(analysis.first_constraint_row[member.constraint] + member.rows[i]);
      system.holds[member.first_row + i] = law.holds();
      if (!law.holds()) system.solution[member.first_row + i] = -law.force();
    }
  }
}

bool ExplicitLinkages::settle_guides(const Analysis& analysis, System& system, double next) {
  bool changed = false;
  for (const auto& member : system.members) {
    if (!member.is_guide) continue;
    const auto& guide = *analysis.constraints[member.constraint];
    find_places_after(system, member, next);
    gaps_.resize(static_cast<std::size_t>(guide.rows()));
    guide.gaps(places_, gaps_);
    for (std::size_t i = 0; i < member.rows.size(); ++i) {
      const int row = member.rows[i];
      const auto place = analysis.first_constraint_row[member.constraint] + row;
      const double motion = guides_.motion(analysis, member.constraint, row, gaps_[row]);
      changed = guides_.settle(place, motion, -system.solution[member.first_row + i]) || changed;
    }
  }
  return changed;
}

void ExplicitLinkages::add_guide_work(const Analysis& analysis, Half half, double increment, std::vector<NodalWork>& work) const {
  const auto velocity = half == Half::last ? &Mover::old_velocity : &Mover::velocity;
  for (const auto& system : systems_)
    for (const auto& member : system.members) {
      if (!member.is_guide) continue;
      for (std::size_t i = 0; i < member.rows.size(); ++i) {
        const auto place = analysis.first_constraint_row[member.constraint] + member.rows[i];
        guides_.add_work(place, analysis.current.multiplier[place], 0.5 * increment * system.rate(member, i, velocity),
                         work[member.nodes.front().node]);
      }
    }
}

}  // namespace balocco
