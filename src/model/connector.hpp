// *CONNECTOR SECTION with its behaviour: what a connector of two nodes holds, and what resists the relative motions that it leaves.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/constraint.hpp"

namespace balocco {

/// What acts on one component of relative motion (1-3 translations, 4-6 rotations in radians).
struct ConnectorComponent {
  struct Curve {
    double slope = 0.0;                        // a straight line through the origin, where `table` is empty
    std::vector<std::array<double, 2>> table;  // (relative motion or velocity, force), rising in the first; constant beyond its ends
  };
  std::optional<Curve> elasticity, damping;
  std::optional<double> reference;             // *CONNECTOR CONSTITUTIVE REFERENCE: the length or angle without force; none: as at the start
  std::optional<Guide::Row> guide;             // *CONNECTOR STOP, LOCK, FRICTION
};

struct Connector : RelativeMotionKind {
  std::string type;                            // "HINGE", "BUSHING" ...
  std::vector<Joint::Piece> pieces;            // what it holds
  std::array<bool, 6> available{};             // components of relative motion that it leaves
  std::array<ConnectorComponent, 6> component;
  std::vector<double> coupled_elasticity, coupled_damping;  // 6 x 6 symmetric, upper triangle column by column; empty: none
  std::array<std::int32_t, 2> orientation{-1, -1};          // rows of Model::orientations of the nodes' frames; -1: global axes
};

}  // namespace balocco
