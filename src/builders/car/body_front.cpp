// Front structure: rails, upper rails, strut houses, wheel-arch panels, cowl, front end, wings.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "builders/car/body_parts.hpp"

namespace balocco::car {
namespace {

Vector leftwards(const Vector&) {
  return {0.0, 1.0, 0.0};
}

/// The strut house in plan: a rounded rectangle about its middle, by the angle from forwards to the left.
class TowerPlan {
 public:
  explicit TowerPlan(const BodySpec& body)
      : body_(body), middle_{body.strut_top[0], body.tower_middle, body.strut_top[2] - body.tower_dome} {}
  Vector rim(double angle) const {
    constexpr double roundness = 5.0;  // 2: an ellipse
    const double c = std::cos(angle), s = std::sin(angle);
    const double reach = std::pow(std::pow(std::abs(c), roundness) + std::pow(std::abs(s), roundness), -1.0 / roundness);
    return middle_ + Vector{body_.tower_half_length * c * reach, body_.tower_half_width * s * reach, 0.0};
  }
  Vector hole(double angle) const {
    return body_.strut_top + Vector{body_.tower_hole * std::cos(angle), body_.tower_hole * std::sin(angle), 0.0};
  }
  /// Depth of the wall below the top: down to the rail inboard, clear of the wheel outboard.
  double wall_depth(double angle, double rail_top) const {
    const double inboard = middle_[2] - rail_top, outboard = 0.4 * inboard;
    return inboard + (outboard - inboard) * 0.5 * (1.0 + std::sin(angle));
  }

