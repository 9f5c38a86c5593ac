// The tables of *CONTACT PRINT in JOB.dat, laid out as CalculiX does.
#pragma once

#include <string>

#include "communicator.hpp"
#include "model/results.hpp"

namespace balocco {

/// On root; of the closed places of all pairs with deformable masters. Collective.
std::string contact_tables(const Model& model, const Communicator& communicator, const ResultSource& source, const PrintOutput& output,
                           double time);

}  // namespace balocco
