// *IMPORT, STATE=YES, UPDATE=YES.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// Lets the sections of imported elements have stresses in their new reference configuration; refuses elements whose stress asks for the
/// deformation that led there.
void keep_updated_stresses(Builder& builder);

}  // namespace balocco::deck
