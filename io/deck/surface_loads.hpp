// The lines of *DLOAD and *DSLOAD that act on faces or edges: P, TRVEC, TRSHR, EDLD, EDNOR, EDSHR, EDTRA.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "deck/builder.hpp"
#include "model/step.hpp"

namespace balocco::deck {

std::optional<SurfaceLoad::Kind> surface_load_kind(std::string_view label);

/// The labels, for a message.
std::string surface_load_labels();

/// Reads magnitude and direction of a line of a load on `surface` into the step. Such a line takes the place of an earlier one of the
/// same kind and direction; those of earlier steps in other directions go.
void read_surface_load_line(Builder& builder, const Block& block, Row& row, SurfaceLoad::Kind kind, std::int32_t surface,
                            std::int32_t amplitude);

/// Keyword parameters and data line, from the label on, as they are read.
std::string surface_load_parameters(const SurfaceLoad& load);
std::string surface_load_text(const SurfaceLoad& load);

}  // namespace balocco::deck
