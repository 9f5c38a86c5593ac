// Checkpoints that a job keeps beside its last one (*RESTART, WRITE without OVERLAY): JOB.step2.increment1500.ckpt.h5.
#pragma once

#include <cstdint>
#include <string>

#include "model/model.hpp"

namespace balocco {

/// Keeps the checkpoint that stands at `path`, which later ones replace; takes no room while it is the last one. For one rank.
/// @throws SystemError
void keep_checkpoint(const std::string& path, std::int32_t step_number, std::int64_t increment);

/// Removes what an earlier run of a job has kept. For one rank. @throws SystemError
void forget_kept_checkpoints(const std::string& path);

/// The checkpoint that *IMPORT or *RESTART, READ chooses among that of `path` and those kept beside it; `path` where they do not choose, or
/// what they ask for is not kept and may stand there. @throws InputError that names what is kept.
std::string chosen_checkpoint(const std::string& path, const Model& model);

}  // namespace balocco
