// Where the master body of a contact pair is.
#pragma once

#include "constraints/rigid_body.hpp"
#include "math/tensor.hpp"
#include "model/state.hpp"

namespace balocco {

/// What turns a place in space into one in the frame of the master body, and forces back.
struct MasterFrame {
  Vector3<double> position;
  Matrix3<double> rotation, inverse;

  explicit MasterFrame(const RigidBodyState& master)
      : position{master.position}, rotation(rotation_matrix(master)), inverse(transpose(rotation)) {}

  Vector3<double> arm(const double* x) const { return Vector3<double>{x[0], x[1], x[2]} - position; }
};

}  // namespace balocco
