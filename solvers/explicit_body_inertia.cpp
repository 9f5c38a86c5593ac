// Inertia of rigid bodies, and how they answer to forces.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "constraints/rigid_body.hpp"
#include "elements/element_type.hpp"
#include "explicit_bodies.hpp"
#include "math/definite_solver.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

/// Of forces at the reference node by its motion; the moment of m a about it is (m c) x a.
Matrix6 mass_matrix(double mass, const Vector3<double>& first_moment, const Matrix3<double>& rotary) {
  const auto& c = first_moment;
  const Matrix3<double> coupling{0.0, -c[2], c[1], c[2], 0.0, -c[0], -c[1], c[0], 0.0};
  Matrix6 matrix;
  for (int i = 0; i < 3; ++i) matrix(i, i) = mass;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      matrix(3 + i, 3 + j) = rotary(i, j);
      matrix(3 + i, j) = matrix(j, 3 + i) = coupling(i, j);
    }
  return matrix;
}

Matrix6 inverse_of(const Matrix6& matrix) {
  const DefiniteSolver<6> factors(matrix);
  Matrix6 inverse;
  for (int j = 0; j < 6; ++j) {
    Vector6 unit;
    unit[j] = 1.0;
    const auto column = factors.solve(unit);
    for (int i = 0; i < 6; ++i) inverse(i, j) = column[i];
  }
  return inverse;
}

/// The block of a matrix that begins with a row and a column, times a vector.
Vector3<double> block_product(const Matrix6& matrix, std::size_t row, std::size_t column, const Vector3<double>& vector) {
  Vector3<double> product;
  for (std::size_t i = 0; i < 3; ++i)
    product[static_cast<int>(i)] =
        matrix(row + i, column) * vector[0] + matrix(row + i, column + 1) * vector[1] + matrix(row + i, column + 2) * vector[2];
  return product;
}

/// As turned(), where masses answer alike in all directions and only rotations turn.
Matrix6 turned_about_centre(const Matrix3<double>& q, const Matrix6& a) {
  Matrix6 result = a;
  Matrix3<double> rotary;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotary(i, j) = a(3 + i, 3 + j);
  rotary = q * rotary * transpose(q);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result(3 + i, 3 + j) = rotary(i, j);
  return result;
}

}  // namespace

