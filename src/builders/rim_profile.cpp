#include "builders/rim_profile.hpp"

#include "builders/profile_pen.hpp"

namespace balocco {
namespace {

constexpr double edge_radius = 9.0;  // mm: how the flange of a J rim is rounded
constexpr double beyond = 100.0;     // mm that the profile goes on outside the wheel

}  // namespace

double strike_radius(const TyreSpec& spec) {
  return 0.5 * spec.rim.diameter + spec.rim.flange_height + 2.0 * spec.rim.pad;
}

AnalyticalSurface rim_surface(const TyreSpec& spec, const Point& centre) {
  const auto& rim = spec.rim;
  const double seat = 0.5 * rim.diameter, radius = seat + rim.flange_height - edge_radius, thickness = edge_radius + rim.pad;
  const double axial = 0.5 * rim.width + edge_radius, foot = seat - beyond;
  ProfilePen pen({foot, axial + thickness + beyond});  // towards -y, so that the outside lies to the left
  pen.line_to(foot, axial + thickness);
  pen.line_to(radius, axial + thickness);
  pen.arc_to(radius + thickness, axial, radius, axial, false);
  pen.arc_to(radius, axial - thickness, radius, axial, false);
  pen.line_to(seat + rim.pad, axial - thickness);
  pen.line_to(seat + rim.pad, thickness - axial);
  pen.line_to(radius, thickness - axial);
  pen.arc_to(radius + thickness, -axial, radius, -axial, false);
  pen.arc_to(radius, -axial - thickness, radius, -axial, false);
  pen.line_to(foot, -axial - thickness);
  pen.line_to(foot, -axial - thickness - beyond);
  return {AnalyticalSurface::Kind::revolved, centre, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, pen.segments()};
}

}  // namespace balocco
