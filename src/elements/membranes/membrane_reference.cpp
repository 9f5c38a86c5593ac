#include "elements/membranes/membrane_reference.hpp"

#include <algorithm>
#include <cmath>

namespace balocco {

namespace {

/// Abaqus's default of the hourglass stiffness of membranes, relative to the shear modulus.
constexpr double stiffness_coefficient = 0.005;

/// Young's modulus along the axis turned by `angle` from direction 1.
double directional_modulus(const PlaneStiffness& stiffness, double angle) {
  return 1.0 / compliance(rotated_stiffness(stiffness, angle))[0];
}

/// c . t . c for the unit vector at `angle`.
double along(const PlaneTensor& t, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * c * t.c11 + s * s * t.c22 + 2.0 * c * s * t.c12;
}

/// In-plane stiffness of the hourglass amplitude per volume, in the local directions.
PlaneTensor bending_stiffness(const HourglassMode& mode, const PlaneStiffness& stiffness) {
  const double first = mode.axis_angle, second = mode.axis_angle + 0.5 * M_PI;
  const double k1 = directional_modulus(stiffness, first) * along(mode.mean_gg, first);
  const double k2 = directional_modulus(stiffness, second) * along(mode.mean_gg, second);
  const double c = std::cos(first), s = std::sin(first);
  return {k1 * c * c + k2 * s * s, k1 * s * s + k2 * c * c, (k1 - k2) * c * s};
}

struct NodalMasses {
  std::array<double, 4> inverse{};  // 0 where there is no density: then nothing limits the increment
};

NodalMasses nodal_masses(const MembraneGeometry& geometry, const MembraneSection& section, int nodes) {
  NodalMasses result;
  const double surface_density = section.density * section.thickness;
  if (surface_density > 0.0)
    for (int i = 0; i < nodes; ++i) result.inverse[i] = 1.0 / (surface_density * geometry.nodal_area[i]);
  return result;
}

/// V sum B_a B_b / m of the mean gradients.
PlaneTensor mass_gradient(const MembraneGeometry& geometry, const NodalMasses& mass, double volume) {
  PlaneTensor sum;
  for (int i = 0; i < 4; ++i) {
    const double b1 = geometry.mean_gradient1[i], b2 = geometry.mean_gradient2[i];
    sum.c11 += volume * mass.inverse[i] * b1 * b1;
    sum.c22 += volume * mass.inverse[i] * b2 * b2;
    sum.c12 += volume * mass.inverse[i] * b1 * b2;
  }
  return sum;
}

/// V sum gamma^2 / m, and the squared cosine of the angle between gamma and the mean gradients in the metric of 1 / m.
std::array<double, 2> mass_gamma(const MembraneGeometry& geometry, const NodalMasses& mass, const PlaneTensor& p,
                                 double volume) {
  double norm = 0.0, b1 = 0.0, b2 = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double weighted = volume * mass.inverse[i] * geometry.hourglass.gamma[i];
    norm += weighted * geometry.hourglass.gamma[i];
    b1 += weighted * geometry.mean_gradient1[i];
    b2 += weighted * geometry.mean_gradient2[i];
  }
  const double determinant = p.c11 * p.c22 - p.c12 * p.c12;
  if (!(determinant > 0.0)) return {norm, 0.0};
  const double projected = (p.c22 * b1 * b1 - 2.0 * p.c12 * b1 * b2 + p.c11 * b2 * b2) / determinant;
  return {norm, std::min(projected / norm, 1.0)};
}

template <class Layout>
void fill_hourglass_control(const MembraneGeometry& geometry, const MembraneSection& section,
                            const HourglassOptions& options, double volume, double* reference) {
  const HourglassMode& mode = geometry.hourglass;
  const double shear_modulus = 1.0 / compliance(section.initial_stiffness)[8];
  const double isotropic = stiffness_coefficient * shear_modulus * (mode.mean_gg.c11 + mode.mean_gg.c22);
  PlaneTensor in_plane{isotropic, isotropic, 0.0};
  if (options.control == HourglassControl::enhanced) in_plane = bending_stiffness(mode, section.initial_stiffness);
  const double factor = options.scale * volume;
  const double values[5] = {factor * in_plane.c11, factor * in_plane.c22, factor * in_plane.c12, factor * isotropic,
                            mode.warp};
  for (int c = 0; c < 5; ++c) reference[(Layout::hourglass_stiffness + c) * pack_size] = values[c];
}

template <class Layout>
void fill_stability(const MembraneGeometry& geometry, const MembraneSection& section, int nodes, double* reference) {
  const double volume = geometry.area * section.thickness;
  const NodalMasses mass = nodal_masses(geometry, section, nodes);
  const PlaneTensor p = mass_gradient(geometry, mass, volume);
  const double modulus = std::min(section.initial_stiffness[0], section.initial_stiffness[4]);
  reference[Layout::mass_gradient * pack_size] = p.c11;
  reference[(Layout::mass_gradient + 1) * pack_size] = p.c22;
  reference[(Layout::mass_gradient + 2) * pack_size] = p.c12;
  reference[Layout::viscosity * pack_size] = std::sqrt(section.density * modulus) * geometry.characteristic_length;
  if constexpr (Layout::quadrilateral) {
    const auto [norm, coupling] = mass_gamma(geometry, mass, p, volume);
    reference[Layout::mass_gamma * pack_size] = norm;
    reference[(Layout::mass_gamma + 1) * pack_size] = coupling;
    reference[(Layout::mass_gamma + 2) * pack_size] = geometry.hourglass.greatest_gradient;
    reference[(Layout::mass_gamma + 3) * pack_size] = geometry.hourglass.gradient_residual;
  }
}

}  // namespace

template <int nodes, int points>
void fill_membrane_reference(const MembraneGeometry& geometry, const MembraneSection& section,
                             const HourglassOptions& hourglass, double* reference) {
  using Layout = MembraneLayout<nodes, points>;
  for (int q = 0; q < points; ++q) {
    const MembranePoint& point = geometry.point[q];
    double* const data = reference + q * Layout::point_size * pack_size;
    for (int i = 0; i < Layout::edges; ++i) {
      data[i * pack_size] = point.gradient1[i + 1];
      data[(Layout::edges + i) * pack_size] = point.gradient2[i + 1];
    }
    data[2 * Layout::edges * pack_size] = point.area * section.thickness;
  }
  if constexpr (Layout::quadrilateral) {
    const HourglassMode& mode = geometry.hourglass;
    for (int i = 0; i < Layout::edges; ++i) reference[(Layout::gamma + i) * pack_size] = mode.gamma[i + 1];
    reference[Layout::mean_gg * pack_size] = mode.mean_gg.c11;
    reference[(Layout::mean_gg + 1) * pack_size] = mode.mean_gg.c22;
    reference[(Layout::mean_gg + 2) * pack_size] = mode.mean_gg.c12;
  }
  if constexpr (Layout::one_point_quadrilateral)
    fill_hourglass_control<Layout>(geometry, section, hourglass, geometry.area * section.thickness, reference);
  fill_stability<Layout>(geometry, section, nodes, reference);
}

template void fill_membrane_reference<3, 1>(const MembraneGeometry&, const MembraneSection&, const HourglassOptions&, double*);
template void fill_membrane_reference<4, 1>(const MembraneGeometry&, const MembraneSection&, const HourglassOptions&, double*);
template void fill_membrane_reference<4, 4>(const MembraneGeometry&, const MembraneSection&, const HourglassOptions&, double*);

}  // namespace balocco
