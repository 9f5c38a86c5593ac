#include "results_frame.hpp"

#include <algorithm>
#include <optional>

#include "elements/element_type.hpp"

namespace balocco {

namespace {

using Precision = ParallelFile::Precision;

void add_names(const std::vector<std::string>& names, bool single, std::vector<FrameVariables::Variable>& variables) {
  for (const std::string& name : names) {
    const auto same = std::find_if(variables.begin(), variables.end(), [&](const auto& v) { return v.name == name; });
    if (same == variables.end()) {
      variables.push_back({name, single ? Precision::single_ : Precision::double_});
    } else if (!single) {
      same->precision = Precision::double_;
    }
  }
}

std::vector<hsize_t> columns_of(int components) {
  return components > 1 ? std::vector<hsize_t>{static_cast<hsize_t>(components)} : std::vector<hsize_t>{};
}

FieldRecord record(const std::string& name, const RowExchange& exchange, const ParallelFile::Layout& layout) {
  Extent extent{static_cast<hsize_t>(exchange.total())};
  extent.insert(extent.end(), layout.columns.begin(), layout.columns.end());
  return {name, extent, layout.precision == Precision::single_ ? 4u : 8u};
}

}  // namespace

void FrameVariables::add(const FieldOutput& output) {
  add_names(output.node_variables, output.single_precision, nodes);
  add_names(output.contact_variables, output.single_precision, nodes);
  add_names(output.element_variables, output.single_precision, elements);
  add_names(output.integration_point_variables, output.single_precision, integration_points);
}

void mean_output(const ElementGroup& group, std::string_view variable, std::int32_t element, const State& state,
                 std::size_t group_index, std::span<double> values) {
  std::array<double, 16> at_point{};
  std::fill(values.begin(), values.end(), 0.0);
  const int points = group.integration_points();
  std::vector<double> history(group.history_size());
  group.gather_history(element, state.element_history[group_index], history);
  for (int point = 0; point < points; ++point) {
    group.output(variable, element, point, state.position.data(), history,
                 std::span(at_point).first(values.size()));
    for (std::size_t c = 0; c < values.size(); ++c) values[c] += at_point[c];
  }
  for (double& value : values) value /= points;
}

FrameWriter::FrameWriter(const Model& model, const Communicator& communicator, const Domain& domain, ElementGroups groups)
    : model_(&model),
      communicator_(&communicator),
      local_nodes_(domain.size()),
      nodes_(make_node_rows(model, communicator, domain, Copies::owned)),
      tables_(make_table_rows(model, communicator, groups)) {}

FieldBlock FrameWriter::write_nodes(const Target& target, const ResultSource& source, const FrameVariables& variables) const {
  FieldBlock block;
  const Hdf5Id group = target.file.create_group(target.frame, "node");
  for (const auto& [name, precision] : variables.nodes) {
    const int components = source.nodal_components(name);
    if (components == 0) continue;
    std::vector<double> local(static_cast<std::size_t>(local_nodes_) * components);
    source.nodal(name, local);
    std::vector<double> held(nodes_.nodes.size() * components);
    for (std::size_t i = 0; i < nodes_.nodes.size(); ++i) {
      std::copy_n(local.begin() + static_cast<std::ptrdiff_t>(nodes_.nodes[i]) * components, components,
                  held.begin() + i * components);
    }
    const ParallelFile::Layout layout{columns_of(components), precision, true};
    target.file.write(group, name, nodes_.exchange, nodes_.exchange.to_slab(held, components), layout);
    block.fields.push_back(record(name, nodes_.exchange, layout));
  }
  sort_fields(block);
  return block;
}

std::vector<double> FrameWriter::element_values(const TableRows& rows, const ResultSource& source, const std::string& variable,
                                                Points points, int row_values, int columns) const {
  std::vector<double> values(rows.exchange.held() * row_values, 0.0);
  const State& state = source.state();
  std::vector<double> history;
  auto row = values.begin();
  for (std::size_t g = 0; g < rows.groups.size(); ++g) {
    const ElementGroup& group = *rows.groups[g];
    const int components = group.output_components(variable);
    for (std::int32_t element = 0; element < group.size(); ++element, row += row_values) {
      if (components == 0) continue;
      const auto size = static_cast<std::size_t>(components);
      if (points == Points::mean) {
        mean_output(group, variable, element, state, rows.group_index[g], {&*row, size});
        continue;
      }
      history.resize(group.history_size());
      group.gather_history(element, state.element_history[rows.group_index[g]], history);
      for (int point = 0; point < group.integration_points(); ++point) {
        group.output(variable, element, point, state.position.data(), history,
                     {&*row + static_cast<std::ptrdiff_t>(point) * columns, size});
      }
    }
  }
  return values;
}

FieldBlock FrameWriter::write_table(const Target& target, const TableRows& rows, const ResultSource& source,
                                    const FrameVariables& variables) const {
  FieldBlock block{model_->elements[rows.table].type->name, {}};
  std::optional<Hdf5Id> group;
  const auto write = [&](const FrameVariables::Variable& variable, Points points) {
    int components = 0, integration_points = 0;
    for (const ElementGroup* mine : rows.groups) {
      components = std::max(components, mine->output_components(variable.name));
      integration_points = std::max(integration_points, mine->integration_points());
    }
    components = static_cast<int>(communicator_->maximum(components));
    integration_points = static_cast<int>(communicator_->maximum(integration_points));
    if (components == 0) return;
    if (!group) group = target.file.create_group(target.frame, "element/" + block.type);
    const bool each = points == Points::each;
    ParallelFile::Layout layout{columns_of(components), variable.precision, true};
    if (each) layout.columns = {static_cast<hsize_t>(integration_points), static_cast<hsize_t>(components)};
    const int row_values = each ? integration_points * components : components;
    const auto values = element_values(rows, source, variable.name, points, row_values, components);
    const std::string name = each ? variable.name + "_IP" : variable.name;
    target.file.write(*group, name, rows.exchange, rows.exchange.to_slab(values, row_values), layout);
    block.fields.push_back(record(name, rows.exchange, layout));
  };
  for (const auto& variable : variables.elements) write(variable, Points::mean);
  for (const auto& variable : variables.integration_points) write(variable, Points::each);
  sort_fields(block);
  return block;
}

FrameRecord FrameWriter::write(const std::string& path, const Label& label, const ResultSource& source,
                               const FrameVariables& variables) const {
  ParallelFile file(path, *communicator_, ParallelFile::Mode::modify);
  FrameRecord written{label.path, label.time, label.increment, {}, {}};
  {
    const Hdf5Id frame = file.create_unnamed_group();
    file.set_attribute(frame, "time", label.time);
    file.set_attribute(frame, "step_time", label.step_time);
    file.set_attribute(frame, "increment", label.increment);
    const Target target{file, frame};
    written.nodes = write_nodes(target, source, variables);
    const Hdf5Id elements = file.create_group(frame, "element");
    for (const TableRows& rows : tables_) {
      FieldBlock block = write_table(target, rows, source, variables);
      if (!block.fields.empty()) written.elements.push_back(std::move(block));
    }
    file.link(frame, label.path);
  }
  file.close();
  return written;
}

}  // namespace balocco
