// Mass scaling of a step that has been read.
#pragma once

namespace balocco::deck {

class Builder;

/// Gives the current step the definitions that it says, and variable ones of explicit steps before that it does not replace.
void end_mass_scaling(Builder& builder);

}  // namespace balocco::deck
