#include "info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "hdf5_file.hpp"
#include "results_index.hpp"

namespace balocco {

namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

std::string names_of(const FieldBlock& block) {
  std::vector<std::string> names;
  for (const FieldRecord& field : block.fields) names.push_back(field.name);
  return joined(names);
}

/// Lines collected with a format each.
class Report {
 public:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
    text += '\n';
  }
  std::string text;
};

void describe_mesh(const Hdf5File& file, const ResultsIndex& index, Report& report) {
  report.line("nodes     {}", index.nodes);
  for (const MeshBlock& block : index.blocks) report.line("elements  {} {}", block.elements, block.type);
  for (const std::string& part : file.children("/mesh/part")) {
    const std::string path = "/mesh/part/" + part;
    report.line("part {:<4} {}: {}, material {}", part, file.text_attribute(path, "name"), file.text_attribute(path, "section"),
                file.text_attribute(path, "material"));
  }
  report.line("node sets     {}", joined(file.children("/mesh/set/node")));
  report.line("element sets  {}", joined(file.children("/mesh/set/element")));
}

void describe_history(const Hdf5File& file, const std::string& step, Report& report) {
  if (!file.exists(step + "/history")) return;
  for (const std::string& name : file.children(step + "/history")) {
    const std::string group = step + "/history/" + name;
    std::vector<std::string> variables;
    const std::string axis = history_axis(file, group);
    for (const std::string& variable : file.children(group)) {
      if (variable != axis) variables.push_back(variable);
    }
    const hsize_t rows = axis.empty() ? 0 : file.extent(group + "/" + axis)[0];
    const std::string set = file.has_attribute(group, "set") ? file.text_attribute(group, "set") : "";
    report.line("    history {:<24} {:<24} {:>7} rows  {}", name, set, rows, joined(variables));
  }
}

void describe_step(const Hdf5File& file, const ResultsIndex& index, const std::string& step, Report& report) {
  const bool completed = file.integer_attribute(step, "completed") != 0;
  report.line("{} {} ({}), time {:g} to {:g}, {}", step.substr(1), file.text_attribute(step, "name"),
              file.text_attribute(step, "procedure"), file.number_attribute(step, "time_start"),
              file.number_attribute(step, "time_end"), completed ? "completed" : "not completed");
  const FrameRecord* last = nullptr;
  int frames = 0;
  for (const FrameRecord& frame : index.frames) {
    if (!frame.path.starts_with(step + "/")) continue;
    last = &frame;
    ++frames;
  }
  report.line("    {} frames", frames);
  const auto modes = std::ranges::count_if(index.modes, [&](const auto& mode) { return mode.path.starts_with(step + "/"); });
  if (modes > 0) report.line("    {} modes", modes);
  if (last != nullptr) {
    report.line("    last frame at {} {:g}, increment {}", last->frequency ? "frequency" : "time", last->frequency.value_or(last->time),
                last->increment);
    report.line("      node  {}", names_of(last->nodes));
    for (const FieldBlock& block : last->elements) report.line("      {}  {}", block.type, names_of(block));
  }
  describe_history(file, step, report);
}

}  // namespace

std::string describe_results(const std::string& path) {
  const auto opened = open_results(path);
  const Hdf5File& file = *opened;
  const ResultsIndex index = index_results(file);
  Report report;
  const std::string heading = file.text_attribute("/", "heading");
  report.line("{}{}{}", file.text_attribute("/", "name"), heading.empty() ? "" : ": ", heading);
  report.line("written by Balocco {}, units {}", file.text_attribute("/", "code_version"),
              file.text_attribute("/", "units").empty() ? "not declared" : file.text_attribute("/", "units"));
  describe_mesh(file, index, report);
  for (const std::string& step : file.children("/")) {
    if (number_in(step, "step_") >= 0) describe_step(file, index, "/" + step, report);
  }
  return report.text;
}

}  // namespace balocco
