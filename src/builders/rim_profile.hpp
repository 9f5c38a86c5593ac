// The rim as the inside of a tyre strikes it.
#pragma once

#include "builders/tyre_spec.hpp"
#include "model/model.hpp"

namespace balocco {

/// Whether the inside of the tyre may strike the rim: its description says how much rubber lies between.
inline bool strikes_rim(const TyreSpec& spec) { return spec.rim.pad > 0.0; }

/// mm from the axis down to which the inside of the tyre can strike: what lies further in is bead, and rests on the rim.
double strike_radius(const TyreSpec& spec);

/// Surface of revolution about the wheel's axis (y through `centre`): both flanges and the seat between them, each `pad` thicker than steel,
/// as the rubber that stays between carcass and rim. Drop centre and valve are left out: nothing comes down to them.
AnalyticalSurface rim_surface(const TyreSpec& spec, const Point& centre);

}  // namespace balocco
