// The body in white, part by part. Each function adds the parts of one region; `body_welds` joins them all.
#pragma once

#include "builders/car/body_mesh.hpp"
#include "builders/car/body_shape.hpp"

namespace balocco::car {

void add_floor(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh);
void add_front(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh);
void add_sides(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh);
/// Both halves of a closed member of the left side, NAME_OUTER and NAME_INNER, and their mirror images.
void add_halves(const std::string& name, const std::vector<Frame>& run, const MemberSpec& member, double size, BodyMesh& mesh);

/// Frames of the left A pillar, roof rail and D pillar, which are one member.
std::vector<Frame> side_frame(const CarSpec& spec, const BodyShape& shape);
void add_roof(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh);
void add_rear(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh);

/// What is welded to what, and how often.
struct WeldLine {
  std::string first, second;
  int places = 0;
};

/// Welds the parts that meet. Beads that a coarse mesh cannot show are welded at the nearest nodes.
std::vector<WeldLine> weld_body(const CarSpec& spec, BodyMesh& mesh);

}  // namespace balocco::car
