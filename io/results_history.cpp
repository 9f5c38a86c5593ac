#include "results_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "gather.hpp"
#include "results_frame.hpp"
#include "results_index.hpp"

namespace balocco {

namespace {

constexpr std::array<std::pair<const char*, double EnergyBalance::*>, 11> energy_members{{
    {"ALLKE", &EnergyBalance::kinetic},
    {"ALLIE", &EnergyBalance::internal},
    {"ALLSE", &EnergyBalance::strain},
    {"ALLPD", &EnergyBalance::plastic},
    {"ALLVD", &EnergyBalance::viscous},
    {"ALLMW", &EnergyBalance::mass_scaling},
    {"ALLAE", &EnergyBalance::hourglass},
    {"ALLFD", &EnergyBalance::friction},
    {"ALLCW", &EnergyBalance::contact},
    {"ALLWK", &EnergyBalance::work},
    {"ETOTAL", &EnergyBalance::total},
}};

constexpr std::array<std::string_view, 6> tensor_components{"11", "22", "33", "12", "13", "23"};

/// A variable as the deck names it: the one the model has, and which of its components (-1: all).
struct Component {
  std::string variable;
  int index = -1;
};

Component split_vector(const std::string& name) {
  const char digit = name.empty() ? '0' : name.back();
  if (digit < '1' || digit > '3') return {name, -1};
  return {name.substr(0, name.size() - 1), digit - '1'};
}

Component split_tensor(const std::string& name) {
  if (name.size() < 3) return {name, -1};
  const auto found = std::find(tensor_components.begin(), tensor_components.end(), std::string_view(name).substr(name.size() - 2));
  if (found == tensor_components.end()) return {name, -1};
  return {name.substr(0, name.size() - 2), static_cast<int>(found - tensor_components.begin())};
}

}  // namespace

/// Collective quantities are asked for once a row, in the same order on every rank.
class History::Row {
 public:
  Row(const ResultSource& source, std::int32_t local_nodes) : source_(source), parts_(source.parts()), local_nodes_(local_nodes) {}

  const EnergyBalance& energies() {
    if (!energies_) energies_ = source_.energies();
    return *energies_;
  }
  const ContactResultant& contact(std::int32_t pair) {
    const auto known = contacts_.find(pair);
    return known != contacts_.end() ? known->second : contacts_.emplace(pair, source_.contact(pair)).first->second;
  }
  const std::vector<double>& nodal(const std::string& variable, std::size_t part, int components) {
    std::vector<double>& values = nodal_[{variable, part}];
    if (values.empty() && local_nodes_ > 0) {
      values.resize(static_cast<std::size_t>(local_nodes_) * components);
      parts_[part].source->nodal(variable, values);
    }
    return values;
  }
  const ResultSource& part(std::size_t number) const { return *parts_[number].source; }

 private:
  const ResultSource& source_;
  const std::vector<ResultPart> parts_;
  std::int32_t local_nodes_;
  std::optional<EnergyBalance> energies_;
  std::map<std::int32_t, ContactResultant> contacts_;
  std::map<std::pair<std::string, std::size_t>, std::vector<double>> nodal_;
};

History::Group& History::group(const std::string& name, std::size_t request) {
  auto found = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.name == name; });
  if (found == groups_.end()) found = groups_.insert(groups_.end(), Group{name, {}, {}, {}, {}});
  if (std::find(found->requests.begin(), found->requests.end(), request) == found->requests.end()) {
    found->requests.push_back(request);
  }
  return *found;
}

/// Turns the requests of the deck into channels.
struct History::Builder {
  History& history;
  const Domain& domain;
  const ResultSource& source;
  std::vector<std::string>& complaints;

  static void add(Group& group, Channel channel) {
    const bool known = std::any_of(group.channels.begin(), group.channels.end(), [&](const Channel& c) { return c.name == channel.name; });
    if (!known) group.channels.push_back(std::move(channel));
  }

  /// A channel for each part of what is told.
  void add_parts(Group& group, const Channel& whole) const {
    const auto parts = source.parts();
    for (std::size_t part = 0; part < parts.size(); ++part) {
      Channel channel = whole;
      channel.name += parts[part].suffix;
      channel.part = part;
      add(group, std::move(channel));
    }
  }

  template <class Set, class Members>
  Group& group_of(const Set& set, const Members& members, const std::string& name, std::size_t request) const {
    Group& group = history.group(name, request);
    if (members.size() == 1 && group.set.empty()) group.set = set.name;
    return group;
  }

  void complain(const std::string& variable, const std::string& where) const {
    complaints.push_back(fmt::format("warning: history variable {} is not known for {}: it is not written", variable, where));
  }

