#include "results_frame.hpp"

#include <algorithm>
#include <limits>

#include "elements/element_type.hpp"

namespace balocco {

namespace {

using Precision = ParallelFile::Precision;

void add_names(const std::vector<std::string>& names, bool single, std::int32_t set,
               std::vector<FrameVariables::Variable>& variables) {
  for (const std::string& name : names) {
    const auto same = std::find_if(variables.begin(), variables.end(), [&](const auto& v) { return v.name == name; });
    if (same == variables.end()) {
      variables.push_back({name, single ? Precision::single_ : Precision::double_, {}});
      if (set >= 0) variables.back().sets.push_back(set);
      continue;
    }
    if (!single) same->precision = Precision::double_;
    if (set < 0) same->sets.clear();
    if (!same->sets.empty()) same->sets.push_back(set);
  }
}

constexpr std::size_t room_for_structure = 1 << 20;  // groups, attributes and chunk indices of a frame

}  // namespace

void FrameVariables::add(const FieldOutput& output) {
  const bool single = output.single_precision;
  add_names(output.node_variables, single, output.node_set, nodes);
  add_names(output.contact_variables, single, -1, nodes);
  add_names(output.element_variables, single, output.element_set, elements);
  add_names(output.integration_point_variables, single, output.element_set, integration_points);
}

FrameWriter::FrameWriter(const Model& model, const Communicator& communicator, const Domain& domain, ElementGroups groups)
    : model_(&model),
      communicator_(&communicator),
      domain_(&domain),
      nodes_(make_node_rows(model, communicator, domain, Copies::owned)),
      tables_(make_table_rows(model, communicator, groups)) {}

ParallelFile::Layout FrameWriter::Field::layout() const {
  std::vector<hsize_t> columns;
  if (place == Place::points) columns.push_back(static_cast<hsize_t>(points));
  if (place == Place::points || components > 1) columns.push_back(static_cast<hsize_t>(components));
  return {columns, precision, true};
}

std::vector<FrameWriter::Field> FrameWriter::plan(const ResultSource& source, const FrameVariables& variables) const {
  using Place = Field::Place;
  std::vector<Field> fields;
  for (const auto& [name, precision, sets] : variables.nodes) {
    fields.push_back({Place::node, name, 0, source.nodal_components(name), 1, precision, sets});
  }
  for (std::size_t table = 0; table < tables_.size(); ++table) {
    for (const auto& [name, precision, sets] : variables.elements) {
      // Shells also tell what is in their lowest and highest layer; others have no components of that name.
      for (const char* side : {"", "_BOT", "_TOP"}) fields.push_back({Place::mean, name + side, table, 0, 1, precision, sets});
    }
    for (const auto& [name, precision, sets] : variables.integration_points) {
      fields.push_back({Place::points, name, table, 0, 1, precision, sets});
    }
  }
  // Element types without a member of the sets are left out.
  std::erase_if(fields, [&](const Field& field) {
    return field.place != Place::node && !field.sets.empty() && std::ranges::count(members(field), true) == 0;
  });
  // A rank without elements of a type learns from the others what they have.
  std::vector<double> sizes;
  for (const Field& field : fields) {
    int components = field.components, points = 1;
    for (const ElementGroup* group : field.place == Place::node ? std::vector<const ElementGroup*>{} : tables_[field.table].groups) {
      components = std::max(components, group->output_components(field.variable));
      points = std::max(points, group->integration_points());
    }
    sizes.insert(sizes.end(), {static_cast<double>(components), static_cast<double>(points)});
  }
  communicator_->maximum(sizes);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    fields[i].components = static_cast<int>(sizes[2 * i]);
    fields[i].points = static_cast<int>(sizes[2 * i + 1]);
  }
  std::erase_if(fields, [](const Field& field) { return field.components == 0; });
  std::vector<Field> of_parts;
  for (const Field& field : fields)
    for (const ResultPart& part : source.parts()) {
      of_parts.push_back(field);
      of_parts.back().part = part;
    }
  return of_parts;
}

const RowExchange& FrameWriter::exchange(const Field& field) const {
  return field.place == Field::Place::node ? nodes_.exchange : tables_[field.table].exchange;
}

std::size_t FrameWriter::bytes(const std::vector<Field>& fields) const {
  std::size_t sum = room_for_structure;
  for (const Field& field : fields) {
    sum += static_cast<std::size_t>(exchange(field).total()) * field.row_values() * (field.precision == Precision::single_ ? 4 : 8);
  }
  return sum;
}

std::vector<double> FrameWriter::nodal_values(const Field& field) const {
  std::vector<double> local(static_cast<std::size_t>(domain_->size()) * field.components);
  field.part.source->nodal(field.variable, local);
  return held_values(local, field.components);
}

/// Of values on local nodes those that this rank writes.
std::vector<double> FrameWriter::held_values(std::span<const double> local, int components) const {
  std::vector<double> held(nodes_.nodes.size() * components);
  for (std::size_t i = 0; i < nodes_.nodes.size(); ++i) {
    std::copy_n(local.begin() + static_cast<std::ptrdiff_t>(nodes_.nodes[i]) * components, components,
                held.begin() + i * components);
  }
  return held;
}

