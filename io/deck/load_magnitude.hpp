// What the keywords of loads have in common: the kind of a motion, their amplitude, and OP=NEW.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// What TYPE= says that a motion prescribes.
inline BoundaryCondition::Kind kind_of_motion(const Block& block) {
  const std::string type = block.value("TYPE", "DISPLACEMENT");
  if (type == "VELOCITY") return BoundaryCondition::Kind::velocity;
  return type == "ACCELERATION" ? BoundaryCondition::Kind::acceleration : BoundaryCondition::Kind::displacement;
}

/// Row of the amplitude that a block names, later by its TIME DELAY; -1: it names none; nothing: the amplitude is not defined or
/// missing (told). (amplitude_delay.cpp)
std::optional<std::int32_t> amplitude_of(Builder& builder, const Block& block);

/// With VALUE=ABSOLUTE the amplitude gives the magnitude itself.
inline double scaled(const Builder& builder, std::int32_t amplitude, double magnitude) {
  return builder.absolute_amplitudes.contains(amplitude) ? 1.0 : magnitude;
}

/// OP=NEW: loads of earlier steps, those that the keyword `speaks_of`, go to zero, in a static step gradually, as in Abaqus.
template <class Loads, class Choice>
void take_away(const Builder& builder, Loads& loads, Choice speaks_of) {
  for (auto& load : loads) {
    if (builder.draft.said_here(load) || !speaks_of(load)) continue;
    load.magnitude = 0.0;
    load.amplitude = -1;
  }
}

template <class Loads>
void take_away(const Builder& builder, Loads& loads) {
  take_away(builder, loads, [](const auto&) { return true; });
}

}  // namespace balocco::deck