  void add_energies(const HistoryOutput& output, std::size_t request) const {
    for (const std::string& name : output.energies) {
      const bool known = std::any_of(energy_members.begin(), energy_members.end(), [&](const auto& m) { return name == m.first; });
      if (known) {
        add(history.group("energy", request), {.kind = Kind::energy, .name = name, .variable = name});
      } else {
        complain(name, "the whole model");
      }
    }
  }

  void add_nodes(const HistoryOutput::Nodes& nodes, std::size_t request) const {
    const NodeSet& set = history.model_->node_sets[nodes.set];
    for (const std::string& name : nodes.variables) {
      const Component part = source.nodal_components(name) > 0 ? Component{name, -1} : split_vector(name);
      const int components = source.nodal_components(part.variable);
      if (components <= std::max(part.index, 0)) {
        complain(name, "node set " + set.name);
        continue;
      }
      for (std::int32_t row : set.nodes) {
        const std::int32_t local = domain.local_node[row];
        Channel channel{.kind = Kind::nodal, .name = name, .variable = part.variable};
        channel.first = std::max(part.index, 0);
        channel.columns = part.index < 0 ? components : 1;
        channel.source_columns = components;
        channel.place = local >= 0 && domain.owned[local] ? local : -1;
        add_parts(group_of(set, set.nodes, fmt::format("node_{}", history.model_->nodes.id[row]), request), channel);
      }
    }
  }

  void add_elements(const HistoryOutput::Elements& elements, std::size_t request) const {
    const ElementSet& set = history.model_->element_sets[elements.set];
    for (const std::string& name : elements.variables) {
      bool known = false;
      for (const ElementRef& element : set.elements) known |= add_element(set, element, name, request);
      if (!known) complain(name, "element set " + set.name);
    }
  }

  /// An element is on one rank only; all ranks have to agree on its channels. @return false if it has no such variable.
  bool add_element(const ElementSet& set, const ElementRef& element, const std::string& name, std::size_t request) const {
    Channel channel{.kind = Kind::element, .name = name, .variable = name};
    Component part{name, -1};
    int components = 0;
    const auto groups = source.groups();
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g]->table() != element.table) continue;
      for (std::int32_t lane = 0; lane < groups[g]->size(); ++lane) {
        if (groups[g]->row(lane) != element.row) continue;
        if (groups[g]->output_components(name) == 0) part = split_tensor(name);
        components = groups[g]->output_components(part.variable);
        channel.place = lane;
        channel.group_index = g;
      }
    }
    components = static_cast<int>(history.communicator_->maximum(components));
    part.index = static_cast<int>(history.communicator_->maximum(part.index));
    if (components <= std::max(part.index, 0)) return false;
    channel.variable = part.index < 0 ? name : split_tensor(name).variable;
    channel.first = std::max(part.index, 0);
    channel.columns = part.index < 0 ? components : 1;
    channel.source_columns = components;
    const std::int64_t id = history.model_->elements[element.table].id[element.row];
    add_parts(group_of(set, set.elements, fmt::format("element_{}", id), request), channel);
    return true;
  }

  void add_contact(std::int32_t pair, std::size_t request) const {
    const ContactPair& contact = history.model_->contact_pairs[pair];
    const std::string name = fmt::format("contact_{}_{}", history.model_->surfaces[contact.slave].name,
                                         history.model_->surfaces[contact.master].name);
    Group& group = history.group(hdf5_name(name), request);
    for (const char* vector : {"CFN", "CFT", "CM", "XN"}) {
      add(group, {.kind = Kind::contact, .name = vector, .variable = vector, .columns = 3, .place = pair});
    }
    add(group, {.kind = Kind::contact, .name = "CAREA", .variable = "CAREA", .place = pair});
  }
};

History::History(const Model& model, const Communicator& communicator, const Domain& domain, const ResultSource& source,
                 std::int32_t step, std::vector<std::string>& complaints)
    : model_(&model), communicator_(&communicator), step_(step), local_nodes_(domain.size()) {
  const Builder builder{*this, domain, source, complaints};
  const auto& outputs = model.steps[step].history_outputs;
  for (std::size_t request = 0; request < outputs.size(); ++request) {
    schedules_.push_back(Schedule::of(outputs[request], model.steps[step]));
    builder.add_energies(outputs[request], request);
    for (const auto& nodes : outputs[request].nodes) builder.add_nodes(nodes, request);
    for (const auto& elements : outputs[request].elements) builder.add_elements(elements, request);
    for (std::int32_t pair : outputs[request].contact_pairs) builder.add_contact(pair, request);
  }
}

