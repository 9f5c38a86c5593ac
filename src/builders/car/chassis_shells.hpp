// Parts of the chassis that are pressed from sheet: the subframe in front, the beam that twists between the trailing arms.
#pragma once

#include "builders/car/body_mesh.hpp"
#include "builders/car/car_spec.hpp"

namespace balocco::car {

/// SUBFRAME_UPPER and SUBFRAME_LOWER: hats with their flanges on one another, each a ring in one piece.
void add_subframe(const CarSpec& spec, BodyMesh& mesh);

/// TORSION_BEAM: a V of one sheet, open downwards, from arm to arm.
void add_torsion_beam(const CarSpec& spec, BodyMesh& mesh);

/// Nodes of the beam's ends, left and right, in rising order.
std::array<std::vector<int>, 2> ends_of_torsion_beam(const BodyMesh& mesh);

}  // namespace balocco::car
