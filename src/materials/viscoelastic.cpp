#include "materials/viscoelastic.hpp"

#include <fmt/format.h>

#include "materials/material_option.hpp"
#include "materials/neo_hooke.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"

namespace balocco {

namespace {

constexpr double nothing = 1e-300;

const RegisterOption prony({.name = "prony",
                            .keyword = "VISCOELASTIC",
                            .words = {{"TIME", "PRONY"}},
                            .columns = {{"g", 0.0, 1.0, "share of the instantaneous shear modulus that relaxes"},
                                        {"k", -nothing, nothing, "relaxation of the bulk modulus, which is not supported: 0"},
                                        {"tau", 0.0, unbounded, "relaxation time"}},
                            .table = true});

}  // namespace

bool relaxes(const Material& material) { return find_option(material, "prony") != nullptr; }

std::vector<PronyTerm> prony_terms(const Material& material) {
  std::vector<PronyTerm> terms;
  const MaterialOption* option = find_option(material, "prony");
  if (option == nullptr) return terms;
  double sum = 0.0;
  for (const auto& row : option->rows) {
    terms.push_back({row[0], row[2]});
    sum += row[0];
  }
  if (terms.size() > Viscoelastic<NeoHooke>::most_terms)
    throw InputError(fmt::format("*VISCOELASTIC: {} terms; at most {} are supported", terms.size(),
                                 Viscoelastic<NeoHooke>::most_terms));
  if (!(sum < 1.0))
    throw InputError(fmt::format("*VISCOELASTIC: the g of all terms add up to {}; they must stay below 1", sum));
  return terms;
}

}  // namespace balocco