 private:
  const BodySpec& body_;
  Vector middle_;
};

void add_strut_house(const CarSpec& spec, double rail_top, BodyMesh& mesh) {
  const TowerPlan plan(spec.body);
  const double turn = 2.0 * std::numbers::pi, size = spec.mesh_size;
  const double around = turn * 0.5 * (spec.body.tower_half_length + spec.body.tower_half_width);
  auto angles = stations({0.0, 0.25 * turn, 0.5 * turn, 0.75 * turn, turn}, size / around * turn);
  angles.pop_back();
  constexpr double flange = 22.0;  // mm of the top turned down into the wall
  constexpr double neck = 12.0;    // mm of its hole turned up around the bearing
  const double radial = std::min(spec.body.tower_half_length, spec.body.tower_half_width) - spec.body.tower_hole;
  auto top =
      sheet_on("STRUT_HOUSE_TOP", stations({-neck, 0.0, radial, radial + flange}, size), angles, [&](double out, double angle) {
        const double part = std::clamp(out / radial, 0.0, 1.0);
        const Vector turned{0.0, 0.0, std::min(out, 0.0) + std::max(out - radial, 0.0)};
        return (1.0 - part) * plan.hole(angle) + part * plan.rim(angle) - turned;
      });
  const double below = plan.wall_depth(-0.25 * turn, rail_top) - flange;
  auto wall = sheet_on("STRUT_HOUSE_WALL", stations({-flange, 0.0, below}, size), angles, [&](double down, double angle) {
    const double stretch = down < 0.0 ? 1.0 : (plan.wall_depth(angle, rail_top) - flange) / below;
    return plan.rim(angle) - Vector{0.0, 0.0, flange + stretch * down};
  });
  top.closed = wall.closed = true;
  mesh.add_both(top);
  mesh.add_both(wall);
}

/// The wheel arches' inner panels before and behind the strut house, between the rails.
void add_aprons(const CarSpec& spec, const Curve& rail_edge, const Curve& upper_edge, BodyMesh& mesh) {
  const auto& body = spec.body;
  const auto part_of = [](const Curve& line, double x_front, double x_rear) {
    const auto at_x = [&](double x) {  // lines run rearwards
      double low = 0.0, high = line.length();
      for (int i = 0; i < 60; ++i) (line.at(0.5 * (low + high))[0] > x ? low : high) = 0.5 * (low + high);
      return low;
    };
    const double from = at_x(x_front), to = at_x(x_rear);
    return Curve::of(from, to, [&](double s) { return line.at(s); });
  };
  const double front = body.strut_top[0] + body.tower_half_length, rear = body.strut_top[0] - body.tower_half_length;
  const double wall = body.firewall.back()[0];
  mesh.add_both(between("WHEEL_ARCH_FRONT", part_of(rail_edge, body.radiator_x, front), part_of(upper_edge, body.radiator_x, front),
                        spec.mesh_size));
  mesh.add_both(between("WHEEL_ARCH_REAR", part_of(rail_edge, rear, wall), part_of(upper_edge, rear, wall), spec.mesh_size));
}

Curve moved(const Curve& line, const Vector& by) {
  return Curve::of(0.0, line.length(), [&](double s) { return line.at(s) + by; });
}

void add_front_end(const CarSpec& spec, const BodyShape& shape, double rail_y, double rail_web, BodyMesh& mesh) {
  const auto& body = spec.body;
  const double size = spec.mesh_size;
  const auto tube = [&](const std::string& name, const Curve& line, const Vector& outward, const Hat& section) {
    return tube_along(name, frames(line, size, [&](const Vector&) { return outward; }), section.width, section.depth, size);
  };
  const auto& frame = spec.members.at("front_frame").outer;
  const auto& bumper = spec.members.at("bumper").outer;
  const double post = rail_web + 0.5 * frame.depth, top = shape.side(body.radiator_x, body.radiator_top);
  const Vector forward{1.0, 0.0, 0.0};
  mesh.add(tube("RADIATOR_UPPER", Curve({{body.radiator_x, -top, body.radiator_top}, {body.radiator_x, top, body.radiator_top}}),
                forward, frame));
  mesh.add(tube("RADIATOR_LOWER",
                Curve({{body.radiator_x, -post, body.radiator_bottom}, {body.radiator_x, post, body.radiator_bottom}}), forward,
                frame));
  const double half = 0.5 * frame.width;
  mesh.add_both(
      tube("RADIATOR_POST",
           Curve({{body.radiator_x, post, body.radiator_bottom + half}, {body.radiator_x, post, body.radiator_top - half}}),
           {0.0, 1.0, 0.0}, frame));
  const double front = body.front_rail.front()[0] + 0.5 * bumper.depth, z = body.front_rail.front()[2];
  constexpr double sweep = 45.0;  // mm by which the beam's ends lie farther back
  const double end = shape.side(front - sweep, z) - 10.0;
  mesh.add(tube("BUMPER_BEAM", Curve({{front - sweep, -end, z}, {front, -rail_y, z}, {front, rail_y, z}, {front - sweep, end, z}}),
                forward, bumper));
}

/// The wing: the skin from the arch and the sill up to the waist, with a gutter that reaches in to the upper rail.
void add_wing(const CarSpec& spec, const BodyShape& shape, const Curve& upper_rail, BodyMesh& mesh) {
  const auto& body = spec.body;
  const double rear = body.pillar_front + 0.5 * spec.members.at("hinge_pillar").outer.width, front = spec.profile.wing_front;
  const auto lower = Curve::of(rear, front, [&](double x) {
    return Vector{x, 0.0, shape.arch_height(0.0, x, x < 0.0 ? body.sill_height : spec.profile.bumper_height)};
  });
  const auto upper = Curve::of(rear, front, [&](double x) { return Vector{x, 0.0, spec.profile.waist(x)}; });
  const double size = spec.mesh_size, height = 0.6 * (spec.profile.waist(0.0) - body.sill_height);
  constexpr double lip = 20.0;  // mm of the lower edge turned inwards
  mesh.add_both(sheet_on("WING", stations({0.0, 1.0}, size / lower.length()),
                         stations({-lip / height, 0.0, 1.0, 1.6}, size / height), [&](double u, double v) {
                           const auto below = lower.at(u * lower.length());
                           auto above = upper.at(u * upper.length());
                           above = Vector{0.5 * (above[0] + below[0]), 0.0, spec.profile.waist(0.5 * (above[0] + below[0]))};
                           const auto on = below + std::clamp(v, 0.0, 1.0) * (above - below);
                           auto place = shape.skin(on[0], on[2]);
                           if (v < 0.0) place[1] += v * height;
                           if (v <= 1.0) return place;
                           double low = 0.0, high = upper_rail.length();  // the rail runs rearwards
                           for (int i = 0; i < 60; ++i)
                             (upper_rail.at(0.5 * (low + high))[0] > on[0] ? low : high) = 0.5 * (low + high);
                           return place + (v - 1.0) / 0.6 * (upper_rail.at(low) - place);
                         }));
}

}  // namespace

void add_front(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh) {
  const auto& body = spec.body;
  const double size = spec.mesh_size;
  const auto& rail = spec.members.at("front_rail");
  const auto& upper = spec.members.at("upper_rail");
  const auto rail_line = Curve::through(body.front_rail), upper_line = Curve::through(body.upper_rail);
  add_halves("FRONT_RAIL", frames(rail_line, size, leftwards), rail, size, mesh);
  add_halves("UPPER_RAIL", frames(upper_line, size, leftwards), upper, size, mesh);
  const double rail_edge = 0.5 * rail.outer.width + rail.outer.flange, upper_edge = 0.5 * upper.outer.width + upper.outer.flange;
  const double rail_top = rail_line.at(0.5 * rail_line.length())[2] + rail_edge;
  add_strut_house(spec, rail_top, mesh);
  add_aprons(spec, moved(rail_line, {0.0, 0.0, rail_edge}), moved(upper_line, {0.0, 0.0, -upper_edge}), mesh);
  const auto& cowl = spec.members.at("cowl").outer;
  const double half = body.floor_half_width, x = body.firewall.back()[0] + 0.5 * cowl.depth,
               z = body.firewall.back()[2] + 0.5 * cowl.width;
  mesh.add(tube_along("COWL",
                      frames(Curve({{x, -half, z}, {x, half, z}}), size,
                             [](const Vector&) {
                               return Vector{1.0, 0.0, 0.0};
                             }),
                      cowl.width, cowl.depth, size));
  const auto& dash = spec.members.at("dash_beam").outer;
  const Curve beam({{body.dash_x, -half, body.dash_height}, {body.dash_x, half, body.dash_height}});
  mesh.add(tube_along("DASH_BEAM",
                      frames(beam, size,
                             [](const Vector&) {
                               return Vector{1.0, 0.0, 0.0};
                             }),
                      dash.width, dash.depth, size));
  add_front_end(spec, shape, body.front_rail.front()[1], body.front_rail.front()[1] + rail.outer.depth, mesh);
  add_wing(spec, shape, moved(upper_line, {0.0, 0.0, upper_edge}), mesh);
}

}  // namespace balocco::car
