#include "print_contact.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/any_face.hpp"
#include "elements/element_type.hpp"
#include "elements/slave_places.hpp"
#include "elements/surface_nodes.hpp"
#include "gather.hpp"
#include "print_text.hpp"

namespace balocco {

namespace {

constexpr std::size_t values_of_place = 8;  // closed, gap, pressure, energy, displacement, shear

/// Of every place of a pair, on root.
std::vector<double> values_of(const Model& model, const Communicator& communicator, const ResultSource& source, std::int32_t pair) {
  std::vector<double> values(values_of_place * homes_of_places(model, model.contact_pairs[pair]).size(), 0.0);
  for (const auto& place : source.contact_places(pair)) {
    const std::array<double, values_of_place> row{1.0,
                                                  place.gap,
                                                  place.pressure,
                                                  place.energy,
                                                  place.displacement[0],
                                                  place.displacement[1],
                                                  place.shear[0],
                                                  place.shear[1]};
    std::ranges::copy(row, values.begin() + static_cast<std::ptrdiff_t>(values_of_place) * place.row);
  }
  merge_bits(values, communicator);
  return values;
}

/// How rows of a place begin: with the slave node, or its element and face.
std::vector<std::string> beginnings(const Model& model, const ContactPair& pair) {
  std::vector<std::string> texts;
  if (!pair.of_faces) {
    for (const auto node : homes_of_places(model, pair)) texts.push_back(fmt::format("{:10}", model.nodes.id[node]));
    return texts;
  }
  for (const auto& face : model.surfaces[pair.slave].faces) {
    const auto text = fmt::format("{:10}{:11}", model.elements[face.element.table].id[face.element.row], face.face + 1);
    texts.insert(texts.end(), face_stations(face_nodes(model, face).size()).size(), text);
  }
  return texts;
}

/// Columns of values_of_place that a variable prints.
std::vector<std::size_t> columns_of(const std::string& variable) {
  if (variable == "CDIS") return {1, 4, 5};
  if (variable == "CSTR") return {2, 6, 7};
  return {3};
}

std::string title_of(const std::string& variable, bool of_faces) {
  const std::string who = of_faces ? "slave element+face" : "slave node";
  if (variable == "CDIS") return fmt::format("relative contact displacement ({},normal,tang1,tang2)", who);
  if (variable == "CSTR") return fmt::format("contact stress ({},press,tang1,tang2)", who);
  return fmt::format("contact spring energy ({},energy)", who);
}

}  // namespace

std::string contact_tables(const Model& model, const Communicator& communicator, const ResultSource& source, const PrintOutput& output,
                           double time) {
  std::string text;
  for (std::size_t row = 0; row < model.contact_pairs.size(); ++row) {
    const auto& pair = model.contact_pairs[row];
    if (!deforms(model, model.surfaces[pair.master])) continue;
    const auto values = values_of(model, communicator, source, static_cast<std::int32_t>(row));
    if (!communicator.is_root()) continue;
    const auto first = beginnings(model, pair);
    const auto homes = homes_of_places(model, pair);
    const auto is_asked = [&](std::int32_t node) {
      return output.set < 0 || pair.of_faces || std::ranges::binary_search(model.node_sets[output.set].nodes, node);
    };
    for (const auto& variable : output.variables) {
      text += fmt::format("\n {} for all contact elements and time {}\n\n", title_of(variable, pair.of_faces), fortran_real(time));
      for (std::size_t place = 0; place < first.size(); ++place) {
        const double* const found = &values[values_of_place * place];
        if (found[0] == 0.0 || !is_asked(homes[place])) continue;
        text += first[place];
        for (const auto column : columns_of(variable)) text += fmt::format(" {:13.6E}", found[column]);
        text += '\n';
      }
    }
  }
  return text;
}

}  // namespace balocco
