// Roof with its headers and bows, and the tail.
#include <algorithm>

#include "builders/car/body_parts.hpp"

namespace balocco::car {
namespace {

/// A line across the car between the flanges of the two side frames, by the part of the half width from -1 to 1: a parabola whose
/// middle lies `forward` and `up` from its ends.
Vector across(const Vector& edge, double forward, double up, double part) {
  const double bulge = 1.0 - part * part;
  return {edge[0] + forward * bulge, part * edge[1], edge[2] + up * bulge};
}

Vector across_roof(const CarSpec& spec, const Vector& edge, double part) {
  return across(edge, 0.0, spec.profile.roof(edge[0]) - edge[2], part);
}

/// Edges of the left side frame's inboard flange whose x lies between two places, from front to rear.
std::vector<Vector> frame_edges(const CarSpec& spec, const BodyShape& shape, double front, double rear) {
  const auto& member = spec.members.at("side_frame").outer;
  std::vector<Vector> edges;
  for (const auto& frame : side_frame(spec, shape)) {
    const auto edge = frame.place - (0.5 * member.width + member.flange) * frame.across;
    if (edge[0] <= front && edge[0] >= rear && (edges.empty() || edge[0] < edges.back()[0])) edges.push_back(edge);
  }
  return edges;
}

Sheet sheet_across(const std::string& part, const std::vector<Vector>& edges, double size,
                   const std::function<Vector(const Vector&, double)>& line) {
  std::vector<double> rows;
  for (std::size_t row = 0; row < edges.size(); ++row) rows.push_back(static_cast<double>(row));
  return sheet_on(part, rows, stations({-1.0, 0.0, 1.0}, size / edges.front()[1]),
                  [&](double row, double along) { return line(edges[static_cast<std::size_t>(row)], along); });
}

}  // namespace

void add_roof(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh) {
  const auto& profile = spec.profile;
  const double size = spec.mesh_size;
  auto edges = frame_edges(spec, shape, profile.roof.last(), profile.roof.first());
  std::erase_if(edges, [&](const Vector& edge) { return edge[2] < profile.waist(edge[0]) + 200.0; });  // the D pillar's
  mesh.add(sheet_across("ROOF", edges, size, [&](const Vector& edge, double part) { return across_roof(spec, edge, part); }));
  // The screen stands on the cowl below and on the roof's front edge above.
  const double foot = spec.body.firewall.back()[0] + 0.5 * spec.members.at("cowl").outer.depth;
  const auto screen =
      frame_edges(spec, shape, spec.body.pillar_front + 0.5 * spec.members.at("hinge_pillar").outer.width, edges.front()[0]);
  const double low = screen.front()[2], high = edges.front()[2];
  mesh.add(sheet_across("WINDSCREEN", screen, size, [&](const Vector& edge, double part) {
    const double up = (edge[2] - low) / (high - low), crown = profile.roof(edges.front()[0]) - high;
    return across(edge, (1.0 - up) * (foot - screen.front()[0]), up * crown, part);
  }));

  const Curve edge(edges);
  const auto header = spec.members.at("roof_header").outer, bow = spec.members.at("roof_bow").outer;
  const double half = 0.5 * header.width + header.flange;
  const std::array<std::pair<const char*, double>, 4> bows{{{"ROOF_HEADER_FRONT", half},
                                                            {"ROOF_BOW_FRONT", edge.length() / 3.0},
                                                            {"ROOF_BOW_REAR", 2.0 * edge.length() / 3.0},
                                                            {"ROOF_HEADER_REAR", edge.length() - half}}};
  for (const auto& [name, at] : bows) {
    const auto line = Curve::of(-1.0, 1.0, [&, at = at](double part) { return across_roof(spec, edge.at(at), part); });
    mesh.add(hat_along(name,
                       frames(line, size,
                              [](const Vector&) {
                                return Vector{0.0, 0.0, -1.0};
                              }),
                       std::string(name).find("BOW") != std::string::npos ? bow : header, size));
  }
}

void add_rear(const CarSpec& spec, const BodyShape& shape, BodyMesh& mesh) {
  const auto& profile = spec.profile;
  const auto& frame = spec.members.at("side_frame").outer;
  const double size = spec.mesh_size, bottom = spec.body.rear_floor_height, top = profile.hatch_sill,
               edge = 0.5 * frame.width + frame.flange;
  const auto half_width = [&](double z) { return shape.skin(profile.tail(z) + edge, z, frame.depth)[1]; };
  const auto tail = [&](double z, double part) { return Vector{profile.tail(z), part * half_width(z), z}; };
  mesh.add(sheet_on("REAR_PANEL", stations({bottom, top}, size), stations({-1.0, 0.0, 1.0}, size / half_width(bottom)), tail));
  const auto& bumper = spec.members.at("bumper").outer;
  const auto tube = [&](const char* name, double z, double behind, const Hat& section) {
    const auto line = Curve::of(-1.0, 1.0, [&](double part) { return tail(z, part) + Vector{behind, 0.0, 0.0}; });
    mesh.add(tube_along(name,
                        frames(line, size,
                               [](const Vector&) {
                                 return Vector{-1.0, 0.0, 0.0};
                               }),
                        section.width, section.depth, size));
  };
  tube("REAR_BUMPER_BEAM", bottom + 0.5 * bumper.width, -0.5 * bumper.depth, bumper);
  const auto& sill = spec.members.at("front_frame").outer;
  tube("HATCH_SILL", top, 0.5 * sill.depth, sill);
}

}  // namespace balocco::car