std::vector<double> FrameWriter::element_values(const Field& field) const {
  const ResultSource& source = *field.part.source;
  const TableRows& rows = tables_[field.table];
  std::vector<double> values(rows.exchange.held() * field.row_values(), 0.0);
  double* row = values.data();
  for (std::size_t g = 0; g < rows.groups.size(); ++g) {
    const ElementGroup& group = *rows.groups[g];
    const auto components = static_cast<std::size_t>(group.output_components(field.variable));
    for (std::int32_t element = 0; element < group.size(); ++element, row += field.row_values()) {
      if (components == 0) continue;
      if (field.place == Field::Place::mean) {
        source.element_mean(rows.group_index[g], field.variable, element, {row, components});
        continue;
      }
      for (int point = 0; point < group.integration_points(); ++point)
        source.element(rows.group_index[g], field.variable, element, point,
                       {row + static_cast<std::ptrdiff_t>(point) * field.components, components});
    }
  }
  return values;
}

std::vector<bool> FrameWriter::members(const Field& field) const {
  if (field.place == Field::Place::node) {
    std::vector<bool> inside(model_->nodes.id.size(), false);
    for (const auto set : field.sets) {
      for (const auto node : model_->node_sets[set].nodes) inside[node] = true;
    }
    return inside;
  }
  const std::int32_t table = tables_[field.table].table;
  std::vector<bool> inside(model_->elements[table].size(), false);
  for (const auto set : field.sets) {
    for (const ElementRef element : model_->element_sets[set].elements) {
      if (element.table == table) inside[element.row] = true;
    }
  }
  return inside;
}

std::vector<double> FrameWriter::values(const Field& field) const {
  const bool nodal = field.place == Field::Place::node;
  std::vector<double> values = nodal ? nodal_values(field) : element_values(field);
  if (field.sets.empty()) return values;
  const std::vector<bool> inside = members(field);
  auto value = values.begin();
  const auto keep = [&](std::int32_t row) {
    if (!inside[row]) std::fill_n(value, field.row_values(), std::numeric_limits<double>::quiet_NaN());
    value += field.row_values();
  };
  if (nodal) {
    for (const std::int32_t node : nodes_.nodes) keep(domain_->node_row[node]);
  } else {
    for (const ElementGroup* group : tables_[field.table].groups) {
      for (std::int32_t element = 0; element < group->size(); ++element) keep(group->row(element));
    }
  }
  return values;
}

FrameRecord FrameWriter::write_fields(ParallelFile& file, const Hdf5Id& frame, const std::vector<Field>& fields) const {
  FrameRecord written;
  const Hdf5Id node_group = file.create_group(frame, "node"), element_group = file.create_group(frame, "element");
  Hdf5Id table_group;
  for (const Field& field : fields) {
    FieldBlock* block = &written.nodes;
    if (field.place != Field::Place::node) {
      const std::string& type = model_->elements[tables_[field.table].table].type->name;
      if (written.elements.empty() || written.elements.back().type != type) {
        written.elements.push_back({type, {}});
        table_group = file.create_group(element_group, type);
      }
      block = &written.elements.back();
    }
    const ParallelFile::Layout layout = field.layout();
    const RowExchange& rows = exchange(field);
    file.write(field.place == Field::Place::node ? node_group : table_group, field.name(), rows,
               rows.to_slab(values(field), field.row_values()), layout);
    Extent extent{static_cast<hsize_t>(rows.total())};
    extent.insert(extent.end(), layout.columns.begin(), layout.columns.end());
    block->fields.push_back({field.name(), extent, field.precision == Precision::single_ ? 4u : 8u});
  }
  sort_fields(written.nodes);
  for (FieldBlock& block : written.elements) sort_fields(block);
  return written;
}

FrameRecord FrameWriter::write(const std::string& path, const Label& label, const ResultSource& source,
                               const FrameVariables& variables) const {
  const std::vector<Field> fields = plan(source, variables);
  communicator_->together([&] {
    if (communicator_->is_root()) ensure_space(path, bytes(fields));
  });
  ParallelFile file(path, *communicator_, ParallelFile::Mode::modify);
  FrameRecord written;
  {
    const Hdf5Id frame = file.create_unnamed_group();
    file.set_attribute(frame, "time", label.time);
    file.set_attribute(frame, "step_time", label.step_time);
    file.set_attribute(frame, "increment", label.increment);
    if (label.frequency) file.set_attribute(frame, "frequency", *label.frequency);
    written = write_fields(file, frame, fields);
    file.link(frame, label.path);
  }
  file.close();
  written.path = label.path;
  written.time = label.time;
  written.increment = label.increment;
  written.frequency = label.frequency;
  return written;
}

FrameRecord FrameWriter::write(const std::string& path, const std::string& mode_path, const Mode& mode) const {
  constexpr int components = 3;
  const RowExchange& rows = nodes_.exchange;
  communicator_->together([&] {
    if (communicator_->is_root()) ensure_space(path, room_for_structure + 2 * 8 * components * rows.total());
  });
  ParallelFile file(path, *communicator_, ParallelFile::Mode::modify);
  FrameRecord written;
  {
    const Hdf5Id group = file.create_unnamed_group();
    file.set_attribute(group, "frequency", mode.frequency);
    file.set_attribute(group, "eigenvalue", mode.eigenvalue);
    file.set_attribute(group, "generalized_mass", mode.generalized_mass);
    file.set_attribute(group, "participation", mode.participation);
    file.set_attribute(group, "effective_mass", mode.effective_mass);
    const Hdf5Id nodes = file.create_group(group, "node");
    const auto write_field = [&](const std::string& name, std::span<const double> values) {
      const ParallelFile::Layout layout{{components}, Precision::double_, true};
      file.write(nodes, name, rows, rows.to_slab(held_values(values, components), components), layout);
      written.nodes.fields.push_back({name, {static_cast<hsize_t>(rows.total()), components}, 8u});
    };
    write_field("U", mode.displacement);
    write_field("UR", mode.rotation);
    file.link(group, mode_path);
  }
  file.close();
  written.path = mode_path;
  return written;
}

}  // namespace balocco
