// *IMPORT: the last state of another job, whose model need not be the same, for the elements and nodes that the deck names.
#pragma once

#include <string>

#include "communicator.hpp"
#include "domain.hpp"
#include "hdf5_model_rows.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace balocco {

/// Puts what `model.state_import` names into `state` (sized for this domain, as an analysis starts): places, velocities and work of
/// nodes, histories of elements, contact of imported slave nodes, multipliers of constraints that both models have. Rigid bodies with
/// the same reference node go on with their motion and their nodes; others, as those of copies, carry their nodes from where these are now.
/// With UPDATE=YES, where the model stands as the other job has left it: velocities and rigid bodies alone. Collective.
/// @return what was imported, for the log. @throws InputError that names the first member that differs, SystemError.
std::string import_state(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain,
                         ElementGroups groups, State& state);

}  // namespace balocco
