// From a law's plain formulas, templated over the scalar, to the batched interface of materials/material_law.hpp.
//
// The formulas are an aggregate of parameters with, for history-free (elastic) laws,
//   solid: Matrix3<T> stress(const Matrix3<T>& F)             first Piola-Kirchhoff stress
//          TangentBound<T> bound(const Matrix3<T>& F)         see PointBatch
//          double energy(const Matrix3<double>& F)            per reference volume
//   plane: std::array<T, 3> stress(const std::array<T, 3>& E), T bound(E) (half the largest eigenvalue of the tangent,
//   E12
//          counted twice in dE : dE), double energy(E), double transverse_stretch(E)
//   line:  the same with std::array<T, 1>
#pragma once

#include <array>
#include <memory>
#include <span>

#include "materials/material_law.hpp"
#include "math/dual.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Bounds of the second variation of a solid's energy density, as PointBatch declares them.
template <class T>
struct TangentBound {
  T volumetric, shear;
};

/// Parameter `index` of a law as the deck gave it; 0 where a data line ended early.
inline double parameter(std::span<const double> parameters, std::size_t index) {
  return index < parameters.size() ? parameters[index] : 0.0;
}

template <class Formulas>
class SolidLawOf final : public Law<PointKind::solid> {
 public:
  explicit SolidLawOf(const Formulas& formulas) : formulas_(formulas) {}

  int history_size() const override { return 0; }

  void stress(PointBatch<PointKind::solid>& points) const override {
    for (int first = 0; first < points.count; first += pack_size) {
      Matrix3<Pack> deformation_gradient;
      for (int k = 0; k < n; ++k) deformation_gradient.component[k] = load(&points.strain[k][first]);
      const Matrix3<Pack> stress = formulas_.stress(deformation_gradient);
      const TangentBound<Pack> bound = formulas_.bound(deformation_gradient);
      for (int k = 0; k < n; ++k) store(stress.component[k], &points.stress[k][first]);
      store(bound.volumetric, &points.volumetric_modulus[first]);
      store(bound.shear, &points.shear_modulus[first]);
    }
  }

  void tangent(std::span<const double, n> strain, std::span<double>, std::span<double, n> stress,
               std::span<double, n * n> stiffness) const override {
    Matrix3<Dual<n>> deformation_gradient;
    for (int k = 0; k < n; ++k) deformation_gradient.component[k] = Dual<n>(strain[k], k);
    const Matrix3<Dual<n>> result = formulas_.stress(deformation_gradient);
    for (int i = 0; i < n; ++i) {
      stress[i] = result.component[i].value;
      for (int j = 0; j < n; ++j) stiffness[n * i + j] = result.component[i].derivative[j];
    }
  }

  double energy_density(std::span<const double, n> strain, std::span<const double>) const override {
    Matrix3<double> deformation_gradient;
    for (int k = 0; k < n; ++k) deformation_gradient.component[k] = strain[k];
    return formulas_.energy(deformation_gradient);
  }

  double transverse_stretch(std::span<const double, n>) const override { return 1.0; }

 private:
  Formulas formulas_;
};

/// Plane and line forms: Green-Lagrange strain to second Piola-Kirchhoff stress.
template <PointKind kind, class Formulas>
class ThinLawOf final : public Law<kind> {
 public:
  static constexpr int n = strain_size(kind);
  explicit ThinLawOf(const Formulas& formulas) : formulas_(formulas) {}

  int history_size() const override { return 0; }

  void stress(PointBatch<kind>& points) const override {
    for (int first = 0; first < points.count; first += pack_size) {
      std::array<Pack, n> strain;
      for (int k = 0; k < n; ++k) strain[k] = load(&points.strain[k][first]);
      const auto point = formulas_.prepare(strain);
      const std::array<Pack, n> stress = formulas_.stress(point);
      for (int k = 0; k < n; ++k) store(stress[k], &points.stress[k][first]);
      store(Pack(0.0), &points.volumetric_modulus[first]);
      store(formulas_.bound(point), &points.shear_modulus[first]);
    }
  }

  void tangent(std::span<const double, n> strain, std::span<double>, std::span<double, n> stress,
               std::span<double, n * n> stiffness) const override {
    std::array<Dual<n>, n> variables;
    for (int k = 0; k < n; ++k) variables[k] = Dual<n>(strain[k], k);
    const std::array<Dual<n>, n> result = formulas_.stress(formulas_.prepare(variables));
    for (int i = 0; i < n; ++i) {
      stress[i] = result[i].value;
      for (int j = 0; j < n; ++j) stiffness[n * i + j] = result[i].derivative[j];
    }
  }

  double energy_density(std::span<const double, n> strain, std::span<const double>) const override {
    return formulas_.energy(as_array(strain));
  }

  double transverse_stretch(std::span<const double, n> strain) const override {
    return formulas_.transverse_stretch(as_array(strain));
  }

 private:
  static std::array<double, n> as_array(std::span<const double, n> strain) {
    std::array<double, n> values;
    for (int k = 0; k < n; ++k) values[k] = strain[k];
    return values;
  }

  Formulas formulas_;
};

template <class Formulas>
std::unique_ptr<Law<PointKind::solid>> make_solid_law(const Formulas& formulas) {
  return std::make_unique<SolidLawOf<Formulas>>(formulas);
}
template <class Formulas>
std::unique_ptr<Law<PointKind::plane>> make_plane_law(const Formulas& formulas) {
  return std::make_unique<ThinLawOf<PointKind::plane, Formulas>>(formulas);
}
template <class Formulas>
std::unique_ptr<Law<PointKind::line>> make_line_law(const Formulas& formulas) {
  return std::make_unique<ThinLawOf<PointKind::line, Formulas>>(formulas);
}

}  // namespace balocco
