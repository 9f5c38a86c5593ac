// Rigid bodies as linkages see them.
#include "constraints/rigid_body.hpp"
#include "explicit_bodies.hpp"
#include "math/definite_solver.hpp"

namespace balocco {

namespace {

/// Rows: directions of the six degrees of freedom.
Matrix6 directions(const Matrix3<double>& axes) {
  Matrix6 result = Matrix6::Zero();
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) result(i, c) = result(3 + i, 3 + c) = axes(i, c);
  return result;
}

}  // namespace

Matrix6 RigidDynamics::response(const Analysis& analysis, std::size_t index) const {
  const Body& body = bodies_[index];
  const DefiniteSolver<6> factors(reduced(body, mass_matrix(body, rotation_matrix(analysis.current.rigid_bodies[index]))));
  Matrix6 inverse = Matrix6::Zero();
  for (int dof = 0; dof < 6; ++dof)
    if (body.condition[dof] == nullptr) inverse.col(dof) = factors.solve(Vector6(Vector6::Unit(dof)));
  const Matrix6 axes = directions(body.axes);
  return axes.transpose() * inverse * axes;
}

Vector6 RigidDynamics::predicted_velocity(const Analysis& analysis, std::size_t index, const Instant& instant, const Vector6& more) const {
  const Body& body = bodies_[index];
  const auto now = motion(analysis, body, index);
  const Vector6 wanted = prescribed(analysis, body, now, instant);
  const Matrix6 axes = directions(body.axes);
  const auto response = solve(analysis.current.rigid_bodies[index], body, body.force + axes * more, now.velocity, instant, wanted);
  return axes.transpose() * new_velocity(body, now.velocity, response, instant, wanted);
}

void RigidDynamics::add_force(std::size_t index, const Vector6& force) { bodies_[index].force += directions(bodies_[index].axes) * force; }

Vector6 RigidDynamics::force(std::size_t index) const { return directions(bodies_[index].axes).transpose() * bodies_[index].force; }

Vector6 RigidDynamics::velocity(const Analysis& analysis, std::size_t index) {
  const auto& state = analysis.current.rigid_bodies[index];
  Vector6 velocity;
  for (int c = 0; c < 3; ++c) {
    velocity[c] = state.velocity[c];
    velocity[3 + c] = state.angular_velocity[c];
  }
  return velocity;
}

void RigidDynamics::set_velocity(Analysis& analysis, std::size_t index, const Vector6& velocity) const {
  auto& state = analysis.current.rigid_bodies[index];
  for (int c = 0; c < 3; ++c) {
    state.velocity[c] = velocity[c];
    state.angular_velocity[c] = velocity[3 + c];
  }
  set_node_velocities(analysis, index, 0.0);
}

}  // namespace balocco
