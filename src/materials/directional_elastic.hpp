// What elastic laws share whose second Piola-Kirchhoff stress is linear in the Green-Lagrange strain, S = D : E, by the material's own
// directions.
#pragma once

#include "materials/isotropic_elastic.hpp"

namespace balocco {

/// `Law` has second_piola(strain), and `lambda` and `mu` with D <= lambda I x I + 2 mu Id.
template <class Law>
struct DirectionalElastic {
  static constexpr bool compiled_whole = true;  // law_of.hpp

  template <class T>
  Matrix3<T> stress(const Matrix3<T>& deformation_gradient) const {
    return deformation_gradient * law().second_piola(green_lagrange_strain(deformation_gradient));
  }

  template <class T>
  TangentBound<T> bound(const Matrix3<T>& deformation_gradient) const {
    const Matrix3<T> s = law().second_piola(green_lagrange_strain(deformation_gradient));
    T largest = T(0.0);  // Gershgorin
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      largest = maximum(largest, s(i, i) + absolute(s(i, j)) + absolute(s(i, k)));
    }
    return quadratic_energy_bound(invariants(deformation_gradient), law().lambda, law().mu, largest);
  }

  template <class T>
  T energy(const Matrix3<T>& deformation_gradient) const {
    const Matrix3<T> strain = green_lagrange_strain(deformation_gradient);
    return 0.5 * double_contraction(law().second_piola(strain), strain);
  }

 private:
  const Law& law() const { return static_cast<const Law&>(*this); }
};

}  // namespace balocco
