#include "elements/shells/shell_reference.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace balocco {

namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Modes = Eigen::Matrix<double, 3, 2>;  // strain 11, 22, 2x12 of the two modes

/// Stiffness of drilling relative to the shear stiffness in the plane: of the element's mean, which no deformation
/// calls, and of what the corners differ from it by, which in-plane bending calls: small, or it would stiffen that.
constexpr double drill_mean = 0.1, drill_deviation = 1e-4;
/// Abaqus's default of the hourglass stiffness relative to the shear stiffness (HOURGLASS=STIFFNESS).
constexpr double stiffness_coefficient = 0.005;
/// Rotary inertia per mass and area of the element in the explicit loop.
constexpr double rotary_scale = 1.0 / 8.0;

/// Flexibility in transverse shear that triangles have besides the section's, per square of the longest side and bending flexibility:
/// t^2 / (t^2 + 0.1 h^2) of the stiffness is left to a steel plate.
constexpr double added_shear_flexibility = 1.0 / 35.0;

void put(double* record, int component, double value) {
  record[component * pack_size] = value;
}

Matrix3 as_matrix(const PlaneStiffness& stiffness) {
  return Eigen::Map<const Matrix3>(stiffness.data());
}

/// Strain of the modes at a point: each is uniaxial stress along one mid-line of the element, which does work on the stretch of that
/// line alone, so that in-plane bending locks neither by parasitic shear nor by Poisson's ratio (Pian & Sumihara, Int. J. Numer.
/// Meth. Eng. 20, 1984).
Modes mode_strain(const ShellGeometry& geometry, const ShellSection& section, const ShellPoint& point) {
  const PlaneStiffness flexibility = compliance(section.stiffness.membrane);
  Modes result = Modes::Zero();
  for (const auto& line : geometry.mid_line) {
    const Eigen::Vector3d along(line[0] * line[0], line[1] * line[1], line[0] * line[1]);
    const Eigen::Vector3d strain = as_matrix(flexibility) * along;
    const double gradient = line[0] * point.hourglass_gradient[0] + line[1] * point.hourglass_gradient[1];
    result += gradient / along.dot(strain) * strain * Eigen::RowVector2d(line[0], line[1]);
  }
  return result;
}

template <int corners>
void fill_kernel_geometry(const ShellGeometry& geometry, double* record) {
  using Layout = ShellLayout<corners>;
  for (int i = 0; i < Layout::edges; ++i) {
    put(record, i, geometry.gradient1[i + 1]);
    put(record, Layout::edges + i, geometry.gradient2[i + 1]);
    if constexpr (Layout::quadrilateral) put(record, Layout::gamma + i, geometry.gamma[i + 1]);
  }
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < corners; ++i) put(record, Layout::director + 3 * i + c, geometry.director[i][c]);
    put(record, Layout::axes + c, geometry.direction1[c]);
    put(record, Layout::axes + 3 + c, geometry.direction2[c]);
  }
  if constexpr (Layout::quadrilateral) {
    double gg[3] = {};
    for (const ShellPoint& point : geometry.point) {
      const auto [g1, g2] = point.hourglass_gradient;
      gg[0] += point.area / geometry.area * g1 * g1;
      gg[1] += point.area / geometry.area * g2 * g2;
      gg[2] += point.area / geometry.area * g1 * g2;
    }
    for (int i = 0; i < 3; ++i) put(record, Layout::mean_gg + i, gg[i]);
    put(record, Layout::mean_gg + 3, geometry.warp * geometry.warp);
  }
  double spread[3] = {};
  for (int i = 0; i < corners; ++i) {
    const Vector3<double> side = geometry.edge[(i + 1) % corners] - geometry.edge[i];
    const double along1 = dot(side, geometry.direction1), along2 = dot(side, geometry.direction2);
    spread[0] += along1 * along1 / 24.0;
    spread[1] += along2 * along2 / 24.0;
    spread[2] += along1 * along2 / 24.0;
  }
  for (int i = 0; i < 3; ++i) put(record, Layout::spread + i, spread[i]);
  // What the strains start from is what they measure at rest.
  ShellKernel<double, corners> kernel;
  typename ShellKernel<double, corners>::Edges edge;
  std::array<balocco::Matrix3<double>, corners> rotation;
  for (int i = 0; i < Layout::edges; ++i) edge[i] = geometry.edge[i + 1];
  rotation.fill(balocco::Matrix3<double>::identity());
  kernel.set(record, edge, rotation);
  const auto rest = kernel.strains();
  for (int i = 0; i < 3; ++i) put(record, Layout::curvature + i, rest.curvature[i]);
  for (int i = 0; i < Layout::modes; ++i) put(record, Layout::bending_mode + i, rest.bending_mode[i]);
  for (int i = 0; i < corners; ++i) put(record, Layout::shear + i, rest.shear[i]);
}

