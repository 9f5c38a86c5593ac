#include "materials/mooney_rivlin.hpp"

#include "materials/plane_elastic.hpp"
#include "materials/rubber_plane_stress.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

using Parameters = std::span<const double>;

RubberConstants constants(Parameters p) {
  return {p[0], p[1], bulk_modulus(parameter(p, 2), 2.0 * (p[0] + p[1]))};
}

MooneyRivlin solid_form(Parameters p) {
  const RubberConstants c = constants(p);
  return {c.c10, c.c01, c.bulk};
}

const RegisterLaw registered(
    {.name = "mooney-rivlin",
     .keyword = "HYPERELASTIC",
     .variant = "MOONEY-RIVLIN",
     .parameters = {{"C10", 0.0, unbounded, "first coefficient, force/area; initial shear modulus is 2 (C10 + C01)"},
                    {"C01", from_zero, unbounded, "second coefficient, force/area"},
                    {"D1", from_zero, unbounded, "2 / bulk modulus, area/force; 0: bulk modulus = 20 x shear modulus"}},
     .solid = [](const Material& m) { return make_solid_law(solid_form(m.parameters)); },
     .plane = [](const Material& m) { return make_plane_law(RubberPlane{constants(m.parameters)}); },
     .line = [](const Material& m) { return make_line_law(RubberLine{constants(m.parameters)}); }});

}  // namespace

}  // namespace balocco
