// What the slave side of a contact pair brings along: its nodes with their share of area and their penalty stiffness.
#pragma once

#include <vector>

#include "model/model.hpp"
#include "master_surface.hpp"

namespace balocco {

/// Nodes of a slave surface, sorted by model row. Computed from the whole model in deck order: the same bits on every
/// rank.
struct SlaveNodes {
  std::vector<std::int32_t> rows;
  std::vector<double> area;       // undeformed; 1 for node-based surfaces
  std::vector<double> stiffness;  // force per length
};

/// Each face gives every one of its n nodes the share a = A / n of its area A and the stiffness
///   k = M a / (2 h),
/// half of what the layer of elements behind the face has itself against compression through its thickness h. Under a
/// pressure p the penetration is then 2 h p / M: 0.05 mm for 8 mm of rubber of M = 100 MPa under 0.3 MPa. A spring of s
/// = 1/2 of the outermost layer raises its highest frequency by 3 % (a bar of lumped masses: by sqrt((1 + sqrt(1 +
/// s^2)) / 2)).
///   solids: M = volumetric + 2 shear modulus of the law at rest (K + 4/3 G), h = element volume / A;
///   membranes: M = twice the plane law's modulus, h = A / thickness: in-plane stiffness, since a membrane has no
///   other.
/// Node-based surfaces: every element at a node gives it M V^(1/3) / 8 (solids), M t / 8 (membranes), M (section) / (2
/// length) (trusses).
/// @throws InputError where there are no faces or nodes, or a node has no element with a material law.
SlaveNodes slave_nodes(const Model& model, const ContactPair& pair);

/// True if there are faces and not one of them looks towards `master` at the reference.
bool faces_away(const Model& model, const Surface& slave, const MasterSurface& master, const Point& master_reference);

/// The same for a master of element faces: true if the slave has faces, all of solids, that look in the direction of the nearest of the
/// master's.
bool faces_away(const Model& model, const Surface& slave, const Surface& master);

}  // namespace balocco
