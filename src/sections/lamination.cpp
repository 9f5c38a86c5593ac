#include "sections/lamination.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "math/pack.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

using StiffnessMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

StiffnessMatrix as_matrix(const PlaneStiffness& stiffness) { return Eigen::Map<const StiffnessMatrix>(stiffness.data()); }

PlaneStiffness as_array(const StiffnessMatrix& matrix) {
  PlaneStiffness result;
  std::copy_n(matrix.data(), 9, result.begin());
  return result;
}

class LinearPlaneLaw final : public Law<PointKind::plane> {
 public:
  explicit LinearPlaneLaw(const PlaneStiffness& stiffness)
      : stiffness_(stiffness), half_greatest_modulus_(0.5 * greatest_modulus(stiffness)) {}

  void stress(PointBatch<PointKind::plane>& points) const override {
    for (int first = points.first; first < points.first + points.count; first += pack_size) {
      const Pack strain[3] = {load(points.strain[0] + first), load(points.strain[1] + first),
                              load(points.strain[2] + first)};
      for (int i = 0; i < 3; ++i) store(row_times(i, strain), points.stress[i] + first);
      store(Pack(half_greatest_modulus_), points.shear_modulus + first);
    }
  }

  void tangent(std::span<const double, 3> strain, double, std::span<double>, std::span<double, 3> stress,
               std::span<double> stiffness) const override {
    for (int i = 0; i < 3; ++i) stress[i] = row_times(i, strain.data());
    if (!stiffness.empty()) std::copy(stiffness_.begin(), stiffness_.end(), stiffness.begin());
  }

  EnergyDensity energy_density(std::span<const double, 3> strain, std::span<const double>) const override {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += strain[i] * row_times(i, strain.data());
    return {0.5 * sum, 0.0, 0.0};
  }

  double transverse_stretch(std::span<const double, 3>, std::span<const double>) const override { return 1.0; }

 private:
  template <class T>
  T row_times(int i, const T* strain) const {
    return stiffness_[3 * i] * strain[0] + stiffness_[3 * i + 1] * strain[1] + stiffness_[3 * i + 2] * strain[2];
  }

  PlaneStiffness stiffness_;
  double half_greatest_modulus_;
};

/// Plane-stress stiffness of a ply in its own directions.
PlaneStiffness ply_stiffness(const Model& model, const Section& section, const Ply& ply) {
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: error: *MEMBRANE SECTION: {}", model.where(section.location), what));
  };
  if (ply.material < 0) fail("a ply names no material; give each ply one");
  const Material& material = model.materials[ply.material];
  const MaterialLaw* law = find_material_law(material.law);
  if (law == nullptr || law->lamina_stiffness == nullptr || !material.options.empty())
    fail(fmt::format("material {} of a ply is not linear elastic; give it *ELASTIC (isotropic or TYPE=LAMINA)", material.name));
  PlaneStiffness stiffness;
  law->lamina_stiffness(material.parameters, stiffness);
  return stiffness;
}

}  // namespace

PlaneStiffness rotated_stiffness(const PlaneStiffness& ply, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  StiffnessMatrix to_ply;  // strain (E11, E22, 2E12) in the axes -> in the ply's directions
  to_ply << c * c, s * s, c * s, s * s, c * c, -c * s, -2.0 * c * s, 2.0 * c * s, c * c - s * s;
  return as_array(to_ply.transpose() * as_matrix(ply) * to_ply);
}

PlaneStiffness compliance(const PlaneStiffness& stiffness) { return as_array(as_matrix(stiffness).inverse()); }

double greatest_modulus(const PlaneStiffness& stiffness) {
  const Eigen::Vector3d scale(1.0, 1.0, std::sqrt(2.0));  // 2E12 = sqrt(2) * (sqrt(2) E12), the Mandel component
  const StiffnessMatrix mandel = scale.asDiagonal() * as_matrix(stiffness) * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<StiffnessMatrix>(mandel, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

Laminate laminate(const Model& model, const Section& section) {
  Laminate result;
  for (const Ply& ply : section.plies) {
    const PlaneStiffness stiffness = rotated_stiffness(ply_stiffness(model, section, ply), ply.angle);
    const Material& material = model.materials[ply.material];
    for (int i = 0; i < 9; ++i) {
      result.stiffness[i] += ply.thickness * stiffness[i];
      result.damping_stiffness[i] += ply.thickness * material.damping_beta * stiffness[i];
    }
    result.density += ply.thickness * material.density;
    result.thickness += ply.thickness;
  }
  for (int i = 0; i < 9; ++i) {
    result.stiffness[i] /= result.thickness;
    result.damping_stiffness[i] /= result.thickness;
  }
  result.density /= result.thickness;
  return result;
}

std::unique_ptr<Law<PointKind::plane>> linear_plane_law(const PlaneStiffness& stiffness) {
  return std::make_unique<LinearPlaneLaw>(stiffness);
}

}  // namespace balocco
