#include "print_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "elements/consistent_mass.hpp"
#include "elements/element_type.hpp"
#include "elements/solids/solid_reference.hpp"
#include "gather.hpp"
#include "model/diagnostics.hpp"
#include "print_contact.hpp"
#include "print_section.hpp"
#include "print_text.hpp"

namespace balocco {

namespace {

/// The variable of the elements that a printed one is made of.
std::string source_variable(const std::string& printed) {
  if (printed == "ME") return "E";  // less the thermal strain
  return printed == "ENER" ? "SENER" : printed;
}

bool is_strain(const std::string& printed) {
  return printed == "E" || printed == "ME" || printed == "LE";
}
bool is_tensor(const std::string& printed) {
  return printed == "S" || is_strain(printed);
}
bool is_of_whole_elements(const std::string& printed) {
  return printed == "EVOL" || printed == "ELSE" || printed == "ELKE";
}

/// Six components of those that the element has: 11 22 33 12 13 23; 11 22 12 of sheets; 11 of lines.
std::array<double, 6> six_components(std::span<const double> values) {
  std::array<double, 6> six{};
  if (values.size() == 6) std::ranges::copy(values, six.begin());
  if (values.size() == 3) six = {values[0], values[1], 0.0, values[2], 0.0, 0.0};
  if (values.size() <= 2 && !values.empty()) six[0] = values[0];
  return six;
}

}  // namespace

PrintTables::PrintTables(const Model& model, const Communicator& communicator, const Domain& domain, std::string path)
    : model_(model), communicator_(communicator), domain_(domain), path_(std::move(path)), directions_(model) {}

void PrintTables::create() {
  communicator_.together([&] {
    std::error_code absent;
    if (communicator_.is_root()) std::filesystem::remove(path_, absent);
  });
}

void PrintTables::resume(const State& state) {
  communicator_.together([&] {
    if (!communicator_.is_root() || !std::filesystem::exists(path_)) return;
    std::ifstream file(path_);
    std::uintmax_t place = 0, kept = 0;
    std::int64_t step = 0;
    for (std::string line; std::getline(file, line); place += line.size() + 1) {
      const auto heading = number_of_step_heading(line);
      const auto increment = number_of_increment_heading(line);
      const bool later =
          (heading > 0 && (heading > state.step + 1 || (heading == state.step + 1 && state.increment == 0))) ||
          (increment > 0 && step == state.step + 1 && increment > state.increment);
      if (later) break;
      if (heading > 0) step = heading;
      if (!line.empty()) kept = place + line.size() + 1;
    }
    file.close();
    headed_step_ = static_cast<std::int32_t>(step) - 1;
    std::filesystem::resize_file(path_, std::min(kept, std::filesystem::file_size(path_)));
  });
}

void PrintTables::start_step(const ResultSource& source, std::int32_t step) {
  step_ = step;
  time_ = source.state().total_time;
  requests_.clear();
  modes_.clear();
  tables_of_modes_.clear();
  for (const auto& output : model_.steps[step].print_outputs) {
    requests_.push_back(plan(source, output));
    requests_.back().schedule.pass(source.state().step_time);
  }
}

PrintTables::Request PrintTables::plan(const ResultSource& source, const PrintOutput& output) const {
  const double duration = model_.steps[step_].duration();
  const auto schedule = output.time_points.empty() ? Schedule::every_increments(output.frequency, duration)
                                                   : Schedule::at(output.time_points, duration);
  if (output.kind == PrintOutput::Kind::section || output.kind == PrintOutput::Kind::contact) return {&output, {}, schedule};
  return {&output, output.kind == PrintOutput::Kind::nodes ? nodes_of(output) : elements_of(source, output), schedule};
}

std::vector<PrintTables::Place> PrintTables::nodes_of(const PrintOutput& output) const {
  std::vector<std::int32_t> rows;
  if (output.set < 0)
    for (std::int32_t row = 0; row < model_.nodes.size(); ++row) rows.push_back(row);
  else
    rows = model_.node_sets[output.set].deck_order.empty() ? model_.node_sets[output.set].nodes
                                                           : model_.node_sets[output.set].deck_order;
  std::vector<Place> places;
  for (const auto row : rows) {
    if (row < 0) {
      places.push_back({.id = model_.node_sets[output.set].absent[-1 - row]});
      continue;
    }
    const auto local = domain_.local_node[row];
    places.push_back({model_.nodes.id[row], -1, row, local >= 0 && domain_.owned[local] ? local : -1});
  }
  return places;
}

std::vector<PrintTables::Place> PrintTables::elements_of(const ResultSource& source, const PrintOutput& output) const {
  std::vector<ElementRef> elements;
  if (output.set < 0) {
    for (std::size_t table = 0; table < model_.elements.size(); ++table)
      for (std::int32_t row = 0; row < model_.elements[table].size(); ++row)
        elements.push_back({static_cast<std::int32_t>(table), row});
  } else {
    const auto& set = model_.element_sets[output.set];
    elements = set.deck_order.empty() ? set.elements : set.deck_order;
  }
  std::map<ElementRef, std::size_t> position;
  std::vector<Place> places;
  for (const auto element : elements) {
    if (model_.elements[element.table].type->make_group == nullptr) continue;
    if (std::ranges::binary_search(model_.steps[step_].removed_elements, element)) continue;
    position.emplace(element, places.size());
    places.push_back({model_.elements[element.table].id[element.row], element.table, element.row});
  }
  for (std::size_t group = 0; group < source.groups().size(); ++group) {
    const auto& lanes = *source.groups()[group];
    for (std::int32_t lane = 0; lane < lanes.size(); ++lane) {
      const auto found = position.find({lanes.table(), lanes.row(lane)});
      if (found == position.end()) continue;
      places[found->second].local = lane;
      places[found->second].group = static_cast<std::int32_t>(group);
    }
  }
  return places;
}

std::string PrintTables::table(const Request& request, const std::string& variable, const std::vector<int>& points,
                               const std::vector<double>& values, double time) const {
  if (!communicator_.is_root() || values.empty()) return "";
  const auto& output = *request.output;
  const bool of_nodes = output.kind == PrintOutput::Kind::nodes;
  const std::string behind = fmt::format(" for set {} and time {}\n\n", output.set_name, fortran_real(time));
  std::size_t rows = 0;
  for (const int count : points) rows += static_cast<std::size_t>(std::max(count, 1));
  const std::size_t columns = values.size() / rows;
  std::vector<double> sum(columns, 0.0);
  std::string text, lines;
  auto value = values.begin();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int point = 0; point < std::max(points[i], 1); ++point, value += static_cast<std::ptrdiff_t>(columns)) {
      lines += table_row(request.places[i].id, points[i] == 0 ? -1 : point, std::span(&*value, columns));
      for (std::size_t c = 0; c < columns; ++c) sum[c] += *(value + static_cast<std::ptrdiff_t>(c));
    }
  const bool has_totals = !title_of_totals(variable).empty();
  if (output.totals != PrintOutput::Totals::only || !has_totals)
    text += "\n " + (of_nodes ? title_of_nodes(variable) : title_of_elements(variable)) + behind + lines;
  if (output.totals != PrintOutput::Totals::none && has_totals)
    text += "\n " + title_of_totals(variable) + behind + totals_row(sum);
  return text;
}

