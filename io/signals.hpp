// What a running job is asked from outside: by signals to any rank, or by words in the file JOB.ctl.
#pragma once

#include <string>

#include "communicator.hpp"

namespace balocco {

struct Requests {
  bool stop = false;        // checkpoint and leave: SIGTERM, SIGINT, SIGUSR1, "stop"
  bool checkpoint = false;  // "checkpoint"
  bool frame = false;       // SIGUSR2, "frame"
  bool info = false;        // "info"
};

/// From now on the signals above only raise flags. A second SIGINT ends the process at once.
void install_signal_handlers();

/// What any rank has been asked by signal since the last call, and root by the words of `control_file` (which is then removed).
/// Collective.
Requests take_requests(const Communicator& communicator, const std::string& control_file);

}  // namespace balocco
