#include "print_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "elements/element_type.hpp"
#include "gather.hpp"
#include "elements/face_shapes.hpp"
#include "math/tensor.hpp"
#include "print_text.hpp"

namespace balocco {

namespace {

using Vector = Vector3<double>;

double norm(const Vector& v) {
  return std::sqrt(dot(v, v));
}

/// Sums over a surface. Of a face: area, area times place, area vector; of an element: force and moment about the
/// origin.
struct Sums {
  double area = 0.0;
  Vector place{}, normal{}, force{}, moment{};
};
constexpr std::size_t sum_size = 13;

template <class Shape>
void add_geometry(std::span<const Vector> x, Sums& sums) {
  for (const auto& point : integration_points<Shape>()) {
    Vector by_xi{}, by_eta{}, place{};
    double weight = 0.0;
    for (int i = 0; i < Shape::nodes; ++i) {
      by_xi = by_xi + point.by_xi[i] * x[i];
      by_eta = by_eta + point.by_eta[i] * x[i];
      place = place + point.value[i] * x[i];
      weight += point.value[i];
    }
    const Vector area = cross(by_xi, by_eta);
    sums.area += weight * norm(area);
    sums.place = sums.place + norm(area) * place;
    sums.normal = sums.normal + weight * area;
  }
}

void add_face(std::vector<Vector> x, Sums& sums) {
  if (x.size() == 3) x.push_back(x.back());
  if (x.size() == 4) add_geometry<BilinearFace>(x, sums);
  if (x.size() == 6) add_geometry<QuadraticTriangleFace>(x, sums);
  if (x.size() == 8) add_geometry<SerendipityFace>(x, sums);
}

/// This rank's elements of the surface: group and lane.
std::map<ElementRef, std::pair<std::size_t, std::int32_t>> elements_here(const ResultSource& source,
                                                                         const Surface& surface) {
  std::set<ElementRef> wanted;
  for (const auto& face : surface.faces) wanted.insert(face.element);
  std::map<ElementRef, std::pair<std::size_t, std::int32_t>> here;
  for (std::size_t group = 0; group < source.groups().size(); ++group) {
    const auto& lanes = *source.groups()[group];
    for (std::int32_t lane = 0; lane < lanes.size(); ++lane)
      if (const ElementRef element{lanes.table(), lanes.row(lane)}; wanted.contains(element))
        here[element] = {group, lane};
  }
  return here;
}

void store(const Sums& sums, double* values) {
  *values++ = sums.area;
  for (const auto* vector : {&sums.place, &sums.normal, &sums.force, &sums.moment})
    values = std::ranges::copy(vector->component, values).out;
}

std::string text_of(const std::string& surface, const std::vector<double>& sums, double time) {
  const auto vector = [&](std::size_t first) { return Vector{{sums[first], sums[first + 1], sums[first + 2]}}; };
  const double area = sums[0];
  const Vector centre = (1.0 / area) * vector(1), force = vector(7), moment = vector(10);
  const Vector normal = (1.0 / norm(vector(4))) * vector(4);
  const Vector about_centre = moment - cross(centre, force);
  const double tension = dot(force, normal), torque = dot(about_centre, normal);
  const auto row = [](std::initializer_list<double> values) {
    std::string line = "  ";
    for (const double value : values) line += fmt::format(" {:13.6E}", value);
    return line + "\n\n";
  };
  return fmt::format("\n statistics for surface set {} and time {}\n\n", surface, fortran_real(time)) +
         "   total surface force (fx,fy,fz) and moment about the origin(mx,my,mz)\n\n" +
         row({force[0], force[1], force[2], moment[0], moment[1], moment[2]}) +
         "   center of gravity and mean normal\n\n" +
         row({centre[0], centre[1], centre[2], normal[0], normal[1], normal[2]}) +
         "   moment about the center of gravity(mx,my,mz)\n\n" +
         row({about_centre[0], about_centre[1], about_centre[2]}) +
         "   area, normal force (+ = tension), shear force (size), torque and bending moment (size)\n\n" +
         row({area, tension, norm(force - tension * normal), torque, norm(about_centre - torque * normal)});
}

}  // namespace

std::string section_table(const Model& model, const Communicator& communicator, const Domain& domain,
                          const ResultSource& source, const PrintOutput& output, double time) {
  const Surface& surface = model.surfaces[output.set];
  std::vector<double> displacement(3 * static_cast<std::size_t>(domain.size()), 0.0), forces;
  if (!source.state().linear) source.nodal("U", displacement);
  const auto here = elements_here(source, surface);
  std::vector<double> values(sum_size * surface.faces.size(), 0.0);
  std::set<std::pair<ElementRef, int>> counted;  // nodes of elements with several faces
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto& [element, face] = surface.faces[f];
    const auto found = here.find(element);
    if (found == here.end()) continue;
    const auto [group, lane] = found->second;
    const ElementGroup& lanes = *source.groups()[group];
    const int freedoms = lanes.freedoms_per_node();
    forces.assign(static_cast<std::size_t>(freedoms) * lanes.nodes_per_element(), 0.0);
    source.element(group, "NFORC", lane, 0, forces);
    Sums sums;
    std::vector<Vector> places;
    for (const int local : nodes_of_face(*model.elements[element.table].type, face)) {
      const auto node = lanes.nodes(lane)[local];
      Vector x;
      for (int i = 0; i < 3; ++i)
        x[i] = model.nodes.coordinates[domain.node_row[node]][i] + displacement[3 * static_cast<std::size_t>(node) + i];
      places.push_back(x);
      if (!counted.insert({element, local}).second) continue;
      const double* const force = &forces[static_cast<std::size_t>(freedoms) * local];
      sums.force = sums.force + Vector{{force[0], force[1], force[2]}};
      sums.moment = sums.moment + cross(x, Vector{{force[0], force[1], force[2]}});
    }
    add_face(std::move(places), sums);
    store(sums, &values[sum_size * f]);
  }
  merge_bits(values, communicator);
  if (!communicator.is_root()) return "";
  std::vector<double> whole(sum_size, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) whole[i % sum_size] += values[i];
  return text_of(surface.name, whole, time);
}

}  // namespace balocco