void History::fill(const Channel& channel, Row& row, double* values) const {
  switch (channel.kind) {
    case Kind::energy: {
      const EnergyBalance& energies = row.energies();
      if (!communicator_->is_root()) return;
      for (const auto& [name, member] : energy_members) {
        if (channel.variable == name) *values = energies.*member;
      }
      return;
    }
    case Kind::contact: {
      const ContactResultant& contact = row.contact(channel.place);
      if (!communicator_->is_root()) return;
      if (channel.variable == "CAREA") *values = contact.area;
      if (channel.variable == "CFN") std::copy(contact.normal_force.begin(), contact.normal_force.end(), values);
      if (channel.variable == "CFT") std::copy(contact.friction_force.begin(), contact.friction_force.end(), values);
      if (channel.variable == "CM") std::copy(contact.moment.begin(), contact.moment.end(), values);
      if (channel.variable == "XN") std::copy(contact.center.begin(), contact.center.end(), values);
      return;
    }
    case Kind::nodal: {
      const auto& nodal = row.nodal(channel.variable, channel.part, channel.source_columns);
      if (channel.place < 0) return;
      std::copy_n(nodal.begin() + static_cast<std::ptrdiff_t>(channel.place) * channel.source_columns + channel.first,
                  channel.columns, values);
      return;
    }
    case Kind::element: {
      if (channel.place < 0) return;
      std::vector<double> all(channel.source_columns);
      row.part(channel.part).element_mean(channel.group_index, channel.variable, channel.place, all);
      std::copy_n(all.begin() + channel.first, channel.columns, values);
      return;
    }
  }
}

void History::pass(double step_time) {
  for (Schedule& schedule : schedules_) schedule.pass(step_time);
}

void History::sample(const ResultSource& source, const Progress& progress, bool all) {
  std::vector<bool> due;
  for (Schedule& schedule : schedules_) {
    due.push_back(all || schedule.due(progress.step_time, progress.increment, progress.step_finished));
    if (due.back()) schedule.pass(progress.step_time);
  }
  Row row(source, local_nodes_);
  std::vector<Group*> taken;
  std::vector<double> values;
  for (Group& group : groups_) {
    if (std::none_of(group.requests.begin(), group.requests.end(), [&](std::size_t r) { return due[r]; })) continue;
    taken.push_back(&group);
    for (const Channel& channel : group.channels) {
      values.resize(values.size() + channel.columns, 0.0);
      fill(channel, row, values.data() + values.size() - channel.columns);
    }
  }
  if (taken.empty()) return;
  merge_bits(values, *communicator_);
  if (!communicator_->is_root()) return;
  auto next = values.begin();
  for (Group* group : taken) {
    group->axis.push_back(model_->steps[step_].is_harmonic() ? progress.frequency : progress.total_time);
    for (Channel& channel : group->channels) {
      channel.rows.insert(channel.rows.end(), next, next + channel.columns);
      next += channel.columns;
    }
  }
}

double History::next_due() const {
  double next = 1e300;
  for (const Schedule& schedule : schedules_) next = std::min(next, schedule.next());
  return next;
}

bool History::buffered() const {
  return std::any_of(groups_.begin(), groups_.end(), [](const Group& group) { return !group.axis.empty(); });
}

void History::flush(const Hdf5File& file) {
  for (Group& group : groups_) {
    if (group.axis.empty()) continue;
    const std::string path = step_path(step_) + "/history/" + group.name;
    for (Channel& channel : group.channels) {
      file.append(path + "/" + channel.name, channel.columns, channel.rows);
      channel.rows.clear();
    }
    if (!group.set.empty() && !file.has_attribute(path, "set")) file.set_attribute(path, "set", group.set);
    // Where the rows stand comes last: rows that it does not count were cut short.
    file.append(path + "/" + history_axis(model_->steps[step_]), 1, group.axis);
    group.axis.clear();
  }
}

void cut_history(const Hdf5File& file, std::int32_t step, double time) {
  const std::string history = step_path(step) + "/history";
  if (!file.exists(history)) return;
  for (const std::string& name : file.children(history)) {
    const std::string group = history + "/" + name + "/";
    if (!file.exists(group + "time")) {  // killed while the group was being made
      file.remove(history + "/" + name);
      continue;
    }
    const std::vector<double> times = file.read(group + "time");
    const auto kept = std::upper_bound(times.begin(), times.end(), time) - times.begin();
    for (const std::string& variable : file.children(history + "/" + name)) {
      file.truncate(group + variable, static_cast<hsize_t>(kept));
    }
  }
}

}  // namespace balocco
