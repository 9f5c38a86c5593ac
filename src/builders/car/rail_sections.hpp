// Sections across the rails of the body, by which it is told what they carry.
#pragma once

#include "builders/car/body_mesh.hpp"
#include "builders/car/deck_text.hpp"

namespace balocco::car {

/// Element sets across the middles of front rails, their extensions below the floor, and rear rails, left and right.
std::vector<std::string> rail_section_names();

/// Adds to the section of a rail those elements of its part that the section goes through; `first` is the id of the part's first.
void write_rail_section(const BodyMesh& mesh, const Part& part, std::int64_t first, DeckText& deck);

}  // namespace balocco::car