/// `local`: three values on each of this rank's nodes.
std::string PrintTables::nodal_table(const Request& request, const std::string& variable, std::span<const double> local,
                                     double time) const {
  std::vector<double> values(3 * request.places.size(), 0.0);
  for (std::size_t i = 0; i < request.places.size(); ++i) {
    const auto& [id, element_table, row, node, group] = request.places[i];
    if (node < 0) continue;
    const double* const vector = &local[3 * static_cast<std::size_t>(node)];
    const auto* const axes = request.output->global_directions ? nullptr : directions_.find(row);
    for (int axis = 0; axis < 3; ++axis)
      values[3 * i + axis] =
          axes == nullptr ? vector[axis]
                          : (*axes)(axis, 0) * vector[0] + (*axes)(axis, 1) * vector[1] + (*axes)(axis, 2) * vector[2];
  }
  merge_bits(values, communicator_);
  return table(request, variable, std::vector<int>(request.places.size(), 0), values, time);
}

std::string PrintTables::nodal_tables(const ResultSource& source, const Request& request, double time) const {
  std::string text;
  std::vector<double> local(3 * static_cast<std::size_t>(domain_.size()));
  for (const auto& variable : request.output->variables) {
    source.nodal(variable == "RF" ? "TF" : variable, local);  // CalculiX counts loads among the forces
    text += nodal_table(request, variable, local, time);
  }
  return text;
}

