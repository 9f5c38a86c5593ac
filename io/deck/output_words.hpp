// What the *OUTPUT family has in common: the variables that exist, and how requests for them are read.
#pragma once

#include <string>
#include <vector>

#include "deck/builder.hpp"
#include "deck/register.hpp"

namespace balocco::deck {

using Words = std::vector<std::string>;

// The nodal and contact variables of model/results.hpp, and energies.
extern const Words node_vectors, contact_fields, contact_histories, energies;
// What VARIABLE=PRESELECT stands for.
extern const Words preselected_node, preselected_element, preselected_contact;
/// What VARIABLE=ALL stands for; finish_output leaves what the elements of the model have.
extern const Words all_element;

bool contains(const Words& words, const std::string& word);
/// Appends a word that is not there yet.
void add(Words& words, const std::string& word);

/// A variable of Abaqus that is not written here: told, but no reason to refuse.
bool is_abaqus_only(const std::string& variable);
/// An element variable that is no linear function of the motion, so that a complex response has none.
bool has_no_parts(const std::string& variable);
/// The element variable that a component names: S of S11, SF of SF1, CTF of CTM2 (Abaqus counts its moments from 1 again); else the word
/// itself.
std::string whole_variable(const std::string& component);
/// A warning for what only Abaqus writes, an error with the nearest known word for the rest.
void unknown_variable(Builder& builder, const Block& block, Row& row, const std::string& variable, const Words& known);

ParameterRule variable_rule();
/// What the block's VARIABLE= asks for: `preselected`, `all`, or nothing without the parameter.
Words asked_by_variable(const Block& block, const Words& preselected, const Words& all);

/// Calls use(name, row) for every variable on the data lines.
template <class Use>
void each_variable(Builder& builder, const Block& block, const Use& use) {
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size() && row.ok(); ++field) {
      if (row.has(field)) use(row.name(field), row);
    }
  }
}

}  // namespace balocco::deck
