#include "materials/isotropic_elastic.hpp"

#include "materials/elastic_by_temperature.hpp"
#include "materials/j2_plasticity.hpp"
#include "materials/plane_elastic.hpp"
#include "materials/relaxing_rubber.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

PlaneElastic plane_form(std::span<const double> p) {
  return PlaneElastic::from_constants({p[0], p[0], p[1], p[0] / (2.0 * (1.0 + p[1])), p[1]});
}

/// The elastic forms are written by hand; with *PLASTIC the thin ones are condensed from the solid. With *VISCOELASTIC the law is
/// neo-Hookean, of the same constants at small strain: St. Venant-Kirchhoff has no isochoric energy whose stress could relax (viscoelastic.hpp).
template <PointKind kind>
std::unique_ptr<Law<kind>> form(const Material& m) {
  const double young = m.parameters[0], poisson = m.parameters[1];
  if (ElasticTable::is_in(m)) {
    if (!m.options.empty()) throw InputError("*ELASTIC by temperature goes with no other option of the material; give one line, or take the option out");
    if constexpr (kind == PointKind::solid) return make_solid_law(ElasticByTemperature(ElasticTable(m.parameters)));
  }
  if (J2Plasticity::wanted(m)) {
    if (relaxes(m)) throw InputError("*VISCOELASTIC: it does not go together with *PLASTIC; remove one of them");
    return make_metal<kind>(m);
  }
  const IsotropicElastic solid = IsotropicElastic::from_young(young, poisson);
  if (relaxes(m)) return relaxing_rubber<kind>(m, {0.5 * solid.mu, 0.0, young / (3.0 * (1.0 - 2.0 * poisson))});
  if constexpr (kind == PointKind::solid) return make_solid_law(solid);
  if constexpr (kind == PointKind::plane) return make_plane_law(plane_form(m.parameters));
  if constexpr (kind == PointKind::line) return make_line_law(LineElastic{young, poisson});
  if constexpr (kind == PointKind::fibre) return make_fibre_law(FibreElastic{young, poisson, solid.mu});
}

const RegisterLaw registered(
    {.name = "elastic",
     .keyword = "ELASTIC",
     .variant = "",
     .parameters = {{"young", 0.0, unbounded, "Young's modulus, force/area"},
                    {"poisson", -1.0, 0.5, "Poisson's ratio"}},
     .options = {"plastic", "plastic-kinematic", "plastic-combined", "plastic-johnson-cook", "cyclic-hardening",
                 "rate-power-law", "rate-johnson-cook", "shear-failure", "prony"},
     .solid = form<PointKind::solid>,
     .plane = form<PointKind::plane>,
     .line = form<PointKind::line>,
     .fibre = form<PointKind::fibre>,
     .lamina_stiffness = [](std::span<const double> p, std::span<double, 9> q) { plane_form(p).copy_to(q); }});

}  // namespace

}  // namespace balocco
