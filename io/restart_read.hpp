// *RESTART, READ: a deck that goes on from the checkpoint of another job, whose steps it says again and follows with others.
#pragma once

#include <string>

#include "communicator.hpp"
#include "model/model.hpp"

namespace balocco {

/// Compares the checkpoint's place with the model's *RESTART, READ, and with END STEP ends the step there. Collective.
/// @throws InputError where the deck's steps before are not those that led there; on every rank alike.
void prepare_restart(const std::string& path, const Communicator& communicator, Model& model);

/// Ends that step again where the job's own checkpoint says that it has ended. Collective.
void resume_ended_step(const std::string& path, const Communicator& communicator, Model& model);

}  // namespace balocco
