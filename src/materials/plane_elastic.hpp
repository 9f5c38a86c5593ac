// Linear elasticity in plane stress and in a line: what membranes, trusses and lamination theory see of every *ELASTIC.
#pragma once

#include <array>
#include <cmath>

#include "materials/law_of.hpp"

namespace balocco {

/// In-plane engineering constants of a ply in its material directions.
struct PlaneConstants {
  double young1, young2, poisson12, shear12;
  double poisson_out = 0.0;  // thickness strain = -poisson_out (S11 / young1 + S22 / young2), 0: thickness is kept

  /// A stiffness is positive definite only while |nu12| < sqrt(E1 / E2).
  bool stable() const { return poisson12 * poisson12 < young1 / young2; }
};

/// S = Q E in plane stress.
struct PlaneElastic {
  double q11, q12, q22, q33;
  double largest;       // half the largest eigenvalue of Q, E12 counted twice
  double thickness[2];  // thickness strain per E11, E22

  static PlaneElastic from_constants(const PlaneConstants& c) {
    const double reduced = 1.0 - c.poisson12 * c.poisson12 * c.young2 / c.young1;
    PlaneElastic p{c.young1 / reduced, c.poisson12 * c.young2 / reduced, c.young2 / reduced, c.shear12, 0.0, {}};
    const double mean = 0.5 * (p.q11 + p.q22), half_difference = 0.5 * (p.q11 - p.q22);
    p.largest = 0.5 * std::fmax(mean + std::hypot(half_difference, p.q12), 2.0 * p.q33);
    p.thickness[0] = -c.poisson_out * (p.q11 / c.young1 + p.q12 / c.young2);
    p.thickness[1] = -c.poisson_out * (p.q12 / c.young1 + p.q22 / c.young2);
    return p;
  }

  template <class T>
  const std::array<T, 3>& prepare(const std::array<T, 3>& strain) const {
    return strain;
  }
  template <class T>
  std::array<T, 3> stress(const std::array<T, 3>& strain) const {
    return {q11 * strain[0] + q12 * strain[1], q12 * strain[0] + q22 * strain[1], q33 * strain[2]};
  }
  template <class T>
  T bound(const std::array<T, 3>&) const {
    return T(largest);
  }
  double energy(const std::array<double, 3>& strain) const {
    const auto s = stress(strain);
    return 0.5 * (s[0] * strain[0] + s[1] * strain[1] + s[2] * strain[2]);
  }
  double transverse_stretch(const std::array<double, 3>& strain) const {
    return std::sqrt(std::fmax(1.0 + 2.0 * (thickness[0] * strain[0] + thickness[1] * strain[1]), 0.0));
  }

  void copy_to(std::span<double, 9> q) const {
    const double values[9] = {q11, q12, 0.0, q12, q22, 0.0, 0.0, 0.0, q33};
    for (int i = 0; i < 9; ++i) q[i] = values[i];
  }
};

/// S = young * E.
struct LineElastic {
  double young, poisson;

  template <class T>
  const std::array<T, 1>& prepare(const std::array<T, 1>& strain) const {
    return strain;
  }
  template <class T>
  std::array<T, 1> stress(const std::array<T, 1>& strain) const {
    return {young * strain[0]};
  }
  template <class T>
  T bound(const std::array<T, 1>&) const {
    return T(0.5 * young);
  }
  double energy(const std::array<double, 1>& strain) const { return 0.5 * young * strain[0] * strain[0]; }
  double transverse_stretch(const std::array<double, 1>& strain) const {  // of the area: both transverse strains
    return std::fmax(1.0 - 2.0 * poisson * strain[0], 0.0);
  }
};

/// S11 = young * E11, S12 = shear * 2E12: a point of a beam's section.
struct FibreElastic {
  double young, poisson, shear;

  template <class T>
  const std::array<T, 2>& prepare(const std::array<T, 2>& strain) const {
    return strain;
  }
  template <class T>
  std::array<T, 2> stress(const std::array<T, 2>& strain) const {
    return {young * strain[0], shear * strain[1]};
  }
  template <class T>
  T bound(const std::array<T, 2>&) const {
    return T(std::fmax(0.5 * young, shear));
  }
  double energy(const std::array<double, 2>& strain) const {
    return 0.5 * (young * strain[0] * strain[0] + shear * strain[1] * strain[1]);
  }
  double transverse_stretch(const std::array<double, 2>& strain) const {
    return std::fmax(1.0 - 2.0 * poisson * strain[0], 0.0);
  }
};

}  // namespace balocco
