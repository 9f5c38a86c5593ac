// Floor with tunnel, firewall, sills, rails below the floor, cross members, rear floor with spare-wheel well.
#include "builders/car/body_parts.hpp"

namespace balocco::car {
namespace {

/// A line on the floor at the given places.
Curve on_floor(const BodyShape& shape, const std::vector<Vector>& points) {
  const auto line = Curve::through(points);
  return Curve::of(0.0, line.length(), [&](double s) {
    const auto at = line.at(s);
    return Vector{at[0], at[1], shape.floor_height(at[0], at[1])};
  });
}

Vector down(const Vector&) {
  return {0.0, 0.0, -1.0};
}

/// Stations across the floor: its flat parts, the tunnel's sides and its crown as fine as the mesh asks for.
std::vector<double> across_floor(const BodySpec& body, double size) {
  const double flat = body.floor_half_width - body.tunnel_foot;
  const std::array<double, 5> widths{flat, std::hypot(body.tunnel_foot - body.tunnel_crown, body.tunnel_height),
                                     2.0 * body.tunnel_crown, std::hypot(body.tunnel_foot - body.tunnel_crown, body.tunnel_height),
                                     flat};
  std::vector<double> all{0.0};
  for (int piece = 0; piece < 5; ++piece) {
    const auto inside = stations({static_cast<double>(piece), piece + 1.0}, size / widths[piece]);
    all.insert(all.end(), inside.begin() + 1, inside.end());
  }
  return all;
}

void add_sill(const CarSpec& spec, BodyMesh& mesh) {
  const auto& body = spec.body;
  const auto& member = spec.members.at("sill");
  const double rear = -spec.profile.wheelbase + spec.profile.arch_radius, inward = body.floor_half_width + member.inner_depth;
  const Curve line({{body.pillar_front + 0.5 * spec.members.at("hinge_pillar").outer.width, inward, body.sill_height},
                    {rear, inward, body.sill_height}});
  const auto run = frames(line, spec.mesh_size, [](const Vector&) { return Vector{0.0, 1.0, 0.0}; });
  add_halves("SILL", run, member, spec.mesh_size, mesh);
}

void add_rails_below(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh) {
  const auto& body = spec.body;
  const double y = body.front_rail.back()[1];
  std::vector<Vector> path;
  const auto wall = shape.firewall_line(y);
  for (int i = 0; i <= 12; ++i) {
    const auto at = wall.at(wall.length() * (12 - i) / 12);
    if (at[2] < body.front_rail.back()[2] + 0.5 * spec.members.at("front_rail").outer.width + 40.0) path.push_back(at);
  }
  const double foot = body.firewall.front()[0];
  for (int i = 1; i <= 4; ++i) path.push_back({foot + (body.rail_extension - foot) * i / 4.0, y, body.floor_height});
  const auto extension = frames(Curve::through(path), spec.mesh_size, [](const Vector& at) {
    return at[2] > 260.0 ? Vector{1.0, 0.0, -0.6} : Vector{0.2, 0.0, -1.0};
  });
  mesh.add_both(hat_along("RAIL_EXTENSION", extension, spec.members.at("rail_extension").outer, spec.mesh_size));
  const auto rear = frames(on_floor(shape, body.rear_rail), spec.mesh_size, down);
  mesh.add_both(hat_along("REAR_RAIL", rear, spec.members.at("rear_rail").outer, spec.mesh_size));
}

void add_cross_members(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh) {
  const auto& body = spec.body;
  const auto& member = spec.members.at("cross_member").outer;
  const auto up = [](const Vector&) { return Vector{0.0, 0.0, 1.0}; };
  for (const auto& [name, x] :
       {std::pair{"SEAT_CROSS_MEMBER_FRONT", body.seat_front}, std::pair{"SEAT_CROSS_MEMBER_REAR", body.seat_rear}}) {
    const Curve line({{x, body.tunnel_foot, body.floor_height}, {x, body.floor_half_width, body.floor_height}});
    mesh.add_both(hat_along(name, frames(line, spec.mesh_size, up), member, spec.mesh_size));
  }
  // Below the heel plate from sill to sill; between the rear rails where the axle is hinged, and where the springs push.
  const double rail = 0.5 * spec.members.at("rear_rail").outer.width;
  for (const auto& [name, x, half] :
       {std::tuple{"HEEL_CROSS_MEMBER", body.kick_front + 50.0, body.floor_half_width},
        std::tuple{"HINGE_CROSS_MEMBER", body.kick_rear - 60.0, body.rear_rail[1][1] - rail},
        std::tuple{"AXLE_CROSS_MEMBER", -spec.profile.wheelbase + 100.0, body.rear_rail.back()[1] - rail}}) {
    const auto line = on_floor(shape, {{x, -half, 0.0}, {x, 0.0, 0.0}, {x, half, 0.0}});
    mesh.add(hat_along(name, frames(line, spec.mesh_size, down), member, spec.mesh_size));
  }
}

}  // namespace

void add_floor(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh) {
  const auto& body = spec.body;
  const double size = spec.mesh_size, foot = body.firewall.front()[0], tail = spec.profile.tail(body.rear_floor_height);
  const auto across = across_floor(body, size);
  const auto floor = [&](double x, double station) { return shape.floor(x, station); };
  mesh.add(sheet_on("FLOOR", stations({foot, body.kick_front}, size), across, floor));
  mesh.add(sheet_on(
      "REAR_FLOOR",
      stations({body.kick_front, body.kick_rear, body.well_centre + body.well_radius, body.well_centre - body.well_radius, tail},
               size),
      across, floor));
  const double wall = shape.firewall_line(0.0).length();
  mesh.add(sheet_on("FIREWALL", stations({0.0, 1.0}, size / wall), across,
                    [&](double up, double station) { return shape.firewall(up, station); }));
  add_sill(spec, mesh);
  add_rails_below(spec, shape, mesh);
  add_cross_members(spec, shape, mesh);
}

}  // namespace balocco::car
