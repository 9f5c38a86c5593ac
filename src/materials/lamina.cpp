// *ELASTIC, TYPE=LAMINA: an orthotropic ply in plane stress. Plane form only. G13 and G23 govern transverse shear in shells;
// membranes have none.
#include "materials/plane_elastic.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

using Parameters = std::span<const double>;

PlaneElastic plane_form(Parameters p) {
  const PlaneConstants constants{p[0], p[1], p[2], p[3]};
  if (!constants.stable())
    throw InputError(
        "*ELASTIC, TYPE=LAMINA: |nu12| >= sqrt(E1/E2) makes the stiffness indefinite; give the major Poisson's ratio");
  return PlaneElastic::from_constants(constants);
}

const RegisterLaw registered(
    {.name = "lamina",
     .keyword = "ELASTIC",
     .variant = "LAMINA",
     .parameters = {{"E1", 0.0, unbounded, "Young's modulus along the fibres, force/area"},
                    {"E2", 0.0, unbounded, "Young's modulus across the fibres, force/area"},
                    {"nu12", -unbounded, unbounded, "major Poisson's ratio: strain 2 by stress 1"},
                    {"G12", 0.0, unbounded, "in-plane shear modulus, force/area"},
                    {"G13", from_zero, unbounded, "transverse shear modulus, force/area"},
                    {"G23", from_zero, unbounded, "transverse shear modulus, force/area"}},
     .plane = [](const Material& m) { return make_plane_law(plane_form(m.parameters)); },
     .lamina_stiffness = [](Parameters p, std::span<double, 9> q) { plane_form(p).copy_to(q); },
     .transverse_shear = [](Parameters p) { return std::array{p[4], p[5]}; }});

}  // namespace

}  // namespace balocco
