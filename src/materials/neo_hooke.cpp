#include "materials/neo_hooke.hpp"

#include "materials/plane_elastic.hpp"
#include "materials/rubber_plane_stress.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

using Parameters = std::span<const double>;

RubberConstants constants(Parameters p) {
  return {p[0], 0.0, bulk_modulus(parameter(p, 1), 2.0 * p[0])};
}

const RegisterLaw registered({.name = "neo-hooke",
                              .keyword = "HYPERELASTIC",
                              .variant = "NEO HOOKE",
                              .parameters = {{"C10", 0.0, unbounded, "half the initial shear modulus, force/area"},
                                             {"D1", from_zero, unbounded,
                                              "2 / bulk modulus, area/force; 0: bulk modulus = 20 x shear modulus"}},
                              .solid =
                                  [](const Material& m) {
                                    return make_solid_law(NeoHooke{constants(m.parameters).c10, constants(m.parameters).bulk});
                                  },
                              .plane = [](const Material& m) { return make_plane_law(RubberPlane{constants(m.parameters)}); },
                              .line = [](const Material& m) { return make_line_law(RubberLine{constants(m.parameters)}); }});

}  // namespace

}  // namespace balocco
