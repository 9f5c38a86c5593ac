#include "materials/isotropic_elastic.hpp"

#include "materials/condensation.hpp"
#include "materials/j2_plasticity.hpp"
#include "materials/plane_elastic.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

PlaneElastic plane_form(std::span<const double> p) {
  return PlaneElastic::from_constants({p[0], p[0], p[1], p[0] / (2.0 * (1.0 + p[1])), p[1]});
}

const RegisterLaw registered(
    {.name = "elastic",
     .keyword = "ELASTIC",
     .variant = "",
     .parameters = {{"young", 0.0, unbounded, "Young's modulus, force/area"},
                    {"poisson", -1.0, 0.5, "Poisson's ratio"}},
     .options = {"plastic", "plastic-kinematic", "plastic-combined", "plastic-johnson-cook", "cyclic-hardening",
                 "rate-power-law", "rate-johnson-cook"},
     .solid =
         [](const Material& m) {
           if (J2Plasticity::wanted(m)) return make_solid_law(J2Plasticity::of(m));
           return make_solid_law(IsotropicElastic::from_young(m.parameters[0], m.parameters[1]));
         },
     .plane =
         [](const Material& m) {
           if (J2Plasticity::wanted(m)) return make_condensed_law<PointKind::plane>(J2Plasticity::of(m));
           return make_plane_law(plane_form(m.parameters));
         },
     .line =
         [](const Material& m) {
           if (J2Plasticity::wanted(m)) return make_condensed_law<PointKind::line>(J2Plasticity::of(m));
           return make_line_law(LineElastic{m.parameters[0], m.parameters[1]});
         },
     .fibre =
         [](const Material& m) {
           if (J2Plasticity::wanted(m)) return make_condensed_law<PointKind::fibre>(J2Plasticity::of(m));
           const double young = m.parameters[0], poisson = m.parameters[1];
           return make_fibre_law(FibreElastic{young, poisson, young / (2.0 * (1.0 + poisson))});
         },
     .lamina_stiffness = [](std::span<const double> p, std::span<double, 9> q) { plane_form(p).copy_to(q); }});

}  // namespace

}  // namespace balocco
