#include "materials/ogden.hpp"

#include <fmt/format.h>

#include <cmath>

#include "materials/viscoelastic.hpp"
#include "math/dense.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"

namespace balocco {

double Ogden::value(double strain, const void* law) {
  double sum = 0.0;
  for (const Term& term : static_cast<const Ogden*>(law)->terms)
    sum += 2.0 * term.modulus / term.exponent * std::expm1(0.5 * term.exponent * std::log1p(2.0 * strain));
  return sum;
}

double Ogden::slope(double strain, const void* law) {
  double sum = 0.0;
  for (const Term& term : static_cast<const Ogden*>(law)->terms)
    sum += 2.0 * term.modulus * std::pow(1.0 + 2.0 * strain, 0.5 * term.exponent - 1.0);
  return sum;
}

double Ogden::energy(const Matrix3<double>& f) const {
  const double jacobian = determinant(f, cofactor(f)), change = jacobian - 1.0;
  auto stretch = singular_values(f);
  for (double& value : stretch.component) value = std::log(value / std::cbrt(jacobian));
  double sum = 0.0, volume = 1.0;
  for (const Term& term : terms) {
    for (int i = 0; i < 3; ++i)
      sum += 2.0 * term.modulus / (term.exponent * term.exponent) * std::expm1(term.exponent * stretch[i]);
    volume *= change * change;
    sum += term.bulk * volume;
  }
  return sum;
}

namespace {

Ogden rubber(const Material& material) {
  const int order = find_material_law(material.law)->order;
  Ogden law;
  for (int i = 0; i < order; ++i) {
    const double d = parameter(material.parameters, 2 * order + i);
    law.terms.push_back({material.parameters[2 * i], material.parameters[2 * i + 1], d > 0.0 ? 1.0 / d : 0.0});
    if (law.terms.back().exponent == 0.0)
      throw InputError(fmt::format("*HYPERELASTIC, OGDEN: alpha{} is zero; give another exponent", i + 1));
  }
  if (!(law.shear_modulus() > 0.0))
    throw InputError("*HYPERELASTIC, OGDEN: the moduli mu add up to zero or less; their sum is the shear modulus");
  if (law.terms[0].bulk == 0.0) law.terms[0].bulk = 10.0 * law.shear_modulus();  // bulk modulus 20 x shear modulus
  return law;
}

template <PointKind kind>
std::unique_ptr<Law<kind>> form(const Material& m) {
  const Ogden law = rubber(m);
  if (!relaxes(m)) return make_form<kind>(law);
  return make_form<kind>(Viscoelastic<Ogden>::of(m, law, m.instantaneous));
}

MaterialLaw entry(int order) {
  std::vector<ParameterSpec> parameters;
  for (int i = 1; i <= order; ++i) {
    parameters.push_back({fmt::format("mu{}", i), -unbounded, unbounded, "modulus, force/area"});
    parameters.push_back({fmt::format("alpha{}", i), -unbounded, unbounded, "exponent"});
  }
  parameters.push_back({"D1", from_zero, unbounded, "2 / bulk modulus, area/force; 0: bulk modulus = 20 x shear modulus"});
  for (int i = 2; i <= order; ++i)
    parameters.push_back({fmt::format("D{}", i), from_zero, unbounded, "compressibility, area/force; 0: no such term"});
  return {.name = fmt::format("ogden-{}", order),
          .keyword = "HYPERELASTIC",
          .variant = "OGDEN",
          .order = order,
          .parameters = parameters,
          .options = {"prony"},
          .solid = form<PointKind::solid>,
          .plane = form<PointKind::plane>,
          .line = form<PointKind::line>,
          .fibre = form<PointKind::fibre>};
}

const RegisterLaw one(entry(1)), two(entry(2)), three(entry(3));

}  // namespace

}  // namespace balocco
