// What limits, drives or loads the components that a connector leaves: rows of a guide (model/constraint.hpp) for each element.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// Axes (rows) of the frame of an end of a connector whose node is given.
std::array<std::array<double, 3>, 3> axes_at(const Model& model, const Connector& connector, int end, std::int32_t node);

/// COMPONENT=, from 0; an error if there is no such component.
std::optional<int> component_of(Builder& builder, const Block& block);

/// What the behavior being read says of a component; made where it has said nothing yet.
Guide::Row& guide_of_behavior(Builder& builder, int component);

/// Row of the guide of an element for a component (from 0); made, the guide too, where there is none.
Guide::Row& guide_row(Builder& builder, const Connector& connector, ElementRef element, int component);

}  // namespace balocco::deck