/// MITC3 alone locks; with flexibility of the order of what linear bending lacks it converges whatever the thickness (Lyly, Stenberg &
/// Vihinen, Comput. Meth. Appl. Mech. Eng. 110, 1993; Bischoff & Bletzinger, Proc. Trends in Comput. Struct. Mech., 2001).
double shear_share(const ShellGeometry& geometry, const ShellSection& section, double thickness) {
  if (geometry.corners == 4) return 1.0;
  const double longest = 2.0 * geometry.area / geometry.length;
  const double shear = thickness * (section.shear[0] + section.shear[1]);
  const double bending = std::pow(thickness, 3) * (section.stiffness.bending[0] + section.stiffness.bending[4]);
  return bending / (bending + added_shear_flexibility * longest * longest * shear);
}

template <int corners>
void fill_elastic(const ShellGeometry& geometry, const ShellSection& section, double thickness, double shear_share, double* record) {
  using Layout = ShellLayout<corners>;
  Eigen::Matrix2d shear;
  shear << section.shear[0], section.shear[2], section.shear[2], section.shear[1];
  Eigen::Matrix<double, corners, corners> stiffness = Eigen::Matrix<double, corners, corners>::Zero();
  for (int q = 0; q < geometry.points; ++q) {
    const auto rows = shell_shear_strain<corners>(geometry.point[q]);
    const Eigen::Map<const Eigen::Matrix<double, 2, corners, Eigen::RowMajor>> strain(rows[0].data());
    stiffness += shear_share * geometry.point[q].area * thickness * strain.transpose() * shear * strain;
  }
  for (int i = 0; i < corners; ++i)
    for (int j = i; j < corners; ++j) put(record, ShellKernel<double, corners>::shear_stiffness(i, j), stiffness(i, j));
  const double drill = section.stiffness.membrane[8] * thickness * geometry.area / corners;
  put(record, Layout::drill_stiffness, drill_mean * drill);
  put(record, Layout::drill_stiffness + 1, drill_deviation * drill);
}

/// Stiffness of the modes of a one-point quadrilateral: what the full element's linear fields would store.
void fill_hourglass(const ShellGeometry& geometry, const ShellSection& section, double h,
                    const ShellHourglassOptions& options, double* hourglass) {
  const PlaneStiffness* const part[3] = {&section.stiffness.membrane, &section.stiffness.coupling,
                                         &section.stiffness.bending};
  const double power[3] = {h, h * h, h * h * h};
  for (int p = 0; p < 3; ++p) {
    Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();
    for (const ShellPoint& point : geometry.point) {
      const double factor = options.scale * point.area * power[p];
      const auto [g1, g2] = point.hourglass_gradient;
      if (options.control == HourglassControl::enhanced) {
        const Modes strain = mode_strain(geometry, section, point);
        stiffness += factor * strain.transpose() * as_matrix(*part[p]) * strain;
      } else {
        stiffness += factor * stiffness_coefficient * (*part[p])[8] * (g1 * g1 + g2 * g2) * Eigen::Matrix2d::Identity();
      }
    }
    put(hourglass, 3 * p, stiffness(0, 0));
    put(hourglass, 3 * p + 1, stiffness(1, 1));
    put(hourglass, 3 * p + 2, 0.5 * (stiffness(0, 1) + stiffness(1, 0)));
  }
}

}  // namespace

// MITC4 (Dvorkin & Bathe 1984, eq. 13) and MITC3 (Lee & Bathe 2004, eq. 31): covariant strains interpolated from the
// middles of the edges.
template <int corners>
std::array<std::array<double, corners>, 2> shell_shear_strain(const ShellPoint& point) {
  const auto [xi, eta] = point.natural;
  std::array<std::array<double, corners>, 2> natural, result;
  if constexpr (corners == 4)
    natural = {
        {{0.125 * (1.0 - eta), 0.0, -0.125 * (1.0 + eta), 0.0}, {0.0, 0.125 * (1.0 + xi), 0.0, -0.125 * (1.0 - xi)}}};
  else
    natural = {{{0.5 * (1.0 - eta), -0.5 * eta, -0.5 * eta}, {0.5 * xi, 0.5 * xi, -0.5 * (1.0 - xi)}}};
  const auto& d = point.natural_gradient;
  for (int i = 0; i < corners; ++i)
    for (int direction = 0; direction < 2; ++direction)
      result[direction][i] = d[2 * direction] * natural[0][i] + d[2 * direction + 1] * natural[1][i];
  return result;
}

template std::array<std::array<double, 3>, 2> shell_shear_strain<3>(const ShellPoint&);
template std::array<std::array<double, 4>, 2> shell_shear_strain<4>(const ShellPoint&);

double rotary_inertia_per_mass(const ShellSection& section, double thickness) {
  return section.rotary * thickness * thickness;
}

