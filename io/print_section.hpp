// *SECTION PRINT: what a surface transmits, from the forces on the nodes of the elements behind it.
#pragma once

#include <string>

#include "communicator.hpp"
#include "domain.hpp"
#include "model/results.hpp"

namespace balocco {

/// Force and moment that act from outside on the elements whose faces make the surface, its area, centre and mean
/// normal, as CalculiX prints them; in the reference configuration of linear steps. Empty but on root. Collective.
std::string section_table(const Model& model, const Communicator& communicator, const Domain& domain,
                          const ResultSource& source, const PrintOutput& output, double time);

}  // namespace balocco
