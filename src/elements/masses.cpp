// MASS and ROTARYI: inertia at a node. They have no forces, hence no kernel; their inertia stands in Section::mass and ::inertia.
#include "elements/element_type.hpp"

namespace balocco {

namespace {

ElementType point_type(const char* name, Section::Kind section) {
  ElementType type;
  type.name = name;
  type.integration_points = 0;
  type.section = section;
  return type;
}

const RegisterElement mass(point_type("MASS", Section::Kind::mass));
const RegisterElement rotary_inertia(point_type("ROTARYI", Section::Kind::rotary_inertia));

}  // namespace

}  // namespace balocco
