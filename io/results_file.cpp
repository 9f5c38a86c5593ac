#include "results_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "elements/element_type.hpp"
#include "model/diagnostics.hpp"
#include "results_mesh.hpp"
#include "xdmf.hpp"

namespace balocco {

namespace {

ResultsIndex index_of(const Model& model) {
  ResultsIndex index;
  index.nodes = static_cast<hsize_t>(model.nodes.size());
  for (const ElementTable& table : model.elements) {
    if (table.size() == 0) continue;
    index.blocks.push_back({table.type->name, static_cast<hsize_t>(table.size()), static_cast<hsize_t>(table.type->nodes)});
  }
  return index;
}

}  // namespace

ResultsFile::ResultsFile(const Model& model, const Communicator& communicator, std::string path, std::string xdmf_path)
    : model_(&model),
      communicator_(&communicator),
      path_(std::move(path)),
      xdmf_path_(std::move(xdmf_path)),
      index_(index_of(model)) {}

void ResultsFile::create() {
  communicator_->together([&] {
    if (!communicator_->is_root()) return;
    Hdf5File file(path_, Hdf5File::Mode::create);
    write_mesh(file, *model_);
    file.close();
  });
}

void ResultsFile::resume(const State& state) {
  int there = std::filesystem::exists(path_) ? 1 : 0;
  MPI_Bcast(&there, 1, MPI_INT, 0, communicator_->handle());
  if (there == 0) return create();
  communicator_->together([&] {
    if (communicator_->is_root()) cut_back(state);
  });
  // Root has closed the file: all ranks read the same.
  communicator_->together([&] { index_ = index_results(Hdf5File(path_, Hdf5File::Mode::read)); });
}

void ResultsFile::cut_back(const State& state) {
  Hdf5File file(path_, Hdf5File::Mode::modify);
  const bool ours = file.has_attribute("/", "deck_sha256") && file.text_attribute("/", "deck_sha256") == model_->deck_sha256;
  if (!ours) {
    throw InputError(fmt::format("{}: error: these results belong to another deck than the checkpoint; move them away", path_));
  }
  for (const std::string& name : file.children("/")) {
    const std::int64_t number = number_in(name, "step_");
    const bool later = number > state.step + 1 || (number == state.step + 1 && state.increment == 0);
    if (later) file.remove("/" + name);
  }
  const std::string step = step_path(state.step);
  if (file.exists(step)) {
    for (const std::string& name : file.children(step)) {
      const std::string frame = step + "/" + name;
      if (number_in(name, "frame_") < 0) continue;
      const bool later = file.number_attribute(frame, "time") > state.total_time ||
                         file.integer_attribute(frame, "increment") > state.increment;
      if (later) file.remove(frame);
    }
    cut_history(file, state.step, state.total_time);
  }
  file.close();
}

void ResultsFile::start_step(std::int32_t step, double total_time) {
  step_ = step;
  const std::string prefix = step_path(step) + "/";
  frames_in_step_ = std::count_if(index_.frames.begin(), index_.frames.end(),
                                  [&](const FrameRecord& frame) { return frame.path.starts_with(prefix); });
  communicator_->together([&] {
    if (!communicator_->is_root()) return;
    Hdf5File file(path_, Hdf5File::Mode::modify);
    const std::string group = step_path(step);
    if (!file.exists(group)) {
      file.create_group(group);
      file.set_attribute(group, "name", model_->steps[step].name);
      file.set_attribute(group, "procedure", std::string(model_->steps[step].procedure_name()));
      file.set_attribute(group, "time_start", total_time);
    }
    file.set_attribute(group, "time_end", total_time);
    file.set_attribute(group, "completed", std::int64_t{0});
    file.close();
  });
}

void ResultsFile::finish_step(std::int32_t step, double total_time) {
  communicator_->together([&] {
    if (!communicator_->is_root()) return;
    Hdf5File file(path_, Hdf5File::Mode::modify);
    file.set_attribute(step_path(step), "time_end", total_time);
    file.set_attribute(step_path(step), "completed", std::int64_t{1});
    file.close();
  });
}

void ResultsFile::add_frame(const FrameWriter& writer, const FrameVariables& variables, const ResultSource& source,
                            const Progress& progress, History& history) {
  add_history(history);
  FrameWriter::Label label{frame_path(step_, frames_in_step_), progress.total_time, progress.step_time, progress.increment};
  if (model_->steps[step_].is_harmonic()) label.frequency = progress.frequency;
  index_.frames.push_back(writer.write(path_, label, source, variables));
  ++frames_in_step_;
  write_xdmf();
}

void ResultsFile::add_mode(const FrameWriter& writer, const Mode& mode) {
  index_.modes.push_back(writer.write(path_, mode_path(step_, mode.number), mode));
  index_.modes.back().time = static_cast<double>(index_.modes.size());
  communicator_->together([&] {
    if (!communicator_->is_root()) return;
    const auto text = modes_xdmf_text(index_, std::filesystem::path(path_).filename().string());
    replace_file(std::filesystem::path(xdmf_path_).replace_extension(".modes.xdmf").string(), text);
  });
}

void ResultsFile::add_history(History& history) {
  communicator_->together([&] {
    if (!communicator_->is_root() || !history.buffered()) return;
    Hdf5File file(path_, Hdf5File::Mode::modify);
    history.flush(file);
    file.close();
  });
}

void ResultsFile::synchronize_with_disk() {
  communicator_->together([&] {
    if (communicator_->is_root()) synchronize(path_);
  });
}

bool ResultsFile::shows(std::int32_t step, double total_time) const {
  return !index_.frames.empty() && index_.frames.back().time == total_time &&
         index_.frames.back().path.starts_with(step_path(step) + "/");
}

void ResultsFile::write_xdmf() const {
  communicator_->together([&] {
    if (!communicator_->is_root()) return;
    const auto results = std::filesystem::path(path_).filename().string();
    if (!model_->steps[step_].is_harmonic()) return replace_file(xdmf_path_, xdmf_text(index_, results));
    const auto own = std::filesystem::path(xdmf_path_).replace_extension(fmt::format(".step_{}.xdmf", step_ + 1));
    replace_file(own.string(), harmonic_xdmf_text(index_, step_, results));
  });
}

}  // namespace balocco
