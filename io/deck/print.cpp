// *NODE PRINT *EL PRINT *SECTION PRINT *CONTACT PRINT: tables in JOB.dat.
#include <fmt/format.h>

#include <algorithm>

#include "deck/output_words.hpp"
#include "deck/register.hpp"
#include "deck/steady_state.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

const Words printed_of_nodes{"U", "V", "A", "RF", "UR", "VR", "RM"};
const Words printed_of_elements{"S", "E", "ME", "LE", "MISES", "PEEQ", "ENER", "COORD", "EVOL", "ELSE", "ELKE"};
const Words printed_of_sections{"SOF", "SOM", "SOAREA"};

/// The first request of a kind in a step takes the place of those of the steps before.
void replace_earlier(Builder& builder, PrintOutput::Kind kind) {
  if (!builder.draft.prints_replaced.insert(kind).second) return;
  std::erase_if(builder.model.steps.back().print_outputs,
                [&](const PrintOutput& output) { return output.kind == kind; });
}

/// What the three keywords say alike; nothing where nothing is to be printed.
std::optional<PrintOutput> begin_print(Builder& builder, const Block& block, PrintOutput::Kind kind) {
  replace_earlier(builder, kind);
  PrintOutput output;
  output.kind = kind;
  if (block.has("TIME POINTS")) refuse_in_harmonics(builder, block, without_times("TIME POINTS"));
  if (kind == PrintOutput::Kind::section || kind == PrintOutput::Kind::contact)
    refuse_in_harmonics(builder, block, "this table is not told of harmonic responses; use *NODE PRINT, *EL PRINT or *OUTPUT");
  output.frequency = block.integer("FREQUENCY", 1);
  if (output.frequency < 0) builder.error(block, block.location, "FREQUENCY must not be negative; correct it");
  if (output.frequency <= 0) return std::nullopt;
  if (block.has("TIME POINTS")) {
    if (block.has("FREQUENCY")) builder.error(block, block.location, "give one of FREQUENCY and TIME POINTS");
    const auto* points = builder.require_time_points(block);
    if (points == nullptr) return std::nullopt;
    output.time_points = *points;
  }
  if (block.value("TOTALS") == "YES") output.totals = PrintOutput::Totals::also;
  if (block.value("TOTALS") == "ONLY") output.totals = PrintOutput::Totals::only;
  output.set_name = "ALL";
  return output;
}

/// A component of a vector or tensor stands for the whole of it, as with *OUTPUT.
std::string printed_whole(const std::string& word, PrintOutput::Kind kind) {
  if (kind == PrintOutput::Kind::elements) return whole_variable(word);
  const bool numbered = word.size() > 1 && word.back() >= '1' && word.back() <= '3';
  return numbered && contains(printed_of_nodes, word.substr(0, word.size() - 1)) ? word.substr(0, word.size() - 1) : word;
}

void read_variables(Builder& builder, const Block& block, const Words& known, PrintOutput& output) {
  each_variable(builder, block, [&](const std::string& word, Row& row) {
    const auto variable = printed_whole(word, output.kind);
    if (!contains(known, variable))
      return row.error(fmt::format("variable {} cannot be printed{}; known: {}", variable,
                                   did_you_mean(variable, known), join(known)));
    add(output.variables, variable);
  });
  if (!output.variables.empty()) builder.model.steps.back().print_outputs.push_back(std::move(output));
}

/// The set that the parameter names, if any, of the model's sets. @return false if it is undefined (told).
template <class Set>
bool read_set(Builder& builder, const Block& block, const char* parameter, const Names& names, const std::vector<Set>& sets,
              PrintOutput& output) {
  if (!block.has(parameter)) return true;
  const auto set = builder.require(names, block.value(parameter), block, block.location);
  if (!set) return false;
  output.set = *set;
  output.set_name = sets[*set].name;
  return true;
}

void read_node_print(Builder& builder, const Block& block) {
  auto output = begin_print(builder, block, PrintOutput::Kind::nodes);
  if (!output || !read_set(builder, block, "NSET", builder.node_sets, builder.model.node_sets, *output)) return;
  output->global_directions = block.value("GLOBAL", "NO") == "YES";
  read_variables(builder, block, printed_of_nodes, *output);
}

/// Tells an element of the set whose points have no coordinates to be told.
void check_coordinates(Builder& builder, const Block& block, const PrintOutput& output) {
  const auto& tables = builder.model.elements;
  for (std::size_t table = 0; table < tables.size(); ++table) {
    const ElementType& type = *tables[table].type;
    if (type.make_group == nullptr || type.point_shapes != nullptr || tables[table].size() == 0) continue;
    std::int32_t row = 0;
    if (output.set >= 0) {
      const auto& elements = builder.model.element_sets[output.set].elements;
      const auto found = std::ranges::find(elements, static_cast<std::int32_t>(table), &ElementRef::table);
      if (found == elements.end()) continue;
      row = found->row;
    }
    return builder.error(block, block.location,
                         fmt::format("COORD is told of points of solids, and element {} is a {}; name a set of solids",
                                     builder.model.element_name({static_cast<std::int32_t>(table), row}), type.name));
  }
}

