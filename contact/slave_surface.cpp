#include "slave_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "elements/element_type.hpp"
#include "elements/surface_nodes.hpp"
#include "sections/membrane_section.hpp"
#include "sections/shell_section.hpp"
#include "materials/material_law.hpp"
#include "math/tensor.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

Vector3<double> at(const Model& model, std::int32_t row) {
  return {model.nodes.coordinates[row]};
}

InputError refused(const Model& model, const ContactPair& pair, const std::string& what) {
  return InputError(fmt::format("{}: error: *CONTACT PAIR: {}", model.where(pair.location), what));
}

/// Fan of triangles about the centroid: centroid, area, area vector, and the volume between the face and the origin of
/// coordinates.
struct FaceGeometry {
  Vector3<double> centroid{}, area_vector{};
  double area = 0.0, volume = 0.0;
};

FaceGeometry face_geometry(const Model& model, const std::vector<std::int32_t>& nodes) {
  FaceGeometry face;
  const auto n = nodes.size();
  for (const auto row : nodes) face.centroid = face.centroid + 1.0 / static_cast<double>(n) * at(model, row);
  for (std::size_t i = 0; i < n; ++i) {
    const auto a = at(model, nodes[i]) - face.centroid, b = at(model, nodes[(i + 1) % n]) - face.centroid;
    const auto twice_area = cross(a, b);
    face.area_vector = face.area_vector + 0.5 * twice_area;
    face.area += 0.5 * std::sqrt(dot(twice_area, twice_area));
    face.volume += dot(face.centroid, twice_area) / 6.0;
  }
  return face;
}

double element_volume(const Model& model, const ElementRef& element) {
  double volume = 0.0;
  const auto faces = static_cast<std::int32_t>(model.elements[element.table].type->faces.size());
  for (std::int32_t face = 0; face < faces; ++face)
    volume += face_geometry(model, face_nodes(model, {element, face})).volume;
  return volume;
}

/// Modulus of a section against compression in one direction at rest. Solids: of the law; membranes: times the
/// thickness; trusses: times the section. 0 where the section has no stiffness or its law is missing.
class SectionModuli {
 public:
  explicit SectionModuli(const Model& model) : model_(model) {}

  double operator()(std::int32_t section) {
    const auto [place, fresh] = known_.try_emplace(section, 0.0);
    if (fresh) place->second = modulus(model_.sections[section]);
    return place->second;
  }

 private:
  double modulus(const Section& section) const {
    if (section.kind == Section::Kind::shell) {
      const ShellSection shell = shell_section(model_, section);
      return std::max(shell.stiffness.membrane[0], shell.stiffness.membrane[4]) * shell.thickness;
    }
    if (section.kind == Section::Kind::membrane) {
      const MembraneSection membrane = membrane_section(model_, section);
      return membrane.initial_modulus * membrane.thickness;
    }
    if (section.material < 0) return 0.0;
    const Material& material = model_.materials[section.material];
    if (section.kind == Section::Kind::solid)
      if (const auto law = make_law<PointKind::solid>(material)) return modulus_at_rest(*law);
    if (section.kind == Section::Kind::truss)
      if (const auto law = make_law<PointKind::line>(material)) return section.area * modulus_at_rest(*law);
    return 0.0;
  }

  template <PointKind kind>
  static double modulus_at_rest(const Law<kind>& law) {
    PointBatch<kind> points{};
    points.count = pack_size;
    if constexpr (kind == PointKind::solid)
      for (const int diagonal : {0, 4, 8}) std::fill_n(points.strain[diagonal], pack_size, 1.0);
    std::vector<double> history(static_cast<std::size_t>(law.history_size()) * pack_size, 0.0);
    points.history = history.data();
    points.history_stride = pack_size;
    law.stress(points);
    return (kind == PointKind::solid ? points.volumetric_modulus[0] : 0.0) + 2.0 * points.shear_modulus[0];
  }

  const Model& model_;
  std::map<std::int32_t, double> known_;
};

/// Sums of shares per model row, and the list of rows that got any.
struct Shares {
  std::vector<double> area, stiffness;  // per model row
  explicit Shares(const Model& model) : area(model.nodes.size(), 0.0), stiffness(model.nodes.size(), 0.0) {}
};

void add_face(const Model& model, const FaceRef& face, SectionModuli& moduli, Shares& shares) {
  const ElementTable& table = model.elements[face.element.table];
  const auto nodes = face_nodes(model, face);
  const FaceGeometry geometry = face_geometry(model, nodes);
  const double modulus = moduli(table.section[face.element.row]);
  // M / h: over the element's thickness; a membrane's modulus holds its thickness already.
  const double per_area = table.type->section == Section::Kind::solid
                              ? modulus * geometry.area / element_volume(model, face.element)
                              : modulus / geometry.area;
  const double share = geometry.area / static_cast<double>(nodes.size());
  for (const auto row : nodes) {
    shares.area[row] += share;
    shares.stiffness[row] += 0.5 * per_area * share;
  }
}

