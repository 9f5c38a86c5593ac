// Stiffness-proportional Rayleigh damping of a one-point brick: viscous stress beta * (initial stiffness : strain
// rate), also in the hourglass modes. Only groups whose material has beta > 0 pay for it.
#pragma once

#include "elements/solids/reduced_brick_kernel.hpp"
#include "elements/solids/solid_damping.hpp"
#include "elements/solids/solid_reference.hpp"

namespace balocco {

template <class T>
struct BrickMotion {
  const HexahedronCoefficients<T>& coefficients;
  const Matrix3<T>& deformation_gradient;
  const std::array<Vector3<T>, 4>& hourglass;
};

/// HOURGLASS=STIFFNESS: forces k q_a.
template <class T, class Reference>
std::array<Vector3<T>, 4> scalar_hourglass_forces(const std::array<Vector3<T>, 4>& q, const Reference& reference) {
  std::array<Vector3<T>, 4> force;
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i) force[a][i] = q[a][i] * reference[brick_record::stiffness];
  return force;
}

/// Conjugates of the coefficients with elastic and viscous stresses; adds what the viscous ones dissipate over the
/// increment. `stress` is V P without damping, `c_rate` the coefficients of the nodal velocities.
template <bool enhanced, class T, class Reference>
HexahedronCoefficients<T> damped_conjugates(const BrickMotion<T>& motion, const HexahedronCoefficients<T>& c_rate,
                                            Matrix3<T> stress, const SolidMaterial& material,
                                            const Reference& reference, double increment, T& dissipation) {
  const double beta = material.damping_beta;
  const T weight = beta * reference[brick_record::volume];
  const Matrix3<T> f_rate = mean_deformation_gradient(c_rate, reference);
  T power;
  const Matrix3<T> viscous =
      motion.deformation_gradient * rate_stress(material.stiffness, motion.deformation_gradient, f_rate, power);
  for (int k = 0; k < 9; ++k) stress.component[k] = stress.component[k] + weight * viscous.component[k];
  power = weight * power;

  const std::array<Vector3<T>, 4>& q = motion.hourglass;
  const std::array<Vector3<T>, 4> q_rate = hourglass_vectors(c_rate, f_rate, reference);
  HexahedronCoefficients<T> result;
  if constexpr (enhanced) {
    std::array<T, 12> strain = hourglass_strains(motion.coefficients, q), rate = hourglass_strains(c_rate, q);
    const std::array<T, 12> rate_of_q = hourglass_strains(motion.coefficients, q_rate);
    for (int k = 0; k < 12; ++k) rate[k] = beta * (rate[k] + rate_of_q[k]);
    const std::array<T, 12> viscous_stress = hourglass_stresses(rate, reference);
    std::array<T, 12> total = hourglass_stresses(strain, reference);
    for (int k = 0; k < 12; ++k) {
      total[k] = total[k] + viscous_stress[k];
      power = power + viscous_stress[k] * ((1.0 / beta) * rate[k]);
    }
    result = conjugates_with_stresses(motion.coefficients, q, total, stress, reference);
  } else {
    std::array<Vector3<T>, 4> force = scalar_hourglass_forces(q, reference);
    const std::array<Vector3<T>, 4> viscous_force = scalar_hourglass_forces(q_rate, reference);
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) force[a][i] = force[a][i] + beta * viscous_force[a][i];
      power = power + beta * dot(viscous_force[a], q_rate[a]);
    }
    result = conjugates_with_scalar(force, stress, reference);
  }
  dissipation = dissipation + increment * power;
  return result;
}

}  // namespace balocco
