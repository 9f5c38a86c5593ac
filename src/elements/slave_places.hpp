// Places of a slave surface that a deformable master keeps off: its nodes, or points of its faces.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace balocco {

/// A place that moves with nodes. What belongs to it is kept where the first of them is.
struct SlavePlace {
  std::vector<std::int32_t> nodes;  // model rows
  std::vector<double> weights;      // of their positions
  double area = 0.0;                // undeformed, that it stands for; of node-based surfaces 1
};

/// In deck order, the same on every rank: the nodes by row, or the places of the quadratures of the faces (face_stations).
std::vector<SlavePlace> slave_places(const Model& model, const ContactPair& pair);

/// Model row of the first node of each place of any pair: with a rigid master the slave's nodes are the places.
std::vector<std::int32_t> homes_of_places(const Model& model, const ContactPair& pair);

}  // namespace balocco
