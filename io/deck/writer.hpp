// Parts of the deck writer: names and ids as the deck says them, sets made on the way, and the steps.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "model/model.hpp"

namespace balocco::deck {

/// Quotes a name that holds blanks or commas.
std::string quoted(const std::string& name);

/// Degrees that the reader turns into just these radians: a round figure if there is one.
double degrees_of(double radians);

using Conditions = std::vector<BoundaryCondition>::const_iterator;

class Writer {
 public:
  explicit Writer(const Model& model) : model_(model) {}
  std::string write();

 private:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }
  void comment(const char* text);
  /// Values in lines of eight.
  template <class Range>
  void values(const Range& range);

  void head();
  void mesh();
  void sets();
  void definitions();
  void amplitude(const Amplitude& amplitude);
  void orientation(const Orientation& orientation);
  void element_orientation(const Orientation& orientation);
  void surfaces();
  void surface(const Surface& surface);
  void analytical(const Surface& surface);
  void materials();
  void material_option(const MaterialOption& option);
  void sections();
  void spring(const char* keyword, const Section& section, std::size_t row, const std::string& set);
  std::string distributed_thickness(std::size_t row);
  void shell(const Section& section, std::size_t row, const std::string& set);
  void section(std::size_t row);
  void beam_section(const Section& section, std::size_t row, const std::string& set);
  void section_line(const char* keyword, const Section& section, std::size_t row, const std::string& set);
  void rigid_bodies();
  void contact();
  void initial_displacements();
  void initial_temperatures();
  void initial_velocities();
  void initial_fields();

  void step(std::size_t row);
  void procedure(const StaticProcedure& p);
  void procedure(const ExplicitProcedure& p);
  void mass_scaling(const char* kind, const MassScaling& definition);
  void procedure(const FrequencyProcedure& p);
  void procedure(const DynamicProcedure& p);
  void procedure(const BuckleProcedure& p);
  void procedure(const ModalDynamicProcedure& p);
  void procedure(const StaticPerturbationProcedure& p);
  void procedure(const SteadyStateProcedure& p);
  void modal_damping(const std::vector<ModalDamping>& dampings);
  void controls(const ImplicitControls& now);
  void contact_changes(std::size_t row);
  void interaction_change(const Interaction& now, const Interaction& before);
  void friction(const Interaction& interaction);
  void behavior(const Interaction& interaction);
  void element_changes(std::size_t row);
  void boundary(std::size_t row);
  const NodeSet* set_of(Conditions first, Conditions end) const;
  void loads(const Step& step);
  void attachments(const Step& step);
  void field_output(const FieldOutput& output, std::size_t step, std::size_t number);
  void history_output(const HistoryOutput& output);
  void print_outputs(const Step& step, std::size_t row);
  std::string time_points(const std::vector<double>& times, const std::string& name);
  void checkpoints(std::size_t row);

  std::int64_t node_id(std::int32_t row) const { return model_.nodes.id[row]; }
  std::string amplitude_parameter(std::int32_t amplitude) const;
  /// Name of a set with just these members; made if the model has none.
  std::string node_set_of(const std::vector<std::int32_t>& nodes, const std::string& name_if_made);
  std::string element_set_of(const std::vector<ElementRef>& elements, const std::string& name_if_made);

  const Model& model_;
  std::string text_;
  ImplicitControls controls_;  // that the deck has come to
  std::vector<NodeSet> made_node_sets_;
  std::vector<ElementSet> made_element_sets_;
  std::string time_points_;  // *TIME POINTS blocks of the output requests
};

template <class Range>
void Writer::values(const Range& range) {
  int column = 0;
  for (const auto& value : range) {
    fmt::format_to(std::back_inserter(text_), "{}{}", column == 0 ? "" : ", ", value);
    if (++column == 8) {
      text_ += '\n';
      column = 0;
    }
  }
  if (column > 0) text_ += '\n';
}

}  // namespace balocco::deck
