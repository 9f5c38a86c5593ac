#include "materials/neo_hooke.hpp"

#include "materials/condensation.hpp"
#include "materials/relaxing_rubber.hpp"
#include "materials/rubber_plane_stress.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

using Parameters = std::span<const double>;

RubberConstants constants(Parameters p) {
  return {p[0], 0.0, bulk_modulus(parameter(p, 1), 2.0 * p[0])};
}

template <PointKind kind>
std::unique_ptr<Law<kind>> form(const Material& m) {
  const RubberConstants c = constants(m.parameters);
  if (relaxes(m)) return relaxing_rubber<kind>(m, c);
  if constexpr (kind == PointKind::solid) return make_solid_law(NeoHooke{c.c10, c.bulk});
  if constexpr (kind == PointKind::plane) return make_plane_law(RubberPlane{c});
  if constexpr (kind == PointKind::line) return make_line_law(RubberLine{c});
  if constexpr (kind == PointKind::fibre) return make_condensed_law<kind>(NeoHooke{c.c10, c.bulk});
}

const RegisterLaw registered(
    {.name = "neo-hooke",
     .keyword = "HYPERELASTIC",
     .variant = "NEO HOOKE",
     .parameters = {{"C10", 0.0, unbounded, "half the initial shear modulus, force/area"},
                    {"D1", from_zero, unbounded, "2 / bulk modulus, area/force; 0: bulk modulus = 20 x shear modulus"}},
     .options = {"prony"},
     .solid = form<PointKind::solid>,
     .plane = form<PointKind::plane>,
     .line = form<PointKind::line>,
     .fibre = form<PointKind::fibre>});

}  // namespace

}  // namespace balocco
