// Inertia of rigid bodies, and how they answer to forces.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraints/rigid_body.hpp"
#include "elements/element_type.hpp"
#include "explicit_bodies.hpp"
#include "math/definite_solver.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

Matrix3<double> turned(const Matrix3<double>& rotation, const Matrix3<double>& tensor) { return rotation * tensor * transpose(rotation); }

/// Rows: directions of the six degrees of freedom.
Matrix6 directions(const Matrix3<double>& axes) {
  Matrix6 result = Matrix6::Zero();
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) result(i, c) = result(3 + i, 3 + c) = axes(i, c);
  return result;
}

}  // namespace

void RigidDynamics::sum_inertia(const Analysis& analysis) {
  constexpr std::size_t moments = 10;  // 1; x y z; xx yy zz xy xz yz
  std::vector<ExactSum> sums(moments * bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    for (const auto& [node, owned, turns, r] : bodies_[i].nodes) {
      if (!owned) continue;
      if (turns)  // half of it in each of xx, yy, zz: two of them make a moment of inertia
        for (std::size_t k = 4; k < 7; ++k) sums[moments * i + k].add(0.5 * analysis.rotary_inertia[node]);
      const double mass = analysis.nodal_mass[node];
      const std::array<double, moments> products{1.0,         r[0],        r[1],        r[2],        r[0] * r[0],
                                                 r[1] * r[1], r[2] * r[2], r[0] * r[1], r[0] * r[2], r[1] * r[2]};
      for (std::size_t k = 0; k < moments; ++k) sums[moments * i + k].add(mass * products[k]);
    }
  }
  analysis.communicator.sum(std::span<ExactSum>(sums));
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto sum = [&](std::size_t k) { return sums[moments * i + k].value(); };
    bodies_[i].mass = sum(0);
    bodies_[i].first_moment = {{sum(1), sum(2), sum(3)}};
    bodies_[i].inertia = {
        {sum(5) + sum(6), -sum(7), -sum(8), -sum(7), sum(4) + sum(6), -sum(9), -sum(8), -sum(9), sum(4) + sum(5)}};
  }
}

void RigidDynamics::add_rotary_inertia(const Analysis& analysis) {
  const Model& model = analysis.model;
  for (const auto& table : model.elements) {
    if (table.type->section != Section::Kind::rotary_inertia) continue;
    for (std::int32_t row = 0; row < table.size(); ++row) {
      const auto& given = model.sections[table.section[row]].inertia;
      for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (model.rigid_bodies[i].reference_node == table.connectivity[row])
          bodies_[i].inertia = bodies_[i].inertia + Matrix3<double>{{given[0], given[3], given[4], given[3], given[1],
                                                                     given[5], given[4], given[5], given[2]}};
    }
  }
}

void RigidDynamics::refuse_massless(const Analysis& analysis) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto mass = mass_matrix(bodies_[i], rotation_matrix(analysis.current.rigid_bodies[i]));
    for (int dof = 0; dof < 6; ++dof) {
      if (bodies_[i].condition[dof] != nullptr || mass(dof, dof) > 0.0) continue;
      const auto& body = analysis.model.rigid_bodies[i];
      throw InputError(
          fmt::format("{}: error: *RIGID BODY: degree of freedom {} of reference node {} is free in step {} but "
                      "has no {}; constrain it or give the body a {} element",
                      analysis.model.where(body.location), dof + 1, analysis.model.nodes.id[body.reference_node],
                      step_.name, dof < 3 ? "mass" : "rotary inertia", dof < 3 ? "MASS" : "ROTARYI"));
    }
  }
}