double stiffness_at_node(const Model& model, const ElementRef& element, double modulus) {
  const ElementTable& table = model.elements[element.table];
  if (table.type->section == Section::Kind::solid) return 0.125 * modulus * std::cbrt(element_volume(model, element));
  if (table.type->section == Section::Kind::membrane || table.type->section == Section::Kind::shell) return 0.125 * modulus;
  const auto* ends = &table.connectivity[element.row * table.type->nodes];
  const auto axis = at(model, ends[1]) - at(model, ends[0]);
  return 0.5 * modulus / std::sqrt(dot(axis, axis));
}

void add_elements_at_nodes(const Model& model, const std::vector<std::int32_t>& nodes, SectionModuli& moduli,
                           Shares& shares) {
  for (const auto row : nodes) shares.area[row] = 1.0;
  for (std::size_t t = 0; t < model.elements.size(); ++t) {
    const ElementTable& table = model.elements[t];
    const Section::Kind kind = table.type->section;
    if (kind == Section::Kind::mass || kind == Section::Kind::rotary_inertia) continue;
    for (std::int32_t element = 0; element < table.size(); ++element) {
      const auto* first = &table.connectivity[element * table.type->nodes];
      if (std::none_of(first, first + table.type->nodes, [&](auto row) { return shares.area[row] > 0.0; })) continue;
      const double stiffness =
          stiffness_at_node(model, {static_cast<std::int32_t>(t), element}, moduli(table.section[element]));
      for (const auto* node = first; node != first + table.type->nodes; ++node)
        if (shares.area[*node] > 0.0) shares.stiffness[*node] += stiffness;
    }
  }
}

}  // namespace

SlaveNodes slave_nodes(const Model& model, const ContactPair& pair) {
  const Surface& slave = model.surfaces[pair.slave];
  SectionModuli moduli(model);
  Shares shares(model);
  if (slave.kind == Surface::Kind::element_faces) {
    for (const FaceRef& face : slave.faces) add_face(model, face, moduli, shares);
  } else if (slave.kind == Surface::Kind::nodes) {
    add_elements_at_nodes(model, slave.nodes, moduli, shares);
  } else {
    throw refused(
        model, pair,
        fmt::format("the slave surface {} is an analytical rigid surface; name the deformable surface first and the "
                    "rigid one second",
                    slave.name));
  }
  const double scale = pair.interaction < 0 ? 1.0 : model.interactions[pair.interaction].penalty_scale;
  SlaveNodes result;
  for (std::int32_t row = 0; row < model.nodes.size(); ++row) {
    if (shares.area[row] == 0.0) continue;
    if (!(shares.stiffness[row] > 0.0))
      throw refused(model, pair,
                    fmt::format("node {} of the slave surface {} belongs to no element with a stiffness, so that "
                                "nothing can press on it; give its elements a section with a material",
                                model.nodes.id[row], slave.name));
    result.rows.push_back(row);
    result.area.push_back(shares.area[row]);
    result.stiffness.push_back(scale * shares.stiffness[row]);
  }
  if (result.rows.empty())
    throw refused(model, pair, fmt::format("the slave surface {} has no faces and no nodes; give it some", slave.name));
  return result;
}

bool faces_away(const Model& model, const Surface& slave, const MasterSurface& master, const Point& master_reference) {
  if (slave.faces.empty()) return false;
  return std::all_of(slave.faces.begin(), slave.faces.end(), [&](const FaceRef& face) {
    const FaceGeometry geometry = face_geometry(model, face_nodes(model, face));
    const auto nearest = master.nearest(geometry.centroid - Vector3<double>{master_reference});
    // A face at right angles to the surface does not face away, whatever round-off says.
    return dot(nearest.normal, geometry.area_vector) > 1e-6 * geometry.area;
  });
}

bool faces_away(const Model& model, const Surface& slave, const Surface& master) {
  std::vector<FaceGeometry> faces;
  for (const auto& face : master.faces) faces.push_back(face_geometry(model, face_nodes(model, face)));
  if (slave.faces.empty() || faces.empty()) return false;
  return std::ranges::all_of(slave.faces, [&](const FaceRef& face) {
    if (model.elements[face.element.table].type->section != Section::Kind::solid) return false;  // sheets may be pushed from either side
    const FaceGeometry geometry = face_geometry(model, face_nodes(model, face));
    const auto distance = [&](const FaceGeometry& other) {
      const auto apart = other.centroid - geometry.centroid;
      return dot(apart, apart);
    };
    const auto nearest = std::ranges::min_element(faces, {}, distance);
    return dot(nearest->area_vector, geometry.area_vector) > 1e-6 * nearest->area * geometry.area;
  });
}

}  // namespace balocco
