#include "results_index.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/diagnostics.hpp"

namespace balocco {

namespace {

FieldBlock index_block(const Hdf5File& file, const std::string& group, const std::string& type) {
  FieldBlock block{type, {}};
  for (const std::string& name : file.children(group)) {
    const std::string path = group + "/" + name;
    block.fields.push_back({name, file.extent(path), file.bytes_per_value(path)});
  }
  sort_fields(block);
  return block;
}

FrameRecord index_fields(const Hdf5File& file, const std::string& path) {
  FrameRecord frame;
  frame.path = path;
  if (file.exists(path + "/node")) frame.nodes = index_block(file, path + "/node", "");
  if (file.exists(path + "/element")) {
    for (const std::string& type : file.children(path + "/element")) {
      frame.elements.push_back(index_block(file, path + "/element/" + type, type));
    }
  }
  return frame;
}

FrameRecord index_frame(const Hdf5File& file, const std::string& path) {
  auto frame = index_fields(file, path);
  frame.time = file.number_attribute(path, "time");
  frame.increment = file.integer_attribute(path, "increment");
  if (file.has_attribute(path, "frequency")) frame.frequency = file.number_attribute(path, "frequency");
  return frame;
}

}  // namespace

void sort_fields(FieldBlock& block) {
  std::sort(block.fields.begin(), block.fields.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
}

std::string step_path(std::int32_t step) { return fmt::format("/step_{}", step + 1); }

std::string frame_path(std::int32_t step, std::int64_t frame) { return fmt::format("{}/frame_{}", step_path(step), frame); }

std::string mode_path(std::int32_t step, std::int32_t mode) { return fmt::format("{}/mode_{}", step_path(step), mode); }

std::string history_axis(const Step& step) { return step.is_harmonic() ? "frequency" : "time"; }

std::string history_axis(const Hdf5File& file, const std::string& group) {
  for (const char* axis : {"time", "frequency"})
    if (file.exists(group + "/" + axis)) return axis;
  return "";
}

std::string hdf5_name(std::string name) {
  std::replace(name.begin(), name.end(), '/', '|');
  return name;
}

std::int64_t number_in(const std::string& name, const std::string& prefix) {
  const bool fits = name.size() > prefix.size() && name.starts_with(prefix) &&
                    name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
  return fits ? std::stoll(name.substr(prefix.size())) : -1;
}

std::unique_ptr<Hdf5File> open_results(const std::string& path) {
  auto file = open_existing(path);
  const std::string format = file->has_attribute("/", "format") ? file->text_attribute("/", "format") : "";
  if (format == "balocco") return file;
  throw InputError(fmt::format("{}: error: {}; give the results file JOB.h5", path,
                               format == "balocco checkpoint" ? "this is a checkpoint" : "not a results file of Balocco"));
}

ResultsIndex index_results(const Hdf5File& file) {
  ResultsIndex index;
  index.nodes = file.extent("/mesh/node/id")[0];
  for (const std::string& type : file.children("/mesh/element")) {
    const Extent connectivity = file.extent("/mesh/element/" + type + "/connectivity");
    index.blocks.push_back({type, connectivity[0], connectivity[1]});
  }
  for (const std::string& step : file.children("/")) {
    if (number_in(step, "step_") < 0) continue;
    for (const std::string& frame : file.children("/" + step)) {
      const std::string path = "/" + step + "/" + frame;
      if (number_in(frame, "frame_") >= 0) index.frames.push_back(index_frame(file, path));
      if (number_in(frame, "mode_") >= 0) {
        index.modes.push_back(index_fields(file, path));
        index.modes.back().time = static_cast<double>(index.modes.size());
      }
    }
  }
  return index;
}

}  // namespace balocco
