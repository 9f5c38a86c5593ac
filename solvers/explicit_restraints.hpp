// Springs and dashpots in an explicit step: elements without mass move with the masses of the nodes that they hold, which
// bound the increment and the forces.
#pragma once

#include <vector>

#include "explicit_linkages.hpp"

namespace balocco {

/// What springs and dashpots do to each local node, summed over all elements and ranks, the same bits on every copy; empty where the
/// model has none of the kind.
struct NodalRestraints {
  std::vector<Restraint> translation;
  std::vector<Restraint> rotation;  // nodes that turn
};

/// Collective.
NodalRestraints nodal_restraints(const Analysis& analysis);

/// Elements of this rank that hold masses without having any: springs, dashpots and connectors.
template <class Visit>
void for_each_restraint(const Analysis& analysis, Visit visit) {
  for (const auto& group : analysis.element_groups) {
    const auto kind = analysis.model.sections[group->section()].kind;
    if (kind != Section::Kind::spring && kind != Section::Kind::dashpot && kind != Section::Kind::connector) continue;
    for (std::int32_t element = 0; element < group->size(); ++element) visit(*group, element);
  }
}
Restraint restraint_of(const ElementGroup& group, std::int32_t element, bool rotations);
bool restrains(const Restraint& of);
/// Body that moves a local node, or -1.
std::int32_t moving_body(const Analysis& analysis, std::int32_t node);
/// Of local nodes: inverse of the smallest rotary inertia of a node that turns freely; 0 if it has none.
std::vector<double> rotary_mobilities(const Analysis& analysis);

/// Makes restraints hold about where nodes are now; or where the state says that they do.
void place_restraints(Analysis& analysis);
void replace_restraints(const Analysis& analysis);
/// Whether an element of this rank has left where they hold.
bool restraints_are_left(const Analysis& analysis);

/// Refuses nodes that a spring or dashpot would have to move without a mass, or turn without a rotary inertia. @throws InputError
void refuse_massless_restraints(const Analysis& analysis, const Step& step, const ExplicitLinkages& linkages);

}  // namespace balocco
