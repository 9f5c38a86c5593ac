// *ELASTIC, TYPE=ENGINEERING CONSTANTS or ORTHOTROPIC: S = D : E in the section's material directions.
#pragma once

#include <array>

#include "materials/directional_elastic.hpp"

namespace balocco {

struct OrthotropicElastic : DirectionalElastic<OrthotropicElastic> {
  std::array<double, 9> normal;  // D1111 D1122 D1133, D1122 D2222 D2233, D1133 D2233 D3333
  double shear12, shear13, shear23;
  double lambda, mu;  // D <= lambda I x I + 2 mu Id

  /// Sets `lambda` and `mu`. @throws InputError if the stiffness is not positive definite; `keyword` names the culprit.
  static OrthotropicElastic from_stiffness(const std::array<double, 9>& normal, const std::array<double, 3>& shear,
                                           const char* keyword);

  template <class T>
  Matrix3<T> second_piola(const Matrix3<T>& strain) const {
    Matrix3<T> s;
    for (int i = 0; i < 3; ++i)
      s(i, i) = normal[3 * i] * strain(0, 0) + normal[3 * i + 1] * strain(1, 1) + normal[3 * i + 2] * strain(2, 2);
    s(0, 1) = s(1, 0) = (2.0 * shear12) * strain(0, 1);
    s(0, 2) = s(2, 0) = (2.0 * shear13) * strain(0, 2);
    s(1, 2) = s(2, 1) = (2.0 * shear23) * strain(1, 2);
    return s;
  }
};

}  // namespace balocco
