#include "materials/anisotropic_elastic.hpp"

#include <algorithm>
#include <numbers>
#include <string>

#include "math/dense.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"

namespace balocco {

AnisotropicElastic AnisotropicElastic::from_moduli(std::span<const double> triangle) {
  AnisotropicElastic law{};
  std::array<double, 36> orthonormal{};  // over E11 E22 E33 and sqrt(2) E12 E13 E23, in which |E| is the length
  for (int column = 0, next = 0; column < 6; ++column)
    for (int row = 0; row <= column; ++row, ++next) {
      const double value = parameter(triangle, static_cast<std::size_t>(next));
      const double scale = (row < 3 ? 1.0 : std::numbers::sqrt2) * (column < 3 ? 1.0 : std::numbers::sqrt2);
      law.moduli[6 * row + column] = law.moduli[6 * column + row] = value;
      orthonormal[6 * row + column] = orthonormal[6 * column + row] = scale * value;
    }
  if (!(symmetric_eigenvalues(orthonormal, 6).front() > 0.0))
    throw InputError("*ELASTIC, TYPE=ANISOTROPIC: the stiffness is not positive definite; check the order of the moduli");
  law.lambda = std::max(0.0, (law.moduli[1] + law.moduli[2] + law.moduli[8]) / 3.0);  // any choice is safe; exact if isotropic
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) orthonormal[6 * row + column] -= law.lambda;
  law.mu = 0.5 * symmetric_eigenvalues(orthonormal, 6).back();
  return law;
}

namespace {

std::vector<ParameterSpec> moduli_parameters() {
  constexpr std::array pairs{"11", "22", "33", "12", "13", "23"};
  std::vector<ParameterSpec> parameters;
  for (std::size_t column = 0; column < pairs.size(); ++column)
    for (std::size_t row = 0; row <= column; ++row)
      parameters.push_back(
          {std::string("D") + pairs[row] + pairs[column], row == column ? 0.0 : -unbounded, unbounded, "stiffness, force/area"});
  return parameters;
}

const RegisterLaw anisotropic({.name = "anisotropic",
                               .keyword = "ELASTIC",
                               .variant = "ANISOTROPIC",
                               .parameters = moduli_parameters(),
                               .solid = [](const Material& m) {
                                 return make_solid_law(AnisotropicElastic::from_moduli(m.parameters));
                               }});

}  // namespace

}  // namespace balocco
