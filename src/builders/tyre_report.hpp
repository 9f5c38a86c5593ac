// What was built, in words and numbers: masses, dimensions, counts, stable increments.
#pragma once

#include <string>
#include <vector>

#include "builders/tyre_mesh.hpp"

namespace balocco {

struct PartMass {
  std::string part;
  double mass = 0.0;  // g
};

/// Mass of every part of the meshed tyre (rim not included), from the elements' own areas and volumes.
std::vector<PartMass> tyre_masses(const TyreSpec& spec, const TyreMesh& mesh, const Model& model);

/// Volume of a hexahedron with straight edges (2 x 2 x 2 Gauss points: exact), corners in the order of C3D8.
double hexahedron_volume(const std::vector<Point>& corners);

std::string tyre_report(const TyreSpec& spec, const TyreSection& section, const TyreMesh& mesh, const Model& model);

}  // namespace balocco
