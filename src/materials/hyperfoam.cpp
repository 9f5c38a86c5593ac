#include "materials/hyperfoam.hpp"

#include <fmt/format.h>

#include <cmath>

#include "math/dense.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"

namespace balocco {

double Hyperfoam::value(double strain, const void* law) {
  double sum = 0.0;
  for (const Term& term : static_cast<const Hyperfoam*>(law)->terms)
    sum += 2.0 * term.modulus / term.exponent * std::expm1(0.5 * term.exponent * std::log1p(2.0 * strain));
  return sum;
}

double Hyperfoam::slope(double strain, const void* law) {
  double sum = 0.0;
  for (const Term& term : static_cast<const Hyperfoam*>(law)->terms)
    sum += 2.0 * term.modulus * std::pow(1.0 + 2.0 * strain, 0.5 * term.exponent - 1.0);
  return sum;
}

double Hyperfoam::energy(const Matrix3<double>& f) const {
  auto stretch = singular_values(f);
  for (double& value : stretch.component) value = std::log(value);
  const double volume = stretch[0] + stretch[1] + stretch[2];
  double sum = 0.0;
  for (const Term& term : terms) {
    const double factor = 2.0 * term.modulus / (term.exponent * term.exponent), rate = -term.exponent * term.beta;
    for (int i = 0; i < 3; ++i) sum += factor * std::expm1(term.exponent * stretch[i]);
    sum += factor * (rate == 0.0 ? -term.exponent * volume : std::expm1(rate * volume) / term.beta);
  }
  return sum;
}

namespace {

Hyperfoam foam(const Material& material) {
  const int order = find_material_law(material.law)->order;
  Hyperfoam law;
  double shear = 0.0;
  for (int i = 0; i < order; ++i) {
    const double poisson = parameter(material.parameters, 2 * order + i);
    law.terms.push_back({material.parameters[2 * i], material.parameters[2 * i + 1], poisson / (1.0 - 2.0 * poisson)});
    shear += law.terms.back().modulus;
    if (law.terms.back().exponent == 0.0)
      throw InputError(fmt::format("*HYPERFOAM: alpha{} is zero; give another exponent", i + 1));
  }
  if (!(shear > 0.0))
    throw InputError("*HYPERFOAM: the moduli mu add up to zero or less; their sum is the shear modulus");
  return law;
}

std::unique_ptr<Law<PointKind::solid>> form(const Material& material) {
  return make_solid_law(foam(material));
}

MaterialLaw entry(int order) {
  std::vector<ParameterSpec> parameters;
  for (int i = 1; i <= order; ++i) {
    parameters.push_back({fmt::format("mu{}", i), -unbounded, unbounded, "modulus, force/area"});
    parameters.push_back({fmt::format("alpha{}", i), -unbounded, unbounded, "exponent"});
  }
  for (int i = 1; i <= order; ++i) parameters.push_back({fmt::format("nu{}", i), -1.0, 0.5, "Poisson's ratio"});
  return {.name = fmt::format("hyperfoam-{}", order),
          .keyword = "HYPERFOAM",
          .variant = "",
          .order = order,
          .parameters = parameters,
          .options = {},
          .solid = form};
}

const RegisterLaw one(entry(1)), two(entry(2)), three(entry(3));

}  // namespace

}  // namespace balocco