/// Between global directions, in which elements tell tensors of a solid, and the material ones of its section, in which
/// they tell E.
void PrintTables::turn(const Request& request, const Place& element, bool is_material,
                       std::span<double, 6> tensor) const {
  if (request.output->global_directions != is_material) return;
  const ElementTable& table = model_.elements[element.table];
  const Section& section = model_.sections[table.section[element.row]];
  if (section.kind != Section::Kind::solid || section.orientation < 0) return;
  Point centre{};
  for (int node = 0; node < table.type->nodes; ++node)
    for (int i = 0; i < 3; ++i)
      centre[i] +=
          model_.nodes.coordinates[table.connectivity[element.row * table.type->nodes + node]][i] / table.type->nodes;
  const auto directions = material_directions(model_, section, centre, {element.table, element.row}),
             axes = is_material ? transpose(directions) : directions;
  const Matrix3<double> given{
      {tensor[0], tensor[3], tensor[4], tensor[3], tensor[1], tensor[5], tensor[4], tensor[5], tensor[2]}};
  const auto wanted = transpose(axes) * given * axes;
  const std::array<double, 6> turned{wanted(0, 0), wanted(1, 1), wanted(2, 2),
                                     wanted(0, 1), wanted(0, 2), wanted(1, 2)};
  std::ranges::copy(turned, tensor.begin());
}

/// Where an integration point is, in linear steps where it was at the start.
Point PrintTables::coordinates(const ResultSource& source, const Place& element, int point) const {
  const ElementTable& table = model_.elements[element.table];
  const auto nodes = source.groups()[element.group]->nodes(element.local);
  std::vector<double> shares(nodes.size());
  table.type->point_shapes(point, shares);
  Point sum{};
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const double* const x = source.state().linear ? model_.nodes.coordinates[domain_.node_row[nodes[node]]].data()
                                                  : &source.state().position[4 * static_cast<std::size_t>(nodes[node])];
    for (int i = 0; i < 3; ++i) sum[i] += shares[node] * x[i];
  }
  return sum;
}

std::vector<double> PrintTables::point_values(const ResultSource& source, const Request& request,
                                              const std::string& printed, std::vector<int>& points) const {
  const std::string variable = source_variable(printed);
  std::vector<double> counts;
  for (const auto& place : request.places)
    counts.push_back(place.group < 0 ? 0.0 : source.groups()[place.group]->integration_points());
  communicator_.maximum(counts);
  points.assign(counts.begin(), counts.end());
  const std::size_t columns = is_tensor(printed) ? 6 : printed == "COORD" ? 3 : 1;
  std::vector<double> values, own;
  for (std::size_t i = 0; i < request.places.size(); ++i) {
    const Place& place = request.places[i];
    for (int point = 0; point < points[i]; ++point) {
      values.resize(values.size() + columns, 0.0);
      if (place.group < 0) continue;
      if (printed == "COORD") {
        std::ranges::copy(coordinates(source, place, point), values.end() - 3);
        continue;
      }
      own.assign(source.groups()[place.group]->output_components(variable), 0.0);
      if (own.empty()) continue;
      source.element(place.group, variable, place.local, point, own);
      auto six = six_components(own);
      if (printed == "ME" && source.groups()[place.group]->output_components("THE") == 1) {
        double thermal = 0.0;
        source.element(place.group, "THE", place.local, point, std::span(&thermal, 1));
        if (!source.state().linear) thermal += 0.5 * thermal * thermal;  // Green's strain
        for (std::size_t axis = 0; axis < 3; ++axis) six[axis] -= axis < own.size() ? thermal : 0.0;
      }
      if (is_strain(printed))
        for (int shear = 3; shear < 6; ++shear) six[shear] *= 0.5;
      if (columns == 6) turn(request, place, variable == "E", six);
      std::copy_n(six.begin(), columns, values.end() - static_cast<std::ptrdiff_t>(columns));
    }
  }
  merge_bits(values, communicator_);
  return values;
}

/// By the mass that the step computes with: the consistent one where the element has it and the step is implicit.
double PrintTables::kinetic_energy(const ElementGroup& group, std::int32_t element, std::span<const double> velocity) const {
  const auto nodes = group.nodes(element);
  const auto product = [&](std::size_t a, std::size_t b) {
    const double* const u = &velocity[3 * static_cast<std::size_t>(nodes[a])];
    const double* const v = &velocity[3 * static_cast<std::size_t>(nodes[b])];
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  double twice = 0.0;
  ConsistentMass consistent(model_, group);
  if (consistent.exists() && !std::holds_alternative<ExplicitProcedure>(model_.steps[step_].procedure)) {
    const auto mass = consistent.products(element);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b) twice += group.density() * mass[a * nodes.size() + b] * product(a, b);
    return 0.5 * twice;
  }
  std::vector<double> mass(nodes.size());
  group.lumped_mass(element, mass);
  for (std::size_t node = 0; node < nodes.size(); ++node) twice += mass[node] * product(node, node);
  return 0.5 * twice;
}

