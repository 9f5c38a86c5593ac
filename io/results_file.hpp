// JOB.h5 and JOB.xdmf as a run grows them: mesh once, steps, frames; and cutting them back to a checkpoint.
#pragma once

#include <cstdint>
#include <string>

#include "communicator.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "results_frame.hpp"
#include "results_history.hpp"
#include "results_index.hpp"

namespace balocco {

/// Every function is collective and throws SystemError on every rank alike.
class ResultsFile {
 public:
  ResultsFile(const Model& model, const Communicator& communicator, std::string path, std::string xdmf_path);

  /// A new file with the mesh, in place of any that is there.
  void create();
  /// Continues the file that is there from the given state: what is later is removed. A missing file is created.
  /// @throws InputError if it belongs to another deck.
  void resume(const State& state);

  void start_step(std::int32_t step, double total_time);
  void finish_step(std::int32_t step, double total_time);

  /// Adds a frame and what the histories have buffered, and describes it in the XDMF; of harmonic steps in JOB.step_<k>.xdmf.
  void add_frame(const FrameWriter& writer, const FrameVariables& variables, const ResultSource& source,
                 const Progress& progress, History& history);
  /// Adds a mode, and describes all in JOB.modes.xdmf.
  void add_mode(const FrameWriter& writer, const Mode& mode);
  void add_history(History& history);
  /// Through to the disk.
  void synchronize_with_disk();

  /// True if the last frame shows this instant already.
  bool shows(std::int32_t step, double total_time) const;

 private:
  void cut_back(const State& state);
  void write_xdmf() const;

  const Model* model_;
  const Communicator* communicator_;
  std::string path_, xdmf_path_;
  ResultsIndex index_;
  std::int32_t step_ = 0;
  std::int64_t frames_in_step_ = 0;
};

}  // namespace balocco
