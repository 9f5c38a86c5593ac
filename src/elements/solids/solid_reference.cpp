#include "elements/solids/solid_reference.hpp"

#include <fmt/format.h>

#include <cmath>

#include "elements/element_type.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

using Vector = Vector3<double>;

Vector as_vector(const Point& p) {
  return {{p[0], p[1], p[2]}};
}

Vector unit(const Vector& a) {
  return (1.0 / std::sqrt(dot(a, a))) * a;
}

/// Turns axes b and c of a right-handed triad about its axis a.
void turn(std::array<Vector, 3>& axes, int a, double angle) {
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  const Vector first = axes[b], second = axes[c];
  axes[b] = std::cos(angle) * first + std::sin(angle) * second;
  axes[c] = std::cos(angle) * second - std::sin(angle) * first;
}

/// Derivative of the law at F = I, in Voigt form.
std::array<double, 36> initial_stiffness(const Law<PointKind::solid>& law) {
  static constexpr int component[6] = {0, 4, 8, 1, 2, 5};  // 11 22 33 12 13 23
  static constexpr int transposed[6] = {0, 4, 8, 3, 6, 7};
  const std::array<double, 9> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 9> stress;
  std::array<double, 81> tangent;
  std::vector<double> history(law.history_size(), 0.0);
  law.tangent(identity, 0.0, history, stress, tangent);
  std::array<double, 36> stiffness;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b)
      stiffness[6 * a + b] =
          0.25 * (tangent[9 * component[a] + component[b]] + tangent[9 * transposed[a] + component[b]] +
                  tangent[9 * component[a] + transposed[b]] + tangent[9 * transposed[a] + transposed[b]]);
  return stiffness;
}

}  // namespace

SolidMaterial SolidMaterial::of_section(const Model& model, const Section& section) {
  const Material& material = model.materials.at(section.material);
  SolidMaterial result;
  result.law = law_of_section<PointKind::solid>(material, section);
  if (result.law == nullptr)
    throw InputError(fmt::format(
        "{}: error: *SOLID SECTION: material {} has no three-dimensional law{}; give *ELASTIC or *HYPERELASTIC "
        "data for solids",
        model.where(section.location), material.name,
        material.law.empty() ? std::string() : " (" + material.law + " has none)"));
  result.density = material.density;
  result.damping_beta = material.damping_beta;
  result.stiffness = initial_stiffness(*result.law);

  PointBatch<PointKind::solid> undeformed{};
  undeformed.count = pack_size;
  for (int lane = 0; lane < pack_size; ++lane)
    for (int i = 0; i < 3; ++i) undeformed.strain[4 * i][lane] = 1.0;
  std::vector<double> history(static_cast<std::size_t>(result.law->history_size()) * pack_size, 0.0);
  undeformed.history = history.data();
  undeformed.history_stride = pack_size;
  result.law->stress(undeformed);
  result.volumetric_modulus = undeformed.volumetric_modulus[0];
  result.shear_modulus = undeformed.shear_modulus[0];
  if (result.density > 0.0)
    result.wave_speed = std::sqrt((result.volumetric_modulus + 2.0 * result.shear_modulus) / result.density);
  return result;
}

Matrix3<double> material_directions(const Model& model, const Section& section, const Point& point, ElementRef element) {
  if (section.orientation < 0) return Matrix3<double>::identity();
  const Orientation orientation = model.orientations.at(section.orientation).of(element);
  std::array<Vector, 3> axes{as_vector(orientation.axes[0]), as_vector(orientation.axes[1]),
                             as_vector(orientation.axes[2])};
  if (orientation.system == Orientation::System::cylindrical) {
    const Vector arm = as_vector(point) - as_vector(orientation.origin);
    const Vector radial = arm - dot(arm, axes[2]) * axes[2];
    if (dot(radial, radial) > 0.0) axes[0] = unit(radial);  // on the axis itself any radial direction will do
    axes[1] = cross(axes[2], axes[0]);
  }
  turn(axes, orientation.rotation_axis, orientation.additional_rotation);
  Matrix3<double> directions;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) directions(i, j) = axes[j][i];
  return directions;
}

void reference_nodes(const Model& model, const Section& section, const ElementTable& table, std::int32_t row,
                     std::span<Vector3<double>> nodes) {
  const int count = static_cast<int>(nodes.size());
  Vector centre{};
  for (int i = 0; i < count; ++i) {
    nodes[i] = as_vector(model.nodes.coordinates[table.connectivity[static_cast<std::size_t>(row) * count + i]]);
    centre = centre + (1.0 / count) * nodes[i];
  }
  const auto own = std::ranges::find(model.elements, table.type, &ElementTable::type);
  const ElementRef element{static_cast<std::int32_t>(own - model.elements.begin()), row};
  const Matrix3<double> to_material = transpose(material_directions(model, section, {centre[0], centre[1], centre[2]}, element));
  for (auto& node : nodes) node = to_material * (node - centre);
}

}  // namespace balocco
