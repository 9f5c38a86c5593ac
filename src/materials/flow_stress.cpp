#include "materials/flow_stress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/material_option.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

const RegisterOption rate_power_law({.name = "rate-power-law",
                                     .keyword = "RATE DEPENDENT",
                                     .selector = "TYPE",
                                     .variant = "POWER LAW",
                                     .is_default = true,
                                     .columns = {{"D", 0.0, unbounded, "rate at which the yield stress doubles, 1/time"},
                                                 {"n", 1.0 - 1e-12, unbounded, "exponent: rate = D (stress/yield - 1)^n"}}});
const RegisterOption rate_johnson_cook(
    {.name = "rate-johnson-cook",
     .keyword = "RATE DEPENDENT",
     .selector = "TYPE",
     .variant = "JOHNSON COOK",
     .columns = {{"C", from_zero, unbounded, "stress = yield (1 + C ln(rate / reference rate))"},
                 {"reference rate", 0.0, unbounded, "plastic strain rate up to which the static yield stress holds, 1/time"}}});

void add_rate_option(const Material& material, FlowStress& flow) {
  const MaterialOption* power_law = find_option(material, "rate-power-law");
  const MaterialOption* johnson_cook = find_option(material, "rate-johnson-cook");
  const MaterialOption* option = power_law != nullptr ? power_law : johnson_cook;
  if (option == nullptr) return;
  if (flow.rate == FlowStress::Rate::table)
    throw InputError("*RATE DEPENDENT: *PLASTIC already gives tables by RATE; keep one of them");
  flow.rate = power_law != nullptr ? FlowStress::Rate::power_law : FlowStress::Rate::johnson_cook;
  flow.rate_parameter = option->rows[0][power_law != nullptr ? 0 : 1];
  flow.rate_exponent = option->rows[0][power_law != nullptr ? 1 : 0];
}

}  // namespace

PiecewiseCurve PiecewiseCurve::from_rows(const std::vector<std::vector<double>>& rows, double rate) {
  PiecewiseCurve curve;
  curve.rate = rate;
  curve.first = rows[0][0];
  if (rows[0][1] != 0.0)
    throw InputError(fmt::format("the first plastic strain is {}; it must be zero (the yield stress)", rows[0][1]));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double start = rows[i - 1][1], width = rows[i][1] - start;
    if (!(width > 0.0))
      throw InputError(fmt::format("plastic strain {} follows {}; the strains of a table must rise", rows[i][1], start));
    curve.pieces.push_back({start, width, (rows[i][0] - rows[i - 1][0]) / width});
  }
  return curve;
}

double FlowStress::least() const {
  double stress = static_curve(0.0).value;
  if (hardening == Hardening::table)
    for (const auto& piece : curves[0].pieces) stress = std::min(stress, static_curve(piece.start + piece.width).value);
  if (hardening == Hardening::saturation) stress = std::min(stress, yield + modulus);
  return stress;
}

FlowStress FlowStress::of(const Material& material) {
  FlowStress flow;
  for (const auto& option : material.options) {
    if (option.name == "plastic") flow.curves.push_back(PiecewiseCurve::from_rows(option.rows, option.settings[0]));
    if (option.name == "plastic-kinematic") flow.curves.push_back(PiecewiseCurve::from_rows({{option.rows[0][0], 0.0}}, 0.0));
    if (option.name == "plastic-combined") {
      flow.hardening = Hardening::saturation;
      flow.yield = option.rows[0][0];
    }
    if (option.name == "plastic-johnson-cook") {
      flow.hardening = Hardening::johnson_cook;
      flow.yield = option.rows[0][0];
      flow.modulus = option.rows[0][1];
      flow.exponent = option.rows[0][2];
    }
    if (option.name == "cyclic-hardening") {
      flow.yield = option.rows[0][0];
      flow.modulus = option.rows[0][1];
      flow.exponent = option.rows[0][2];
    }
  }
  if (flow.curves.size() > 1) flow.rate = Rate::table;
  std::ranges::sort(flow.curves, {}, &PiecewiseCurve::rate);
  if (!flow.curves.empty() && flow.curves[0].rate != 0.0)
    throw InputError("*PLASTIC, RATE: the table of rate zero is missing; give one without RATE");
  for (std::size_t i = 1; i < flow.curves.size(); ++i)
    if (flow.curves[i].rate == flow.curves[i - 1].rate)
      throw InputError(fmt::format("*PLASTIC: two tables have the rate {}; keep one", flow.curves[i].rate));
  add_rate_option(material, flow);
  return flow;
}

}  // namespace balocco
