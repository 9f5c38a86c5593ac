// Checkpoints: all of State in double precision and deck order, so that a run continues bit for bit on any number of ranks.
#pragma once

#include <string>

#include "communicator.hpp"
#include "domain.hpp"
#include "hdf5_model_rows.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace balocco {

/// Writes `path` beside itself and renames it, so that a kill at any instant leaves the last whole checkpoint. When
/// `step_finished`, it stands at the start of the next step (step + 1, step_time 0, increment 0). Collective.
/// @throws SystemError on every rank alike.
void write_checkpoint(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain,
                      ElementGroups groups, const State& state, bool step_finished = false);

/// Replaces `state` (sized for this domain, as an analysis starts) by the stored one. Rigid bodies come with their nodes: an
/// analysis has to index them anew. `state.step` may be behind the last step: then nothing is left to do. Collective.
/// @throws InputError if the checkpoint belongs to another deck, SystemError if it cannot be read; on every rank alike.
void read_checkpoint(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain,
                     ElementGroups groups, State& state);

/// The same where *RESTART, READ says that the deck is another one with the same model, which begins with the steps of the first.
/// @throws InputError that names the first part of the model that differs.
void read_checkpoint_of_other_deck(const std::string& path, const Model& model, const Communicator& communicator,
                                   const Domain& domain, ElementGroups groups, State& state);

/// The same from the checkpoint of another job with the same model but other steps: `state` stands at the start of this deck's
/// first step, at time zero, and masses count as the model has them. @throws InputError that names the first part of the model that
/// differs.
void import_checkpoint(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain,
                       ElementGroups groups, State& state);

}  // namespace balocco
