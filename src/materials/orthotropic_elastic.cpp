#include "materials/orthotropic_elastic.hpp"

#include <algorithm>
#include <string>

#include "materials/plane_elastic.hpp"
#include "math/dense.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"

namespace balocco {

OrthotropicElastic OrthotropicElastic::from_stiffness(const std::array<double, 9>& normal,
                                                      const std::array<double, 3>& shear, const char* keyword) {
  if (!(symmetric_eigenvalues(normal, 3).front() > 0.0))
    throw InputError(std::string(keyword) +
                     ": the stiffness is not positive definite; check the Poisson's ratios or D1122, D1133, D2233");
  OrthotropicElastic law{{}, normal, shear[0], shear[1], shear[2], 0.0, 0.0};
  law.lambda =
      std::max(0.0, (normal[1] + normal[2] + normal[5]) / 3.0);  // any choice is safe; this one is exact if isotropic
  auto rest = normal;
  for (double& modulus : rest) modulus -= law.lambda;
  law.mu = std::max({0.5 * symmetric_eigenvalues(rest, 3).back(), shear[0], shear[1], shear[2]});
  return law;
}

namespace {

using Parameters = std::span<const double>;

/// Order of the parameters: E1 E2 E3 nu12 nu13 nu23 G12 G13 G23.
OrthotropicElastic from_engineering_constants(Parameters p) {
  const Dense<3, 3> compliance{1.0 / p[0], -p[3] / p[0], -p[4] / p[0], -p[3] / p[0], 1.0 / p[1],
                               -p[5] / p[1], -p[4] / p[0], -p[5] / p[1], 1.0 / p[2]};
  const auto stiffness = inverse(compliance);
  const auto normal = (0.5 * stiffness + 0.5 * transpose(stiffness)).component;
  return OrthotropicElastic::from_stiffness(normal, {p[6], p[7], p[8]}, "*ELASTIC, TYPE=ENGINEERING CONSTANTS");
}

/// Order of the parameters: D1111 D1122 D2222 D1133 D2233 D3333 D1212 D1313 D2323.
OrthotropicElastic from_moduli(Parameters p) {
  return OrthotropicElastic::from_stiffness({p[0], p[1], p[3], p[1], p[2], p[4], p[3], p[4], p[5]}, {p[6], p[7], p[8]},
                                            "*ELASTIC, TYPE=ORTHOTROPIC");
}

/// Plane stress in material directions 1 and 2.
PlaneElastic plane_form(const OrthotropicElastic& law) {
  const auto c = inverse(Dense<3, 3>{law.normal});
  PlaneElastic plane = PlaneElastic::from_constants({1.0 / c(0, 0), 1.0 / c(1, 1), -c(0, 1) / c(0, 0), law.shear12});
  plane.thickness[0] = c(2, 0) * plane.q11 + c(2, 1) * plane.q12;
  plane.thickness[1] = c(2, 0) * plane.q12 + c(2, 1) * plane.q22;
  return plane;
}

std::vector<ParameterSpec> engineering_parameters() {
  return {{"E1", 0.0, unbounded, "Young's modulus in direction 1, force/area"},
          {"E2", 0.0, unbounded, "Young's modulus in direction 2, force/area"},
          {"E3", 0.0, unbounded, "Young's modulus in direction 3, force/area"},
          {"nu12", -unbounded, unbounded, "Poisson's ratio: strain 2 by stress 1"},
          {"nu13", -unbounded, unbounded, "Poisson's ratio: strain 3 by stress 1"},
          {"nu23", -unbounded, unbounded, "Poisson's ratio: strain 3 by stress 2"},
          {"G12", 0.0, unbounded, "shear modulus, force/area"},
          {"G13", 0.0, unbounded, "shear modulus, force/area"},
          {"G23", 0.0, unbounded, "shear modulus, force/area"}};
}

std::vector<ParameterSpec> moduli_parameters() {
  std::vector<ParameterSpec> parameters;
  for (const char* name : {"D1111", "D1122", "D2222", "D1133", "D2233", "D3333", "D1212", "D1313", "D2323"}) {
    const bool coupling = std::string(name) == "D1122" || std::string(name) == "D1133" || std::string(name) == "D2233";
    parameters.push_back({name, coupling ? -unbounded : 0.0, unbounded, "stiffness, force/area"});
  }
  return parameters;
}

const RegisterLaw engineering_constants(
    {.name = "engineering-constants",
     .keyword = "ELASTIC",
     .variant = "ENGINEERING CONSTANTS",
     .parameters = engineering_parameters(),
     .solid = [](const Material& m) { return make_solid_law(from_engineering_constants(m.parameters)); },
     .plane = [](const Material& m) { return make_plane_law(plane_form(from_engineering_constants(m.parameters))); },
     .lamina_stiffness = [](Parameters p,
                            std::span<double, 9> q) { plane_form(from_engineering_constants(p)).copy_to(q); },
     .transverse_shear = [](Parameters p) { return std::array{p[7], p[8]}; }});

const RegisterLaw orthotropic(
    {.name = "orthotropic",
     .keyword = "ELASTIC",
     .variant = "ORTHOTROPIC",
     .parameters = moduli_parameters(),
     .solid = [](const Material& m) { return make_solid_law(from_moduli(m.parameters)); },
     .plane = [](const Material& m) { return make_plane_law(plane_form(from_moduli(m.parameters))); },
     .lamina_stiffness = [](Parameters p, std::span<double, 9> q) { plane_form(from_moduli(p)).copy_to(q); },
     .transverse_shear = [](Parameters p) { return std::array{p[7], p[8]}; }});

}  // namespace

}  // namespace balocco