void read_element_print(Builder& builder, const Block& block) {
  auto output = begin_print(builder, block, PrintOutput::Kind::elements);
  if (!output || !read_set(builder, block, "ELSET", builder.element_sets, builder.model.element_sets, *output)) return;
  output->global_directions = block.value("GLOBAL", "NO") == "YES";
  const auto row = builder.model.steps.back().print_outputs.size();
  read_variables(builder, block, printed_of_elements, *output);
  const auto& prints = builder.model.steps.back().print_outputs;
  if (prints.size() > row && contains(prints.back().variables, "COORD")) check_coordinates(builder, block, prints.back());
}

/// Forces, moments and area come together, as CalculiX prints them.
void read_section_print(Builder& builder, const Block& block) {
  auto output = begin_print(builder, block, PrintOutput::Kind::section);
  if (!output) return;
  const auto surface = builder.require(builder.surfaces, block.value("SURFACE"), block, block.location);
  if (!surface) return;
  const auto& faces = builder.model.surfaces[*surface].faces;
  const bool of_solids = !faces.empty() && std::ranges::all_of(faces, [&](const FaceRef& face) {
    return builder.model.elements[face.element.table].type->section == Section::Kind::solid;
  });
  if (!of_solids)
    return builder.error(
        block, block.location,
        fmt::format("surface {} is not made of faces of solids, which are what can be cut; name one that is",
                    block.value("SURFACE")));
  output->set = *surface;
  output->section_name = block.value("NAME");
  read_variables(builder, block, printed_of_sections, *output);
}

/// CalculiX's and Abaqus's words of what is printed of contact.
std::string printed_of_contact(const std::string& word) {
  if (word == "CDISP" || word == "CDIS") return "CDIS";
  if (word == "CSTRESS" || word == "CSTR") return "CSTR";
  return word == "CELS" ? "CELS" : "";
}

void read_contact_print(Builder& builder, const Block& block) {
  auto output = begin_print(builder, block, PrintOutput::Kind::contact);
  if (!output || !read_set(builder, block, "NSET", builder.node_sets, builder.model.node_sets, *output)) return;
  each_variable(builder, block, [&](const std::string& word, Row&) {
    if (const auto variable = printed_of_contact(word); !variable.empty())
      add(output->variables, variable);
    else
      builder.warning(block, block.location, fmt::format("{} is not printed; known: CDIS, CSTR, CELS", word));
  });
  const auto& pairs = builder.model.contact_pairs;
  const bool any = std::ranges::any_of(pairs, [&](const auto& pair) { return deforms(builder.model, builder.model.surfaces[pair.master]); });
  if (output->set >= 0 && std::ranges::any_of(pairs, &ContactPair::of_faces))
    builder.warning(block, block.location, "NSET chooses among slave nodes; of pairs SURFACE TO SURFACE all places are printed");
  if (!any && !pairs.empty()) builder.warning(block, block.location, "tells of pairs with deformable masters, and there are none; use *OUTPUT");
  if (!output->variables.empty()) builder.model.steps.back().print_outputs.push_back(std::move(*output));
}

const ParameterRule totals = choice("TOTALS", {"YES", "NO", "ONLY"}), global = choice("GLOBAL", {"YES", "NO"});
const RegisterKeyword node_print{{"NODE PRINT",
                                  Phase::history,
                                  Place::step,
                                  {name("NSET"), integer("FREQUENCY"), name("TIME POINTS"), totals, global, foreign("SUMMARY")},
                                  read_node_print}};
const RegisterKeyword section_print{{"SECTION PRINT",
                                     Phase::history,
                                     Place::step,
                                     {required(name("SURFACE")), required(name("NAME")), integer("FREQUENCY"), name("TIME POINTS")},
                                     read_section_print}};
const RegisterKeyword contact_print{{"CONTACT PRINT",
                                     Phase::history,
                                     Place::step,
                                     {name("NSET"), integer("FREQUENCY"), name("TIME POINTS"), foreign("TOTALS"), foreign("SUMMARY"),
                                      foreign("SLAVE"), foreign("MASTER")},
                                     read_contact_print}};
const RegisterKeyword element_print{{"EL PRINT",
                                     Phase::history,
                                     Place::step,
                                     {name("ELSET"), integer("FREQUENCY"), name("TIME POINTS"), totals, global,
                                      choice("POSITION", {"INTEGRATION POINTS"}), foreign("SUMMARY")},
                                     read_element_print}};

}  // namespace

}  // namespace balocco::deck
