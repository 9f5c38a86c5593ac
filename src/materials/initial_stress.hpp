// Laws whose undeformed state is not free of stress (*INITIAL CONDITIONS, TYPE=STRESS).
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "materials/expanding.hpp"
#include "materials/initial_strain.hpp"
#include "materials/material_law.hpp"
#include "model/model.hpp"

namespace balocco {

/// The law with a second Piola-Kirchhoff stress S0 that it has already in the undeformed state, where it is the Cauchy stress too:
///   solids: P = P_law(F) + F S0; others: S = S_law(E) + S0; energy density + S0 : E.
/// Laws that yield are to count it: theirs is that of initially_strained().
/// S0 belongs to the material directions, so that the stress turns with the body. It is the history field "S0", behind the law's own.
template <PointKind kind>
std::unique_ptr<Law<kind>> initially_stressed(std::unique_ptr<Law<kind>> law);

/// The law of a material, with an initial stress where the section says so, which it has before it expands with temperature, if the
/// material does. Null as make_law.
template <PointKind kind>
std::unique_ptr<Law<kind>> law_of_section(const Material& material, const Section& section) {
  auto law = make_law<kind>(material);
  if (law != nullptr && section.initially_stressed) law = initially_stressed(std::move(law));
  return law != nullptr && material.expansion ? expanding(std::move(law)) : std::move(law);
}

/// Row of a law's history at which a field begins; -1 if the law has no such field.
template <PointKind kind>
int field_row(const Law<kind>& law, std::string_view field) {
  for (const auto& known : law.history_fields())
    if (known.name == field) return known.first;
  return -1;
}

}  // namespace balocco
