// *TIE.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraints/face_projection.hpp"
#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "elements/surface_nodes.hpp"
#include "elements/turning_nodes.hpp"

namespace balocco::deck {

namespace {

/// One pair of surfaces.
class TieReader {
 public:
  TieReader(Builder& builder, const Block& block, const DataLine& line, std::int32_t slave, std::int32_t master)
      : builder_(builder), block_(block), location_(line.location), slave_(builder.model.surfaces[slave]), master_(builder.model.surfaces[master]) {}

  void read() {
    if (master_.kind != Surface::Kind::element_faces || master_.faces.empty())
      return builder_.error(block_, location_,
                            fmt::format("the second surface, {}, is the master and must be made of element faces; exchange the two, or name another",
                                        master_.name));
    const FaceProjection faces(builder_.model, master_);
    mean_edge_ = faces.mean_edge();
    const double tolerance = block_.real("POSITION TOLERANCE", 0.05 * mean_edge_);
    const auto turns = turning_nodes(builder_.model);
    const bool adjust = block_.value("ADJUST") != "NO";
    std::size_t tied = 0;
    double missed = 0.0;
    const auto rows = surface_nodes(builder_.model, slave_);
    for (const auto row : rows) {
      const auto place = faces.nearest(builder_.model.nodes.coordinates[row], tolerance);
      if (!place) continue;
      if (std::ranges::find(place->nodes, row) != place->nodes.end()) continue;  // it stands on the master itself
      add(row, *place, turns, adjust);
      ++tied;
    }
    if (adjust && kept_apart_)
      builder_.warning(block_, location_,
                       fmt::format("nodes of {} keep their distance from {}, whose nodes turn, as sheets with their thickness between them do: ADJUST moves "
                                   "nodes onto solids alone",
                                   slave_.name, master_.name));
    if (tied == rows.size()) return;
    for (const auto row : rows)
      if (const auto place = faces.nearest(builder_.model.nodes.coordinates[row], HUGE_VAL)) missed = std::max(missed, place->distance);
    const auto tell = fmt::format("{} of {} nodes of {} lie within the POSITION TOLERANCE of {:.4g} of {} (the farthest is {:.4g} away)", tied,
                                  rows.size(), slave_.name, tolerance, master_.name, missed);
    if (tied == 0)
      builder_.error(block_, location_, fmt::format("nothing is tied: {}; give a greater one, or other surfaces", tell));
    else
      builder_.warning(block_, location_, fmt::format("only {}: the others are free", tell));
  }

 private:
  /// Nodes of solids move onto the master, without strain; of shells, whose thickness may lie between, they keep their distance.
  void add(std::int32_t row, const FacePoint& place, const std::vector<bool>& turns, bool adjust) {
    Tie tie{.node = row, .others = {}, .weights = {}};
    for (std::size_t i = 0; i < place.nodes.size(); ++i) {
      if (std::abs(place.weights[i]) < 1e-12) continue;
      tie.others.push_back(place.nodes[i]);
      tie.weights.push_back(place.weights[i]);
    }
    tie.others_turn = std::ranges::all_of(tie.others, [&](std::int32_t other) { return turns[other]; });
    tie.rotations = tie.others_turn && turns[row] && !block_.has("NO ROTATION");
    kept_apart_ = kept_apart_ || (tie.others_turn && place.distance > 1e-6 * mean_edge_);
    if (adjust && !tie.others_turn) builder_.model.nodes.coordinates[row] = place.position;
    builder_.model.constraints.push_back({std::move(tie), "*TIE", location_.file, location_.line});
  }

  Builder& builder_;
  const Block& block_;
  Location location_;
  const Surface &slave_, &master_;
  double mean_edge_ = 0.0;   // of the master
  bool kept_apart_ = false;  // some node that ADJUST would move
};

void read_tie(Builder& builder, const Block& block) {
  if (block.lines.empty()) return builder.error(block, block.location, "the surfaces are missing; add a line: slave surface, master surface");
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    row.at_most(2);
    if (!row.has(0) || !row.has(1)) row.error("a tie needs two surfaces: slave, master");
    if (!row.ok()) continue;
    const auto slave = builder.require(builder.surfaces, row.name(0), block, line.location);
    const auto master = builder.require(builder.surfaces, row.name(1), block, line.location);
    if (slave && master) TieReader(builder, block, line, *slave, *master).read();
  }
}

const RegisterKeyword tie{{"TIE",
                           Phase::constraints,
                           Place::model,
                           {name("NAME"), real("POSITION TOLERANCE"), choice("ADJUST", {"YES", "NO"}), flag("NO ROTATION"),
                            foreign("TYPE")},
                           read_tie}};

}  // namespace

}  // namespace balocco::deck
