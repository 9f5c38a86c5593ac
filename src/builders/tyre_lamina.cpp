#include "builders/tyre_lamina.hpp"

#include <cmath>

namespace balocco {
namespace {

constexpr double rubber_poisson = 0.49;

/// Halpin and Tsai: modulus across the fibres for a ratio fibre / matrix and a geometry factor.
double halpin_tsai(double matrix, double fibre, double fraction, double factor) {
  const double eta = (fibre / matrix - 1.0) / (fibre / matrix + factor);
  return matrix * (1.0 + factor * eta * fraction) / (1.0 - eta * fraction);
}

/// Reduced stiffness at `angle` from the direction of interest: Q11 cos^4 + 2 (Q12 + 2 Q66) cos^2 sin^2 + Q22 sin^4.
double turned_stiffness(const Lamina& lamina, double angle) {
  const double poisson_21 = lamina.poisson_12 * lamina.modulus_2 / lamina.modulus_1;
  const double scale = 1.0 / (1.0 - lamina.poisson_12 * poisson_21);
  const double q11 = scale * lamina.modulus_1, q22 = scale * lamina.modulus_2,
               q12 = scale * poisson_21 * lamina.modulus_1;
  const double c2 = std::pow(std::cos(angle), 2), s2 = std::pow(std::sin(angle), 2);
  return q11 * c2 * c2 + 2.0 * (q12 + 2.0 * lamina.shear_12) * c2 * s2 + q22 * s2 * s2;
}

}  // namespace

Lamina make_lamina(const PlySpec& ply, const TyreSpec& spec) {
  const auto& rubber = spec.rubbers[ply.rubber];
  const double shear = rubber.shear_modulus();
  const double modulus = 2.0 * shear * (1.0 + rubber_poisson);
  if (ply.cord < 0) return {modulus, modulus, rubber_poisson, shear, shear, rubber.density, 0.0};
  const auto& cord = spec.cords[ply.cord];
  const double fraction = ply.cord_area / (ply.spacing * ply.thickness);
  const double cord_shear = cord.modulus / (2.0 * (1.0 + cord.poisson));
  Lamina lamina;
  lamina.modulus_1 = fraction * cord.modulus + (1.0 - fraction) * modulus;
  lamina.modulus_2 = halpin_tsai(modulus, cord.modulus, fraction, 2.0);
  lamina.poisson_12 = fraction * cord.poisson + (1.0 - fraction) * rubber_poisson;
  lamina.shear_12 = halpin_tsai(shear, cord_shear, fraction, 1.0);
  lamina.shear_23 = shear;
  lamina.density = fraction * cord.density + (1.0 - fraction) * rubber.density;
  lamina.cord_fraction = fraction;
  return lamina;
}

PlySpec ply_at(PlySpec ply, double radius_ratio) {
  if (ply.gathers) ply.spacing *= radius_ratio;
  return ply;
}

LaminateStiffness laminate_stiffness(const std::vector<int>& plies, const TyreSpec& spec, double radius_ratio) {
  LaminateStiffness sum;
  for (const int row : plies) {
    const auto ply = ply_at(spec.plies[row], radius_ratio);
    const auto lamina = make_lamina(ply, spec);
    sum.circumferential += ply.thickness * turned_stiffness(lamina, ply.angle);
    sum.meridional += ply.thickness * turned_stiffness(lamina, ply.angle - std::acos(0.0));
  }
  return sum;
}

}  // namespace balocco
