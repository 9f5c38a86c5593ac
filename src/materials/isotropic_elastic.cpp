#include "materials/isotropic_elastic.hpp"

#include "materials/plane_elastic.hpp"

namespace balocco {

namespace {

using Parameters = std::span<const double>;

PlaneElastic plane_form(Parameters p) {
  return PlaneElastic::from_constants({p[0], p[0], p[1], p[0] / (2.0 * (1.0 + p[1])), p[1]});
}

const RegisterLaw registered(
    {.name = "elastic",
     .keyword = "ELASTIC",
     .variant = "",
     .parameters = {{"young", 0.0, unbounded, "Young's modulus, force/area"},
                    {"poisson", -1.0, 0.5, "Poisson's ratio"}},
     .solid = [](Parameters p) { return make_solid_law(IsotropicElastic::from_young(p[0], p[1])); },
     .plane = [](Parameters p) { return make_plane_law(plane_form(p)); },
     .line =
         [](Parameters p) {
           return make_line_law(LineElastic{p[0], p[1]});
         },
     .lamina_stiffness = [](Parameters p, std::span<double, 9> q) { plane_form(p).copy_to(q); }});

}  // namespace

}  // namespace balocco
