// Side structure: hinge and B pillars, the frame of A pillar, roof rail and D pillar, quarter panels with their waist rail and the
// rear wheel arches.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "builders/car/body_parts.hpp"

namespace balocco::car {
namespace {

void add_pillars(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh) {
  const auto& body = spec.body;
  const double size = spec.mesh_size, sill_top = body.sill_height + 0.5 * spec.members.at("sill").outer.width;
  const double flange_plane = body.floor_half_width + spec.members.at("sill").inner_depth;
  const auto leftwards = [](const Vector&) { return Vector{0.0, 1.0, 0.0}; };
  const auto& hinge = spec.members.at("hinge_pillar");
  const auto top = shape.waist(body.pillar_front, hinge.outer.depth);
  add_halves("HINGE_PILLAR", frames(Curve({{body.pillar_front, flange_plane, sill_top}, top}), size, leftwards), hinge, size, mesh);

  const auto& middle = spec.members.at("b_pillar");
  const double x = body.pillar_middle, roof = shape.roof_edge(x)[2] - 0.45 * spec.members.at("side_frame").outer.width;
  std::vector<Vector> line{{x, flange_plane, sill_top}};
  for (const double part : {0.3, 0.55, 0.8, 1.0})
    line.push_back(shape.skin(x, sill_top + part * (roof - sill_top), middle.outer.depth));
  add_halves("B_PILLAR", frames(Curve::through(line), size, leftwards), middle, size, mesh);
}

/// The skin between two lines drawn in side view.
Sheet skin_panel(const std::string& part, const BodyShape& shape, const Curve& lower, const Curve& upper, double size) {
  const double height =
      std::max(length(upper.at(0.0) - lower.at(0.0)), length(upper.at(upper.length()) - lower.at(lower.length())));
  return sheet_on(part, stations({0.0, 1.0}, size / std::max(lower.length(), upper.length())), stations({0.0, 1.0}, size / height),
                  [&](double u, double v) {
                    const auto below = lower.at(u * lower.length()), above = upper.at(u * upper.length());
                    const auto on = below + v * (above - below);
                    return shape.skin(on[0], on[2]);
                  });
}

void add_quarter(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh) {
  const auto& body = spec.body;
  const auto& profile = spec.profile;
  const double size = spec.mesh_size, wheel = -profile.wheelbase, radius = profile.arch_radius;
  const double sill_top = body.sill_height + 0.5 * spec.members.at("sill").outer.width;
  const double low_end = profile.tail(profile.bumper_height), high_end = profile.tail(profile.waist(profile.tail.last()));
  const auto lower = Curve::of(body.pillar_middle, low_end, [&](double x) {
    return Vector{x, 0.0, shape.arch_height(wheel, x, x > wheel ? sill_top : profile.bumper_height)};
  });
  const auto upper = Curve::of(body.pillar_middle, high_end, [&](double x) { return Vector{x, 0.0, profile.waist(x)}; });
  mesh.add_both(skin_panel("QUARTER_PANEL", shape, lower, upper, size));

  const auto frame_edge = [&](double x) {
    return Vector{x, 0.0, profile.roof(x) - profile.roof_crown - 0.5 * spec.members.at("side_frame").outer.width};
  };
  const auto waist_behind = Curve::of(profile.window_rear, high_end, [&](double x) { return Vector{x, 0.0, profile.waist(x)}; });
  const auto roof_behind = Curve::of(profile.window_rear - 60.0, profile.roof.first(), frame_edge);
  mesh.add_both(skin_panel("C_PILLAR", shape, waist_behind, roof_behind, size));

  const auto& rail = spec.members.at("waist_rail").outer;
  const auto waist = Curve::of(body.pillar_middle, high_end + 40.0, [&](double x) {
    return shape.waist(x, 0.5 * rail.depth) - Vector{0.0, 0.0, 0.5 * rail.width};
  });
  mesh.add_both(tube_along("WAIST_RAIL",
                           frames(waist, size,
                                  [](const Vector&) {
                                    return Vector{0.0, 1.0, 0.0};
                                  }),
                           rail.width, rail.depth, size));

  // A shell of revolution about the wheel's axis: a flat inner side, a shoulder, a hoop out to the skin.
  constexpr double degree = std::numbers::pi / 180.0, first = 8.0 * degree, last = 172.0 * degree;
  const double inner = body.rear_floor_half_width, hub = 0.35 * radius;
  const double hoop = shape.side(wheel, profile.wheel_height + radius) - inner;
  mesh.add_both(sheet_on("REAR_WHEEL_ARCH", stations({first, last}, size / radius),
                         stations({0.0, 1.0, 2.0}, size / std::max(hoop, radius - hub)), [&](double angle, double out) {
                           auto place = shape.arch_point(wheel, out < 1.0 ? hub + out * (radius - hub) : radius, angle, inner);
                           if (out > 1.0) place[1] += (out - 1.0) * (shape.side(place[0], place[2]) - inner);
                           return place;
                         }));
  const double y = inner + 0.5 * hoop;
  const auto arch =
      Curve::of(40.0 * degree, 140.0 * degree, [&](double angle) { return shape.arch_point(wheel, radius, angle, y); });
  const double half = radius * std::cos(40.0 * degree);
  const auto below_waist = Curve::of(wheel + half, wheel - half, [&](double x) {
    return shape.waist(x, rail.depth) - Vector{0.0, 0.0, rail.width};
  });
  mesh.add_both(between("QUARTER_INNER", arch, below_waist, size));
}

}  // namespace

void add_halves(const std::string& name, const std::vector<Frame>& run, const MemberSpec& member, double size, BodyMesh& mesh) {
  auto inner = member.outer;
  inner.depth = -member.inner_depth;
  mesh.add_both(hat_along(name + "_OUTER", run, member.outer, size));
  mesh.add_both(hat_along(name + "_INNER", run, inner, size));
}

std::vector<Frame> side_frame(const CarSpec& spec, const BodyShape& shape) {
  const auto& profile = spec.profile;
  const auto& member = spec.members.at("side_frame");
  const double depth = member.outer.depth, edge = 0.5 * member.outer.width + member.outer.flange;
  std::vector<Vector> line;
  const Vector foot = shape.waist(spec.body.pillar_front, depth), head = shape.roof_edge(profile.roof.last(), depth);
  for (const double part : {0.0, 0.33, 0.67}) {
    const auto at = foot + part * (head - foot);
    line.push_back(shape.skin(at[0], at[2], depth));
  }
  constexpr int along_roof = 6;
  for (int i = 0; i <= along_roof; ++i)
    line.push_back(shape.roof_edge(profile.roof.last() + (profile.roof.first() - profile.roof.last()) * i / along_roof, depth));
  const double top = line.back()[2], bottom = profile.bumper_height;
  for (const double part : {0.25, 0.5, 0.7, 0.85, 1.0}) {
    const double z = top + part * (bottom - top);
    line.push_back(shape.skin(profile.tail(z) + edge, z, depth));
  }
  return frames(Curve::through(line), spec.mesh_size, [&](const Vector& at) { return shape.skin_normal(at[0], at[2]); });
}

void add_sides(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh) {
  add_pillars(spec, shape, mesh);
  add_halves("SIDE_FRAME", side_frame(spec, shape), spec.members.at("side_frame"), spec.mesh_size, mesh);
  add_quarter(spec, shape, mesh);
}

}  // namespace balocco::car
