#include "materials/polynomial_rubber.hpp"

#include <fmt/format.h>

#include "materials/relaxing_rubber.hpp"
#include "materials/viscoelastic.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

using Term = std::array<int, 2>;  // i, j of C_ij

/// Where the parameters of a law go: coefficients first, then one D per order.
struct Arrangement {
  std::vector<Term> terms;
  int orders = 1;
};

Arrangement reduced(int order) {
  Arrangement a{{}, order};
  for (int i = 1; i <= order; ++i) a.terms.push_back({i, 0});
  return a;
}
Arrangement complete(int order) {
  Arrangement a{{}, order};
  for (int n = 1; n <= order; ++n)
    for (int j = 0; j <= n; ++j) a.terms.push_back({n - j, j});
  return a;
}

Arrangement arrangement_of(const Material& material) {
  if (material.law == "yeoh") return reduced(3);
  const int order = find_material_law(material.law)->order;
  return material.law.starts_with("reduced") ? reduced(order) : complete(order);
}

PolynomialRubber rubber(const Material& material) {
  const Arrangement a = arrangement_of(material);
  PolynomialRubber law;
  for (std::size_t k = 0; k < a.terms.size(); ++k)
    law.coefficient[a.terms[k][0]][a.terms[k][1]] = parameter(material.parameters, k);
  for (int k = 0; k < a.orders; ++k) {
    const double d = parameter(material.parameters, a.terms.size() + k);
    if (d > 0.0) law.bulk[k] = 1.0 / d;
  }
  if (law.bulk[0] == 0.0) law.bulk[0] = 10.0 * law.shear_modulus();  // bulk modulus 20 x shear modulus
  return law;
}

std::vector<ParameterSpec> parameters(const Arrangement& a) {
  std::vector<ParameterSpec> specs;
  for (const auto& [i, j] : a.terms) {
    const bool leads = i == 1 && j == 0;
    specs.push_back({fmt::format("C{}{}", i, j), leads ? 0.0 : -unbounded, unbounded, "coefficient, force/area"});
  }
  specs.push_back({"D1", from_zero, unbounded, "2 / bulk modulus, area/force; 0: bulk modulus = 20 x shear modulus"});
  for (int k = 2; k <= a.orders; ++k)
    specs.push_back({fmt::format("D{}", k), from_zero, unbounded, "compressibility, area/force; 0: no such term"});
  return specs;
}

template <PointKind kind>
std::unique_ptr<Law<kind>> relaxing(const Material& m, const PolynomialRubber& law) {
  return make_form<kind>(Viscoelastic<PolynomialRubber>::of(m, law, m.instantaneous));
}

template <PointKind kind>
std::unique_ptr<Law<kind>> form(const Material& m) {
  const PolynomialRubber law = rubber(m);
  return relaxes(m) ? relaxing<kind>(m, law) : make_form<kind>(law);
}

MaterialLaw entry(std::string name, std::string variant, int order, const Arrangement& a) {
  return {.name = std::move(name),
          .keyword = "HYPERELASTIC",
          .variant = std::move(variant),
          .order = order,
          .parameters = parameters(a),
          .options = {"prony"},
          .solid = form<PointKind::solid>,
          .plane = form<PointKind::plane>,
          .line = form<PointKind::line>,
          .fibre = form<PointKind::fibre>};
}

const RegisterLaw yeoh(entry("yeoh", "YEOH", 0, reduced(3)));
const RegisterLaw reduced_1(entry("reduced-polynomial-1", "REDUCED POLYNOMIAL", 1, reduced(1)));
const RegisterLaw reduced_2(entry("reduced-polynomial-2", "REDUCED POLYNOMIAL", 2, reduced(2)));
const RegisterLaw reduced_3(entry("reduced-polynomial-3", "REDUCED POLYNOMIAL", 3, reduced(3)));
const RegisterLaw polynomial_1(entry("polynomial-1", "POLYNOMIAL", 1, complete(1)));
const RegisterLaw polynomial_2(entry("polynomial-2", "POLYNOMIAL", 2, complete(2)));

}  // namespace

template <PointKind kind>
std::unique_ptr<Law<kind>> relaxing_rubber(const Material& material, const RubberConstants& c) {
  return relaxing<kind>(material, PolynomialRubber::mooney_rivlin(c.c10, c.c01, c.bulk));
}
template std::unique_ptr<Law<PointKind::solid>> relaxing_rubber(const Material&, const RubberConstants&);
template std::unique_ptr<Law<PointKind::plane>> relaxing_rubber(const Material&, const RubberConstants&);
template std::unique_ptr<Law<PointKind::line>> relaxing_rubber(const Material&, const RubberConstants&);
template std::unique_ptr<Law<PointKind::fibre>> relaxing_rubber(const Material&, const RubberConstants&);

}  // namespace balocco
