// Where the nodes of a rank are, how they move, and the sums that element forces go to: what kernels see of the nodes.
#pragma once

namespace balocco {

/// Nodal arrays of a rank, 4 doubles a node. All but the first two exist only for nodes that turn, which are numbered first on each rank.
struct NodalMotion {
  const double* position = nullptr;          // x y z 0
  const double* velocity = nullptr;          // explicit: over the increment (half step); implicit dynamics: now; statics: null
  const double* orientation = nullptr;       // unit quaternion w x y z of the rotation from the reference configuration
  const double* angular_velocity = nullptr;  // global axes, as velocity, 0 in the fourth
  const double* rotation = nullptr;          // accumulated rotation vector UR (may exceed a turn)
  double increment = 0.0;                    // implicit: time that the increment takes, for forces that depend on rates; 0: none
  double velocity_slope = 0.0;               // implicit dynamics: derivative of each velocity by its position; 0: elsewhere
};

/// Sums that kernels SUBTRACT internal forces from; the fourth slot of each node is its rounding constant.
struct NodalForces {
  double* force = nullptr;
  double* moment = nullptr;  // nodes that turn alone
};

}  // namespace balocco