void RigidDynamics::sum_inertia(const Analysis& analysis) {
  constexpr std::size_t moments = 10;  // 1; x y z; xx yy zz xy xz yz
  std::vector<ExactSum> sums(moments * bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    for (const auto& [node, owned, turns, oriented, r] : bodies_[i].nodes) {
      if (!owned) continue;
      if (turns)  // half of it in each of xx, yy, zz: two of them make a moment of inertia
        for (std::size_t k = 4; k < 7; ++k) sums[moments * i + k].add(0.5 * analysis.scaled_inertia().rotary[node]);
      const double mass = analysis.scaled_inertia().mass[node];
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

/// Of *ROTARY INERTIA on the reference node, or on nodes that turn with the body.
void RigidDynamics::add_rotary_inertia(const Analysis& analysis) {
  const Model& model = analysis.model;
  const auto turns_with = [&](std::int32_t node, std::size_t body) {
    const auto& nodes = analysis.current.rigid_bodies[body].nodes;
    const auto found = std::ranges::lower_bound(nodes, node, {}, &RigidNode::node);
    return model.rigid_bodies[body].reference_node == node || (found != nodes.end() && found->node == node && found->tie);
  };
  for (const auto& table : model.elements) {
    if (table.type->section != Section::Kind::rotary_inertia) continue;
    for (std::int32_t row = 0; row < table.size(); ++row) {
      const auto& given = model.sections[table.section[row]].inertia;
      for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (turns_with(table.connectivity[row], i))
          bodies_[i].inertia = bodies_[i].inertia + Matrix3<double>{{given[0], given[3], given[4], given[3], given[1],
                                                                     given[5], given[4], given[5], given[2]}};
    }
  }
}

void RigidDynamics::refuse_massless(const Analysis& analysis) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto turn = bodies_[i].axes * rotation_matrix(analysis.current.rigid_bodies[i]);
    const auto rotary = turn * bodies_[i].inertia * transpose(turn);
    for (int dof = 0; dof < 6; ++dof) {
      if (bodies_[i].condition[dof] != nullptr || (dof < 3 ? bodies_[i].mass : rotary(dof - 3, dof - 3)) > 0.0) continue;
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

void RigidDynamics::invert_free(Body& body) const {
  body.is_centred = body.first_moment.component == Point{};
  body.free_inverse = inverse_of(mass_matrix(body.mass, body.first_moment, body.inertia));
}

/// Rows of prescribed degrees of freedom become identities, so that one factorisation of fixed size serves every combination.
Matrix6 RigidDynamics::inverse(const Body& body, const Inertia& inertia) {
  auto matrix = mass_matrix(body.mass, inertia.first_moment, inertia.rotary);
  const auto clear = [&](Matrix6& of, double diagonal) {
    for (int dof = 0; dof < 6; ++dof) {
      if (body.condition[dof] == nullptr) continue;
      for (int i = 0; i < 6; ++i) of(dof, i) = of(i, dof) = 0.0;
      of(dof, dof) = diagonal;
    }
  };
  clear(matrix, 1.0);
  auto result = inverse_of(matrix);
  clear(result, 0.0);
  return result;
}

const RigidDynamics::Inertia& RigidDynamics::inertia(const Body& body, const RigidBodyState& state) const {
  auto& now = body.inertia_now;
  if (now.orientation == state.orientation) return now;
  now.orientation = state.orientation;
  const auto turn = body.axes * rotation_matrix(state);
  now.first_moment = turn * body.first_moment;
  now.rotary = turn * body.inertia * transpose(turn);
  if (body.is_free)
    now.inverse = body.is_centred ? turned_about_centre(turn, body.free_inverse) : turned(turn, body.free_inverse);
  else
    now.inverse = inverse(body, now);
  return now;
}

RigidDynamics::Response RigidDynamics::solve(const RigidBodyState& state, const Body& body, const Vector6& force, const Vector6& old_velocity,
                                             const Instant& instant, const Vector6& wanted) const {
  const auto& inertia = this->inertia(body, state);
  const auto& c = inertia.first_moment;
  const auto times_mass = [&](const Vector6& a) {
    const auto linear = a.translation(), angular = a.rotation();
    return pair_of(body.mass * linear + cross(angular, c), cross(c, linear) + inertia.rotary * angular);
  };
  Vector6 known, load;
  for (int dof = 0; dof < 6; ++dof)
    if (body.condition[dof] != nullptr) known[dof] = (wanted[dof] - old_velocity[dof]) / instant.average();
  const auto held = times_mass(known);
  Response response;
  auto spin = old_velocity.rotation();
  // Gyroscopic terms belong to the spin at the instant, which depends on the acceleration sought: three corrections
  // take the error to (spin x increment)^4, below rounding for any increment that resolves the motion.
  for (int correction = 0; correction < 3; ++correction) {
    load = force - pair_of(cross(spin, cross(spin, c)), cross(spin, inertia.rotary * spin));
    response.acceleration = inertia.inverse * (load - held) + known;
    spin = old_velocity.rotation() + 0.5 * instant.previous * response.acceleration.rotation();
  }
  response.spin = transpose(body.axes) * spin;
  const auto reaction = times_mass(response.acceleration) - load;
  for (int dof = 0; dof < 6; ++dof)
    if (body.condition[dof] != nullptr) response.reaction[dof] = reaction[dof];
  return response;
}

/// As solve(); corrections ask for the angular acceleration alone.
RigidDynamics::Response RigidDynamics::solve_free(const RigidBodyState& state, const Body& body, const Vector6& force, const Vector6& old_velocity,
                                                  const Instant& instant) const {
  const auto& [orientation, first_moment, rotary, inverse] = inertia(body, state);
  auto linear_load = force.translation();
  Vector3<double> angular_load, angular;
  Response response;
  response.spin = old_velocity.rotation();
  for (int correction = 0; correction < 3; ++correction) {
    const auto& spin = response.spin;
    angular_load = force.rotation() - cross(spin, rotary * spin);
    angular = block_product(inverse, 3, 3, angular_load);
    if (!body.is_centred) {
      linear_load = force.translation() - cross(spin, cross(spin, first_moment));
      angular = angular + block_product(inverse, 3, 0, linear_load);
    }
    response.spin = old_velocity.rotation() + 0.5 * instant.previous * angular;
  }
  auto linear = block_product(inverse, 0, 0, linear_load);
  if (!body.is_centred) linear = linear + block_product(inverse, 0, 3, angular_load);
  response.acceleration = pair_of(linear, angular);
  return response;
}

double RigidDynamics::mobility(const Analysis& analysis, std::size_t index, std::int32_t node) const {
  const double* x = &analysis.current.position[4 * node];
  const auto r = bodies_[index].axes * (Vector3<double>{{x[0], x[1], x[2]}} - Vector3<double>{analysis.current.rigid_bodies[index].position});
  // The velocity of the node is that of the reference node + spin x r.
  return mobility(analysis, index, {{{1, 0, 0, 0, r[2], -r[1]}, {0, 1, 0, -r[2], 0, r[0]}, {0, 0, 1, r[1], -r[0], 0}}});
}

double RigidDynamics::rotary_mobility(const Analysis& analysis, std::size_t index) const {
  return mobility(analysis, index, {{{0, 0, 0, 1, 0, 0}, {0, 0, 0, 0, 1, 0}, {0, 0, 0, 0, 0, 1}}});
}

/// Largest eigenvalue of arm M^-1 arm^T over the free degrees of freedom.
double RigidDynamics::mobility(const Analysis& analysis, std::size_t index, const std::array<Vector6, 3>& arm) const {
  const auto& inverse = inertia(bodies_[index], analysis.current.rigid_bodies[index]).inverse;
  Eigen::Matrix3d mobility;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) mobility(i, j) = dot(arm[i], inverse * arm[j]);
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mobility, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

Matrix6 RigidDynamics::response(const Analysis& analysis, std::size_t index) const {
  const auto& body = bodies_[index];
  const auto& along_axes = inertia(body, analysis.current.rigid_bodies[index]).inverse;
  return body.is_free ? along_axes : turned(transpose(body.axes), along_axes);
}

Vector6 RigidDynamics::predicted_velocity(const Analysis& analysis, std::size_t index, const Instant& instant, const Vector6& more) const {
  const auto& body = bodies_[index];
  if (body.is_free) return motion_under(analysis, index, body.force + more, instant).velocity;
  const auto force = body.force + pair_of(body.axes * more.translation(), body.axes * more.rotation());
  const auto velocity = motion_under(analysis, index, force, instant).velocity;
  return pair_of(transpose(body.axes) * velocity.translation(), transpose(body.axes) * velocity.rotation());
}

void RigidDynamics::add_force(std::size_t index, const Vector6& force) {
  auto& body = bodies_[index];
  body.force += pair_of(body.axes * force.translation(), body.axes * force.rotation());
}

Vector6 RigidDynamics::force(std::size_t index) const {
  const auto& body = bodies_[index];
  return pair_of(transpose(body.axes) * body.force.translation(), transpose(body.axes) * body.force.rotation());
}

Vector6 RigidDynamics::velocity(const Analysis& analysis, std::size_t index) {
  const auto& state = analysis.current.rigid_bodies[index];
  return pair_of({state.velocity}, {state.angular_velocity});
}

void RigidDynamics::set_velocity(Analysis& analysis, std::size_t index, const Vector6& velocity) const {
  auto& state = analysis.current.rigid_bodies[index];
  state.velocity = velocity.translation().component;
  state.angular_velocity = velocity.rotation().component;
  set_node_velocities(analysis, index, 0.0, bodies_[index].nodes);
}

}  // namespace balocco
