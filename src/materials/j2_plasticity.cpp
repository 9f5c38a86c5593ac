#include "materials/j2_plasticity.hpp"

#include <fmt/format.h>

#include "materials/condensation.hpp"
#include "materials/j2_plane_stress.hpp"
#include "materials/material_option.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

std::vector<ParameterSpec> stress_and_strain() {
  return {{"yield stress", 0.0, unbounded, "true stress, force/area"},
          {"plastic strain", from_zero, unbounded, "logarithmic plastic strain; zero in the first line"}};
}

const RegisterOption isotropic({.name = "plastic",
                                .keyword = "PLASTIC",
                                .selector = "HARDENING",
                                .variant = "ISOTROPIC",
                                .is_default = true,
                                .settings = {{"RATE", from_zero, unbounded, "plastic strain rate of the table, 1/time"}},
                                .columns = stress_and_strain(),
                                .table = true,
                                .repeatable = true});
const RegisterOption kinematic({.name = "plastic-kinematic",
                                .keyword = "PLASTIC",
                                .selector = "HARDENING",
                                .variant = "KINEMATIC",
                                .columns = stress_and_strain(),
                                .table = true});
const RegisterOption combined(
    {.name = "plastic-combined",
     .keyword = "PLASTIC",
     .selector = "HARDENING",
     .variant = "COMBINED",
     .words = {{"DATA TYPE", "PARAMETERS"}},
     .settings = {{"NUMBER BACKSTRESSES", 0.5, J2Plasticity::most_back_stresses + 0.5, "number of back stresses"}},
     .columns = {{"yield stress", 0.0, unbounded, "at zero plastic strain, force/area"},
                 {"C", from_zero, unbounded, "modulus of a back stress, force/area"},
                 {"gamma", from_zero, unbounded, "how fast it saturates, at C / gamma; 0: linear"}},
     .repeated_columns = 2});
const RegisterOption johnson_cook({.name = "plastic-johnson-cook",
                                   .keyword = "PLASTIC",
                                   .selector = "HARDENING",
                                   .variant = "JOHNSON COOK",
                                   .columns = {{"A", 0.0, unbounded, "yield stress, force/area"},
                                               {"B", from_zero, unbounded, "hardening: A + B strain^n, force/area"},
                                               {"n", 0.0, unbounded, "exponent"}}});
const RegisterOption cyclic({.name = "cyclic-hardening",
                             .keyword = "CYCLIC HARDENING",
                             .words = {{"PARAMETERS", ""}},
                             .columns = {{"yield stress", 0.0, unbounded, "at zero plastic strain, force/area"},
                                         {"Q", -unbounded, unbounded, "change of the yield stress in the end, force/area"},
                                         {"b", 0.0, unbounded, "how fast: yield + Q (1 - exp(-b strain))"}}});

const RegisterOption shear_failure({.name = "shear-failure",
                                    .keyword = "SHEAR FAILURE",
                                    .selector = "ELEMENT DELETION",
                                    .variant = "YES",
                                    .is_default = true,
                                    .columns = {{"plastic strain", 0.0, unbounded, "equivalent plastic strain at failure"}}});

void add_back_stresses(const MaterialOption& option, J2Plasticity& law) {
  const auto& row = option.rows[0];
  if (option.name == "plastic-kinematic") {
    if (option.rows.size() != 2)
      throw InputError("*PLASTIC, HARDENING=KINEMATIC: give two lines, the yield stress and one later point; the slope is constant");
    if (row[1] != 0.0 || !(option.rows[1][1] > 0.0))
      throw InputError("*PLASTIC, HARDENING=KINEMATIC: plastic strain must be zero in the first line and more in the second");
    law.back_stresses.push_back({(option.rows[1][0] - row[0]) / option.rows[1][1], 0.0});
  }
  if (option.name == "plastic-combined")
    for (std::size_t i = 1; i + 1 < row.size(); i += 2) law.back_stresses.push_back({row[i], row[i + 1]});
}

}  // namespace

bool J2Plasticity::wanted(const Material& material) {
  for (const auto& option : material.options)
    if (find_material_option(option.name)->keyword == "PLASTIC") return true;
  return false;
}

J2Plasticity J2Plasticity::of(const Material& material) {
  const double young = material.parameters[0], poisson = material.parameters[1];
  J2Plasticity law{young / (3.0 * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson)), FlowStress::of(material), {}, 0.0};
  for (const auto& option : material.options) add_back_stresses(option, law);
  if (const auto* failure = find_option(material, "shear-failure"); failure != nullptr) law.failure_strain = failure->rows[0][0];
  if (const auto* cyclic = find_option(material, "cyclic-hardening"); cyclic != nullptr) {
    const auto* combined = find_option(material, "plastic-combined");
    if (combined == nullptr) throw InputError("*CYCLIC HARDENING: it belongs to *PLASTIC, HARDENING=COMBINED; add that");
    if (cyclic->rows[0][0] != combined->rows[0][0])
      throw InputError(fmt::format("*CYCLIC HARDENING: yield stress {} is not that of *PLASTIC, {}; make them equal",
                                   cyclic->rows[0][0], combined->rows[0][0]));
  }
  return law;
}

template <PointKind kind>
std::unique_ptr<Law<kind>> make_metal(const Material& material) {
  const auto law = J2Plasticity::of(material);
  if constexpr (kind == PointKind::solid) return make_solid_law(law);
  if constexpr (kind == PointKind::plane)
    if (law.back_stresses.empty()) return std::make_unique<LawOf<kind, J2PlaneStress>>(J2PlaneStress(law));
  if constexpr (kind != PointKind::solid) return make_condensed_law<kind>(law);
}
template std::unique_ptr<Law<PointKind::solid>> make_metal(const Material&);
template std::unique_ptr<Law<PointKind::plane>> make_metal(const Material&);
template std::unique_ptr<Law<PointKind::line>> make_metal(const Material&);
template std::unique_ptr<Law<PointKind::fibre>> make_metal(const Material&);

}  // namespace balocco
