// Stress resultants of a shell section at one point of the surface.
#include <Eigen/Dense>

#include "sections/shell_section.hpp"

namespace balocco {

namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

Matrix6 section_stiffness(const ShellStiffness& relative, double h) {
  Matrix6 d;
  d.topLeftCorner<3, 3>() = h * Eigen::Map<const Matrix3>(relative.membrane.data());
  d.topRightCorner<3, 3>() = h * h * Eigen::Map<const Matrix3>(relative.coupling.data());
  d.bottomLeftCorner<3, 3>() = d.topRightCorner<3, 3>().transpose();
  d.bottomRightCorner<3, 3>() = h * h * h * Eigen::Map<const Matrix3>(relative.bending.data());
  return d;
}

std::array<double, 3> strain_of_layer(const ShellSection& section, const ShellLayer& layer, double h,
                                      const std::array<double, 6>& strain) {
  return layer_strain<double>(section.plies[layer.ply], layer.height * h, {strain[0], strain[1], strain[2]},
                              {strain[3], strain[4], strain[5]});
}

}  // namespace

void shell_resultants(const ShellSection& section, double h, const std::array<double, 6>& strain,
                      double increment, std::span<double> history, std::array<double, 6>& resultants, std::span<double> stiffness) {
  if (section.linear) {
    const Matrix6 d = section_stiffness(section.stiffness, h);
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(resultants.data()) =
        d * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(strain.data());
    if (!stiffness.empty()) Eigen::Map<Matrix6>(stiffness.data()) = d;
    return;
  }
  ShellStiffness sum;
  resultants.fill(0.0);
  for (const ShellLayer& layer : section.layers) {
    const ShellPly& ply = section.plies[layer.ply];
    std::array<double, 3> stress;
    PlaneStiffness tangent;
    ply.law->tangent(strain_of_layer(section, layer, h, strain), increment,
                     history.subspan(layer.history, ply.law->history_size()), stress, tangent);
    stress = stress_in_section(ply, stress);
    if (ply.turned) tangent = rotated_stiffness(tangent, std::atan2(ply.sine, ply.cosine));
    for (int i = 0; i < 3; ++i) {
      resultants[i] += layer.weight * h * stress[i];
      resultants[3 + i] += layer.weight * h * (layer.height * h) * stress[i];
    }
    for (int i = 0; i < 9; ++i) {
      sum.membrane[i] += layer.weight * tangent[i];
      sum.coupling[i] += layer.weight * layer.height * tangent[i];
      sum.bending[i] += layer.weight * layer.height * layer.height * tangent[i];
    }
  }
  if (!stiffness.empty()) Eigen::Map<Matrix6>(stiffness.data()) = section_stiffness(sum, h);
}

EnergyDensity shell_energy(const ShellSection& section, double h, const std::array<double, 6>& strain,
                           std::span<const double> history) {
  if (section.linear) {
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> e(strain.data());
    return {0.5 * e.dot(section_stiffness(section.stiffness, h) * e), 0.0, 0.0};
  }
  EnergyDensity sum;
  for (const ShellLayer& layer : section.layers) {
    const ShellPly& ply = section.plies[layer.ply];
    const EnergyDensity density = ply.law->energy_density(strain_of_layer(section, layer, h, strain),
                                                          history.subspan(layer.history, ply.law->history_size()));
    sum.recoverable += layer.weight * h * density.recoverable;
    sum.plastic += layer.weight * h * density.plastic;
    sum.viscous += layer.weight * h * density.viscous;
    sum.heat += layer.weight * h * density.heat;
  }
  return sum;
}

}  // namespace balocco