std::vector<double> PrintTables::whole_values(const ResultSource& source, const Request& request,
                                              const std::string& variable) const {
  std::vector<double> values(request.places.size(), 0.0), velocity(3 * static_cast<std::size_t>(domain_.size())), share;
  if (variable == "ELKE") source.nodal("V", velocity);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Place& place = request.places[i];
    if (place.group < 0) continue;
    const ElementGroup& group = *source.groups()[place.group];
    if (variable == "ELSE") {
      source.element(place.group, variable, place.local, 0, std::span(&values[i], 1));
      continue;
    }
    if (variable == "ELKE") {
      values[i] = kinetic_energy(group, place.local, velocity);
      continue;
    }
    share.resize(group.nodes_per_element());
    group.lumped_volume(place.local, share);
    for (const double volume : share) values[i] += volume;
  }
  merge_bits(values, communicator_);
  return values;
}

std::string PrintTables::element_tables(const ResultSource& source, const Request& request, double time) const {
  std::string text;
  for (const auto& variable : request.output->variables) {
    std::vector<int> points(request.places.size(), 0);
    const auto values = is_of_whole_elements(variable) ? whole_values(source, request, variable)
                                                       : point_values(source, request, variable, points);
    text += table(request, variable, points, values, time);
  }
  return text;
}

std::string PrintTables::tables(const ResultSource& source, const Request& request, double time) const {
  using Kind = PrintOutput::Kind;
  switch (request.output->kind) {
    case Kind::nodes: return nodal_tables(source, request, time);
    case Kind::elements: return element_tables(source, request, time);
    case Kind::section: return section_table(model_, communicator_, domain_, source, *request.output, time);
    case Kind::contact: return contact_tables(model_, communicator_, source, *request.output, time);
  }
  return "";
}

void PrintTables::advance(const ResultSource& source, const Progress& progress) {
  std::string text;
  const bool modes = model_.steps[step_].seeks_modes();
  if (modes && !modes_.empty()) {
    const bool buckles = std::holds_alternative<BuckleProcedure>(model_.steps[step_].procedure);
    text = (buckles ? load_factor_table(modes_) : eigenvalue_tables(modes_)) + tables_of_modes_;
  }
  std::vector<const Request*> due;
  for (auto& request : requests_) {
    if (modes || !request.schedule.due(progress.step_time, progress.increment, progress.step_finished)) continue;
    request.schedule.pass(progress.step_time);
    due.push_back(&request);
  }
  if (!due.empty()) text += increment_heading(progress.increment);
  const double time = model_.steps[step_].is_harmonic() ? progress.frequency : progress.total_time;
  for (const ResultPart& part : source.parts())
    for (const Request* request : due) text += tables(*part.source, *request, time);
  write(text);
}

double PrintTables::next_due() const {
  double next = 1e300;
  for (const auto& request : requests_) next = std::min(next, request.schedule.next());
  return next;
}

void PrintTables::add_mode(const Mode& mode) {
  modes_.push_back({.number = mode.number,
                    .eigenvalue = mode.eigenvalue,
                    .generalized_mass = mode.generalized_mass,
                    .participation = mode.participation,
                    .effective_mass = mode.effective_mass});
  std::string text;
  std::vector<double> shape = mode.displacement;
  for (double& value : shape) value /= std::sqrt(mode.generalized_mass);
  for (const auto& request : requests_)
    if (request.output->kind == PrintOutput::Kind::nodes && std::ranges::count(request.output->variables, "U") > 0)
      text += nodal_table(request, "U", shape, time_);
  if (!text.empty()) tables_of_modes_ += mode_heading(mode.number) + text;
}

void PrintTables::write(const std::string& text) {
  communicator_.together([&] {
    if (!communicator_.is_root() || text.empty()) return;
    std::ofstream file(path_, std::ios::app);
    if (headed_step_ < step_) file << step_heading(step_);
    headed_step_ = step_;
    file << text;
    file.close();
    if (!file) throw SystemError(fmt::format("{}: cannot be written", path_));
  });
}

}  // namespace balocco
