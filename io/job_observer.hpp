// What a running job leaves behind: results, status, log and checkpoints, each at its time, and what it is asked meanwhile.
#pragma once

#include <memory>
#include <string>

#include "communicator.hpp"
#include "domain.hpp"
#include "model/model.hpp"
#include "model/results.hpp"

namespace balocco {

/// The files of a job, all DIRECTORY/NAME.<something>.
struct JobPaths {
  std::string directory, name;

  std::string file(const std::string& extension) const { return directory + "/" + name + extension; }
  std::string results() const { return file(".h5"); }
  std::string xdmf() const { return file(".xdmf"); }
  std::string status() const { return file(".sta"); }
  std::string log() const { return file(".log"); }
  std::string tables() const { return file(".dat"); }
  std::string checkpoint() const { return file(".ckpt.h5"); }
  std::string control() const { return file(".ctl"); }
};

/// Writes the files of a job. Every function is collective and throws SystemError on every rank alike when a file cannot be
/// written. Call install_signal_handlers() (signals.hpp) once before the analysis starts.
class JobObserver : public Observer {
 public:
  /// Creates the files (the directory too); when `restarted`, continues those that are there: whatever is later than the state
  /// which the first step_started() shows is cut off then.
  JobObserver(const Model& model, const Communicator& communicator, const Domain& domain, JobPaths paths, bool restarted);
  ~JobObserver() override;

  void step_started(const ResultSource& source, std::int32_t step) override;
  bool advanced(const ResultSource& source, const Progress& progress) override;
  double next_due() const override;
  void mode_found(const Mode& mode) override;
  void log(const std::string& line) override;

  /// Writes what is still buffered and the last lines of status and log. After a failed analysis (neither completed nor stopped)
  /// a last frame shows where it failed; the source of the last step must then still live.
  void finish(bool completed, const std::string& reason);

  /// True once advanced() has returned false: a signal or JOB.ctl asked to stop, and a checkpoint has been written.
  bool stopped_on_request() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace balocco
