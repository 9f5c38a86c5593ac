// The lines of *DLOAD that act on all matter of an element set: GRAV, CENTRIF, BX, BY, BZ.
#pragma once

#include <cstdint>
#include <string>

#include "deck/builder.hpp"

namespace balocco::deck {

bool is_body_load(const std::string& label);

/// The labels, for a message.
std::string body_load_labels();

/// Reads one line of a label that is_body_load() knows into the step; a line for the same set and direction takes the place of
/// an earlier one.
void read_body_load(Builder& builder, const Block& block, Row& row, std::int32_t amplitude);

/// A line as read_body_load() reads it, from the label on.
std::string body_load_text(const BodyLoad& load);

}  // namespace balocco::deck
