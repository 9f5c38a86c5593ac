// What all keywords that give elements a section have in common.
#pragma once

#include <optional>
#include <vector>

#include "deck/builder.hpp"

namespace balocco::deck {

/// The section as far as ELSET, MATERIAL, ORIENTATION and CONTROLS say it, and the elements of its set. Nothing if a reference is
/// undefined (told) or the set is empty.
std::optional<Section> begin_section(Builder& builder, const Block& block, std::vector<ElementRef>& elements);

/// Gives the section to the elements; what has one already, or needs another kind, is told once.
void assign_section(Builder& builder, const Block& block, Section section, const std::vector<ElementRef>& elements);

/// Tells a missing MATERIAL. @return false if it is missing.
bool need_material(Builder& builder, const Block& block);

}  // namespace balocco::deck
