#include "builders/car/chassis_shells.hpp"

#include <cmath>
#include <numbers>

namespace balocco::car {
namespace {

bool in_the_middle(const Vector& place) {
  return place[1] == 0.0;
}

/// A smooth line through points of the left half; where it meets the car's middle it crosses it squarely.
Curve left_half(const std::vector<Vector>& points) {
  auto all = points;
  all.insert(all.begin(), mirrored(points[1]));
  if (in_the_middle(points.back())) all.push_back(mirrored(points[points.size() - 2]));
  std::array<std::vector<std::array<double, 2>>, 3> rows;
  double at = 0.0, last = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) at += length(all[i] - all[i - 1]);
    if (i == points.size()) last = at;
    for (int c = 0; c < 3; ++c) rows[c].push_back({at, all[i][c]});
  }
  const Graph x(rows[0]), y(rows[1]), z(rows[2]);
  return Curve::of(rows[0][1][0], last, [&](double s) { return Vector{x(s), y(s), z(s)}; });
}

/// Its frames, `out` upwards; in the middle they stand square to it, so that both sides meet in one plane.
std::vector<Frame> frames_of_half(const std::vector<Vector>& points, double size) {
  const Vector up{0.0, 0.0, 1.0};
  auto run = frames(left_half(points), size, [&](const Vector&) { return up; });
  const auto straighten = [&](Frame& frame) {
    frame.place[1] = 0.0;
    frame.along = {0.0, frame.along[1] > 0.0 ? 1.0 : -1.0, 0.0};
    frame.out = up;
    frame.across = cross(frame.along, frame.out);
  };
  straighten(run.front());
  if (in_the_middle(points.back())) straighten(run.back());
  return run;
}

/// A sheet whose rows begin in the car's middle, with its mirror image in one piece: a ring where they end there too.
Sheet with_mirror_image(const Sheet& left) {
  const int last = left.rows - 1;
  const bool ring = in_the_middle(left.at(last, 0));
  Sheet whole{.part = left.part, .rows = left.columns, .columns = 2 * last + (ring ? 0 : 1), .closed = ring, .turned = true};
  for (int column = 0; column < left.columns; ++column)
    for (int row = ring ? 1 - last : -last; row <= last; ++row)
      whole.points.push_back(row < 0 ? mirrored(left.at(-row, column)) : left.at(row, column));
  return whole;
}

}  // namespace

void add_subframe(const CarSpec& spec, BodyMesh& mesh) {
  mesh.begin_assembly("SUBFRAME");
  const auto& member = spec.members.at("subframe");
  const auto run = frames_of_half(spec.chassis.front.subframe.line, spec.mesh_size);
  auto lower = member.outer;
  lower.depth = -member.inner_depth;
  mesh.add(with_mirror_image(hat_along("SUBFRAME_UPPER", run, member.outer, spec.mesh_size)));
  mesh.add(with_mirror_image(hat_along("SUBFRAME_LOWER", run, lower, spec.mesh_size)));
}

void add_torsion_beam(const CarSpec& spec, BodyMesh& mesh) {
  mesh.begin_assembly("REAR_AXLE");
  const auto& beam = spec.chassis.rear.beam;
  const auto run = frames_of_half(beam.line, spec.mesh_size);
  const double half = 0.5 * beam.opening * std::numbers::pi / 180.0;
  const auto across = stations({-beam.leg, 0.0, beam.leg}, spec.mesh_size);
  Sheet left{.part = "TORSION_BEAM", .rows = static_cast<int>(run.size()), .columns = static_cast<int>(across.size())};
  for (const auto& frame : run)
    for (const double station : across)
      left.points.push_back(frame.place + station * std::sin(half) * frame.across - std::abs(station) * std::cos(half) * frame.out);
  mesh.add(with_mirror_image(left));
}

std::array<std::vector<int>, 2> ends_of_torsion_beam(const BodyMesh& mesh) {
  const auto& part = *mesh.find("TORSION_BEAM");
  std::array<std::vector<int>, 2> ends;
  for (int first = part.first_node; first < part.first_node + part.nodes; first += part.columns) {
    ends[0].push_back(first + part.columns - 1);
    ends[1].push_back(first);
  }
  return ends;
}

}  // namespace balocco::car