RigidDynamics::Yielding RigidDynamics::yielding(std::size_t index) const {
  const auto& body = bodies_[index];
  const auto free = [&](int first) {
    return std::any_of(&body.condition[first], &body.condition[first] + 3, [](const auto* c) { return c == nullptr; });
  };
  Yielding yielding;
  if (free(0) && body.mass > 0.0) yielding.inverse_mass = 1.0 / body.mass;
  if (free(3)) {
    // About the centre of mass, the smallest inertia there is about any point; of the directions that are free.
    const Eigen::Vector3d c =
        Eigen::Vector3d(body.first_moment[0], body.first_moment[1], body.first_moment[2]) / std::max(body.mass, 1e-300);
    Eigen::Matrix3d inertia;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        inertia(i, j) = body.inertia(i, j) - body.mass * ((i == j ? c.squaredNorm() : 0.0) - c[i] * c[j]);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (body.condition[3 + i] != nullptr || body.condition[3 + j] != nullptr) inertia(i, j) = 0.0;
    const auto moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
    for (int i = 0; i < 3; ++i)
      if (moments[i] > 0.0) yielding.inverse_inertia = std::max(yielding.inverse_inertia, 1.0 / moments[i]);
  }
  return yielding;
}

Matrix6 RigidDynamics::mass_matrix(const Body& body, const Matrix3<double>& rotation) const {
  const auto c = body.axes * (rotation * body.first_moment);
  const auto inertia = turned(body.axes, turned(rotation, body.inertia));
  Matrix6 mass = Matrix6::Zero();
  for (int i = 0; i < 3; ++i) mass(i, i) = body.mass;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) mass(3 + i, 3 + j) = inertia(i, j);
  // The moment of m a about the reference node is (m c) x a; the upper right block is the transpose.
  const double coupling[3][3] = {{0.0, -c[2], c[1]}, {c[2], 0.0, -c[0]}, {-c[1], c[0], 0.0}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) mass(3 + i, j) = mass(j, 3 + i) = coupling[i][j];
  return mass;
}

double RigidDynamics::mobility(const Analysis& analysis, std::size_t index, std::int32_t node) const {
  const double* x = &analysis.current.position[4 * node];
  const auto r = bodies_[index].axes * (Vector3<double>{{x[0], x[1], x[2]}} - Vector3<double>{analysis.current.rigid_bodies[index].position});
  Eigen::Matrix<double, 3, 6> arm;  // velocity of the node: that of the reference node + spin x r
  arm << 1, 0, 0, 0, r[2], -r[1], 0, 1, 0, -r[2], 0, r[0], 0, 0, 1, r[1], -r[0], 0;
  return mobility(analysis, index, arm);
}

double RigidDynamics::rotary_mobility(const Analysis& analysis, std::size_t index) const {
  Eigen::Matrix<double, 3, 6> spin = Eigen::Matrix<double, 3, 6>::Zero();
  spin.rightCols<3>().setIdentity();
  return mobility(analysis, index, spin);
}

/// Largest eigenvalue of arm M^-1 arm^T over the free degrees of freedom.
double RigidDynamics::mobility(const Analysis& analysis, std::size_t index, Eigen::Matrix<double, 3, 6> arm) const {
  const Body& body = bodies_[index];
  const DefiniteSolver<6> factors(reduced(body, mass_matrix(body, rotation_matrix(analysis.current.rigid_bodies[index]))));
  for (int dof = 0; dof < 6; ++dof)
    if (body.condition[dof] != nullptr) arm.col(dof).setZero();
  Eigen::Matrix3d mobility;
  for (int i = 0; i < 3; ++i) mobility.col(i) = arm * factors.solve(Vector6(arm.row(i)));
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mobility, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// Rows of prescribed degrees of freedom become identities, so that one factorisation of fixed size serves every combination.
Matrix6 RigidDynamics::reduced(const Body& body, Matrix6 mass) {
  for (int dof = 0; dof < 6; ++dof) {
    if (body.condition[dof] == nullptr) continue;
    mass.row(dof).setZero();
    mass.col(dof).setZero();
    mass(dof, dof) = 1.0;
  }
  return mass;
}

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