double scaled_rotary_inertia_per_mass(const ShellSection& section, double thickness, double area) {
  return std::max(rotary_inertia_per_mass(section, thickness), rotary_scale * area);
}

template <int corners, int points>
void fill_shell_reference(const ShellGeometry& geometry, const ShellSection& section, std::span<const double> thickness,
                          const ShellHourglassOptions& hourglass, double* record) {
  using Record = ShellRecord<corners, points>;
  const double mean = std::accumulate(thickness.begin(), thickness.end(), 0.0) / corners;
  for (int component = 0; component < Record::size; ++component) put(record, component, 0.0);
  fill_kernel_geometry<corners>(geometry, record);
  const double share = shear_share(geometry, section, mean);
  fill_elastic<corners>(geometry, section, mean, share, record);
  if constexpr (corners == 3) put(record, Record::shear_share, share);
  if constexpr (Record::one_point_quadrilateral)
    fill_hourglass(geometry, section, mean, hourglass, record + Record::hourglass * pack_size);
  for (int q = 0; q < points; ++q) {
    double* const data = record + (Record::point + q * Record::point_size) * pack_size;
    put(data, 0, points == 1 ? geometry.area : geometry.point[q].area);
    put(data, 1, mean);
    if constexpr (points > 1) {
      double here = 0.0;
      for (int i = 0; i < corners; ++i) here += geometry.point[q].shape[i] * thickness[i];
      put(data, 1, here);
      const Modes strain = mode_strain(geometry, section, geometry.point[q]);
      for (int i = 0; i < 3; ++i)
        for (int a = 0; a < 2; ++a) put(data, 2 + 2 * i + a, strain(i, a));
    }
  }
}

template <int corners, int points>
void set_shell_stability(const ShellGeometry& geometry, const ShellSection& section, std::span<const double> stiffness,
                         std::span<const double> mass, std::span<const double> rotary_inertia, double* record) {
  using Record = ShellRecord<corners, points>;
  constexpr int size = 6 * corners;
  Eigen::MatrixXd scaled =
      Eigen::Map<const Eigen::MatrixXd>(stiffness.data(), size, size);  // of dynamic size: quicker to compile
  double gradients = 0.0, inverse_mass = 0.0;
  for (int i = 0; i < corners; ++i) {
    const double m = mass[i] > 0.0 ? 1.0 / mass[i] : 0.0, j = mass[i] > 0.0 ? 1.0 / rotary_inertia[i] : 0.0;
    for (int c = 0; c < 6; ++c) {
      scaled.row(6 * i + c) *= std::sqrt(c < 3 ? m : j);
      scaled.col(6 * i + c) *= std::sqrt(c < 3 ? m : j);
    }
    gradients += m * (geometry.gradient1[i] * geometry.gradient1[i] + geometry.gradient2[i] * geometry.gradient2[i]);
    inverse_mass += m * geometry.gamma[i] * geometry.gamma[i];
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  put(record, Record::eigenvalue, solver.eigenvalues()[size - 1]);

  const double thickness = record[(Record::point + 1) * pack_size], volume = geometry.area * thickness;
  double gg = 0.0;
  for (const ShellPoint& point : geometry.point)
    gg += point.area / geometry.area *
          (point.hourglass_gradient[0] * point.hourglass_gradient[0] +
           point.hourglass_gradient[1] * point.hourglass_gradient[1]);
  // Bending stress turns with the directors beside the tension: at most 0.58 of what the same stress does as tension.
  put(record, Record::tension, 1.6 * volume * (gradients + gg * inverse_mass));
  const double modulus = std::min(section.stiffness.membrane[0], section.stiffness.membrane[4]);
  put(record, Record::viscosity, thickness * std::sqrt(section.density * modulus) * geometry.length);
  put(record, Record::dilatation, geometry.area * gradients);
}

template void fill_shell_reference<3, 1>(const ShellGeometry&, const ShellSection&, std::span<const double>,
                                         const ShellHourglassOptions&, double*);
template void fill_shell_reference<4, 1>(const ShellGeometry&, const ShellSection&, std::span<const double>,
                                         const ShellHourglassOptions&, double*);
template void fill_shell_reference<4, 4>(const ShellGeometry&, const ShellSection&, std::span<const double>,
                                         const ShellHourglassOptions&, double*);
template void set_shell_stability<3, 1>(const ShellGeometry&, const ShellSection&, std::span<const double>,
                                        std::span<const double>, std::span<const double>, double*);
template void set_shell_stability<4, 1>(const ShellGeometry&, const ShellSection&, std::span<const double>,
                                        std::span<const double>, std::span<const double>, double*);
template void set_shell_stability<4, 4>(const ShellGeometry&, const ShellSection&, std::span<const double>,
                                        std::span<const double>, std::span<const double>, double*);

}  // namespace balocco
