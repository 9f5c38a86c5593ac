// What shells tell of their points, layers and sections.
#include <algorithm>
#include <cmath>

#include "elements/membranes/membrane_output.hpp"
#include "elements/plastic_strain.hpp"
#include "elements/shells/shell.hpp"
#include "materials/initial_stress.hpp"

namespace balocco {

namespace {

/// Name without the suffix that asks for the lowest or the highest layer, and that layer.
struct Request {
  std::string_view variable;
  int layer;
};

Request request(std::string_view variable, int layer, int layers) {
  if (variable.ends_with("_BOT")) return {variable.substr(0, variable.size() - 4), 0};
  if (variable.ends_with("_TOP")) return {variable.substr(0, variable.size() - 4), layers - 1};
  return {variable, layer};
}

/// Young's modulus and Poisson's ratio of an isotropic law, from its plane stress stiffness at rest.
std::array<double, 2> elastic_constants(const Law<PointKind::plane>& law) {
  std::vector<double> history(law.history_size(), 0.0);
  std::array<double, 3> stress;
  std::array<double, 9> stiffness;
  law.tangent(std::array<double, 3>{}, 0.0, history, stress, stiffness);
  const double poisson = stiffness[1] / stiffness[0];
  return {stiffness[0] * (1.0 - poisson * poisson), poisson};
}

/// Components of what belongs to a layer; 0: it does not.
int layer_components(const ShellSection& section, std::string_view variable) {
  if (section.layers.empty()) return 0;
  if (variable == "S" || variable == "LE") return 6;
  if (variable == "PE")
    return std::ranges::any_of(section.plies, [](const ShellPly& ply) { return history_scalar(*ply.law, "PEEQ") >= 0; }) ? 6 : 0;
  if (variable == "MISES" || variable == "SENER") return 1;
  return std::ranges::any_of(section.plies,
                             [&](const ShellPly& ply) { return history_scalar(*ply.law, variable) >= 0; })
             ? 1
             : 0;
}

/// Components of what belongs to the section as a whole: forces SF (11 22 12 13 23) and moments SM (11 22 12) a unit
/// length, strains SE and curvatures SK of the surface of the nodes likewise, thickness STH.
int section_components(std::string_view variable) {
  if (variable == "SF" || variable == "SE") return 5;
  if (variable == "SM" || variable == "SK") return 3;
  return variable == "STH" ? 1 : 0;
}

/// Mean transverse shear strains 2E13 and 2E23, from the gradients of the natural coordinates at the middle.
template <int corners>
std::array<double, 2> middle_shear(const double* record, const std::array<double, corners>& edge_measure) {
  using Layout = ShellLayout<corners>;
  const std::array<std::array<double, 2>, 3> natural =  // of corners 1.. relative to corner 0
      corners == 4 ? std::array<std::array<double, 2>, 3>{{{2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}}
                   : std::array<std::array<double, 2>, 3>{{{1.0, 0.0}, {0.0, 1.0}, {}}};
  ShellPoint middle;
  if constexpr (corners == 3) middle.natural = {1.0 / 3.0, 1.0 / 3.0};
  for (int i = 0; i < Layout::edges; ++i)
    for (int direction = 0; direction < 2; ++direction)
      for (int a = 0; a < 2; ++a)
        middle.natural_gradient[2 * direction + a] +=
            record[(direction * Layout::edges + i) * pack_size] * natural[i][a];
  const auto map = shell_shear_strain<corners>(middle);
  std::array<double, 2> strain{};
  for (int i = 0; i < corners; ++i)
    for (int direction = 0; direction < 2; ++direction) strain[direction] += map[direction][i] * edge_measure[i];
  return strain;
}

}  // namespace

template <int corners, int points>
int ShellGroup<corners, points>::law_field_row(std::string_view field, int integration_point) const {
  if (section_.layers.empty()) return -1;
  const ShellLayer& layer = section_.layers[integration_point % layers()];
  const int row = field_row(*section_.plies[layer.ply].law, field);
  return row < 0 ? row : integration_point / layers() * section_.history_size + layer.history + row;
}

template <int corners, int points>
int ShellGroup<corners, points>::point_components(std::string_view variable) const {
  const bool outer = variable.ends_with("_BOT") || variable.ends_with("_TOP");
  const int of_layer = layer_components(section_, request(variable, 0, layers()).variable);
  return outer || of_layer > 0 ? of_layer : section_components(variable);
}

template <int corners, int points>
void ShellGroup<corners, points>::point_output(std::string_view name, std::int32_t element, int integration_point,
                                               const NodalMotion& motion, std::span<const double> history,
                                               std::span<double> values) const {
  output_at(name, element, integration_point, kernel_at(element, motion).strains(), history, values);
}

/// What belongs to an outer layer, or to the section, is the same at all points above one another.
template <int corners, int points>
void ShellGroup<corners, points>::mean_point_output(std::string_view name, std::int32_t element, const NodalMotion& motion,
                                                    std::span<const double> history, std::span<double> values) const {
  const auto strain = kernel_at(element, motion).strains();
  const auto [variable, layer] = request(name, -1, layers());
  const int stride = layer < 0 && layer_components(section_, variable) > 0 ? 1 : layers();
  mean_of_points(values, points * layers() / stride, [&](int point, std::span<double> at_point) {
    output_at(name, element, stride * point, strain, history, at_point);
  });
}

template <int corners, int points>
void ShellGroup<corners, points>::output_at(std::string_view name, std::int32_t element, int integration_point,
                                            const ShellModes<double, corners>& strain, std::span<const double> history,
                                            std::span<double> values) const {
  const double* const data = record(element);
  const int point = integration_point / layers();
  const auto here = strain_at<double>(data, point, strain);
  const double h = data[(Record::point + point * Record::point_size + 1) * pack_size];
  double share = 1.0;
  if constexpr (corners == 3) share = data[Record::shear_share * pack_size];
  const Place at{here, h, share * h};
  const auto [variable, index] = request(name, integration_point % layers(), layers());
  if (layer_components(section_, variable) > 0) return layer_output(variable, point, index, at, history, values);
  section_output(variable, point, at, middle_shear<corners>(data, strain.shear), history, values);
}

template <int corners, int points>
void ShellGroup<corners, points>::layer_output(std::string_view variable, int point, int index, const Place& at,
                                               std::span<const double> history, std::span<double> values) const {
  const ShellLayer& layer = section_.layers[index];
  const ShellPly& ply = section_.plies[layer.ply];
  const auto own = history.subspan(point * section_.history_size + layer.history, ply.law->history_size());
  std::ranges::fill(values, 0.0);  // another ply's law may know the variable
  if (const int row = history_scalar(*ply.law, variable); row >= 0) {
    values[0] = own[row];
    return;
  }
  const auto strain = layer_strain<double>(ply, layer.height * at.thickness, at.strain.membrane, at.strain.curvature);
  const double stretch = ply.law->transverse_stretch(strain, own);
  if (variable == "LE") {
    std::ranges::copy(plane_logarithmic_strain(strain, stretch), values.begin());
  } else if (variable == "SENER") {
    values[0] = ply.law->energy_density(strain, own).recoverable;
  } else {
    std::vector<double> scratch(own.begin(), own.end());
    std::array<double, 3> stress;
    ply.law->tangent(strain, 0.0, scratch, stress, {});
    const auto cauchy = plane_cauchy_stress(strain, stress, stretch);
    if (variable == "S") std::ranges::copy(cauchy, values.begin());
    if (variable == "PE" && history_scalar(*ply.law, "PEEQ") >= 0) {
      const auto [young, poisson] = elastic_constants(*ply.law);
      std::ranges::copy(plastic_strain(plane_logarithmic_strain(strain, stretch), cauchy, young, poisson), values.begin());
    }
    if (variable == "MISES") values[0] = mises_stress(cauchy);
  }
}

template <int corners, int points>
void ShellGroup<corners, points>::section_output(std::string_view variable, int point, const Place& at,
                                                 const std::array<double, 2>& shear, std::span<const double> history,
                                                 std::span<double> values) const {
  const auto& e = at.strain.membrane;
  const auto& k = at.strain.curvature;
  if (variable == "STH") {
    double stretch = section_.layers.empty() ? 1.0 : 0.0;
    for (const ShellLayer& layer : section_.layers) {
      const ShellPly& ply = section_.plies[layer.ply];
      stretch +=
          layer.weight * ply.law->transverse_stretch(
                             layer_strain<double>(ply, layer.height * at.thickness, e, k),
                             history.subspan(point * section_.history_size + layer.history, ply.law->history_size()));
    }
    values[0] = at.thickness * stretch;
  } else if (variable == "SE") {
    std::ranges::copy(e, values.begin());
    std::ranges::copy(shear, values.begin() + 3);
  } else if (variable == "SK") {
    std::ranges::copy(k, values.begin());
  } else {
    const auto own = history.subspan(point * section_.history_size, section_.history_size);
    std::vector<double> scratch(own.begin(), own.end());
    std::array<double, 6> resultants;
    shell_resultants(section_, at.thickness, {e[0], e[1], e[2], k[0], k[1], k[2]}, 0.0, scratch, resultants, {});
    // Per current length: as stress, but with the thickness already inside.
    const int first = variable == "SF" ? 0 : 3;
    const auto turned = plane_cauchy_stress(e, {resultants[first], resultants[first + 1], resultants[first + 2]}, 1.0);
    values[0] = turned[0];
    values[1] = turned[1];
    values[2] = turned[3];
    if (variable == "SF") {
      values[3] = at.shear_thickness * (section_.shear[0] * shear[0] + section_.shear[2] * shear[1]);
      values[4] = at.shear_thickness * (section_.shear[2] * shear[0] + section_.shear[1] * shear[1]);
    }
  }
}

template class ShellGroup<3, 1>;
template class ShellGroup<4, 1>;
template class ShellGroup<4, 4>;

}  // namespace balocco
