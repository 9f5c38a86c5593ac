// What the keywords of loads have in common: the step that they belong to, their amplitude, and OP=NEW.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

inline Step& current(Builder& builder) {
  return builder.model.steps.back();
}

/// Row of the amplitude that a block names, later by its TIME DELAY; -1: it names none; nothing: the amplitude is not defined or
/// missing (told). (amplitude_delay.cpp)
std::optional<std::int32_t> amplitude_of(Builder& builder, const Block& block);

/// With VALUE=ABSOLUTE the amplitude gives the magnitude itself.
inline double scaled(const Builder& builder, std::int32_t amplitude, double magnitude) {
  return builder.absolute_amplitudes.contains(amplitude) ? 1.0 : magnitude;
}

/// OP=NEW: loads of earlier steps go to zero, in a static step gradually, as in Abaqus.
template <class Loads>
void take_away(const Builder& builder, Loads& loads) {
  for (auto& load : loads) {
    if (builder.draft.said_here(load)) continue;
    load.magnitude = 0.0;
    load.amplitude = -1;
  }
}

}  // namespace balocco::deck
