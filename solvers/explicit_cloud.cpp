#include "explicit_cloud.hpp"

#include <algorithm>

#include "vectors.hpp"

namespace balocco {

namespace {

void add_dyad(Matrix3<double>& sum, const Vector3<double>& a, const Vector3<double>& b) {
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) sum(j, k) += a[j] * b[k];
}

Vector3<double> row(const double* nodal, std::int32_t node) { return vector_of(nodal + 4 * std::ptrdiff_t{node}); }

}  // namespace

ExplicitCloud::ExplicitCloud(const DistributingConstraint& coupling, const std::vector<std::int32_t>& nodes, const std::vector<double>& inverse_mass)
    : lever_(coupling.lever()), change_(nodes.size()) {
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes_.push_back({nodes[i], coupling.weights()[i], 0.0, coupling.arms()[i]});
  take_inertia(inverse_mass);
}

void ExplicitCloud::take_inertia(const std::vector<double>& inverse_mass) {
  mobility_ = 0.0;
  first_ = {};
  second_ = {};
  for (auto& each : nodes_) {
    each.inverse_mass = inverse_mass[each.node];
    const double share = each.weight * each.weight * each.inverse_mass;
    mobility_ += share;
    first_ = first_ + share * each.arm;
    add_dyad(second_, share * each.arm, each.arm);
  }
}

bool ExplicitCloud::has(std::int32_t node) const {
  return std::ranges::find(nodes_, node, &Node::node) != nodes_.end();
}

double ExplicitCloud::inverse_mass(std::int32_t node) const { return std::ranges::find(nodes_, node, &Node::node)->inverse_mass; }

void ExplicitCloud::find_places(const double* position, const Vector3<double>& origin) {
  places_ = {};
  for (const auto& each : nodes_) {
    const auto x = row(position, each.node);
    places_.center = places_.center + each.weight * x;
    add_dyad(places_.spread, each.weight * each.arm, x - origin);
  }
}

void ExplicitCloud::find_velocities(const double* velocity, const double* force, double average) {
  velocities_ = {};
  for (const auto& each : nodes_) {
    Vector3<double> v{};
    if (velocity != nullptr) v = row(velocity, each.node);
    if (force != nullptr) v = v + average * each.inverse_mass * row(force, each.node);
    velocities_.center = velocities_.center + each.weight * v;
    add_dyad(velocities_.spread, each.weight * each.arm, v);
  }
}

CloudMoments ExplicitCloud::places_after(double next, double average, const Matrix3<double>& rotation, const Vector6& multipliers) const {
  const auto force = multipliers.translation(), moment = multipliers.rotation();
  auto after = places_;
  const auto mean_change = (1.0 / lever_) * cross(moment, rotation * first_) - mobility_ * force;
  after.center = after.center + next * (velocities_.center + average * mean_change);
  const Matrix3<double> turned = rotation * second_;  // its columns are sums of turned arms times one component of the arms
  for (int j = 0; j < 3; ++j) {
    const auto twist = (1.0 / lever_) * cross(moment, Vector3<double>{turned(0, j), turned(1, j), turned(2, j)});
    for (int k = 0; k < 3; ++k)
      after.spread(j, k) += next * (velocities_.spread(j, k) + average * (twist[k] - first_[j] * force[k]));
  }
  return after;
}

Vector6 ExplicitCloud::rates(double average, const Matrix3<double>& rotation, const Vector6& multipliers) const {
  const auto turned = rotation * velocities_.spread;
  const Vector3<double> moment{turned(1, 2) - turned(2, 1), turned(2, 0) - turned(0, 2), turned(0, 1) - turned(1, 0)};
  return pair_of(-1.0 * velocities_.center, (1.0 / lever_) * moment) + average * (response(rotation) * multipliers);
}

Matrix6 ExplicitCloud::response(const Matrix3<double>& rotation) const {
  const auto first = (1.0 / lever_) * (rotation * first_);
  const auto second = rotation * second_ * transpose(rotation);
  const double trace = second(0, 0) + second(1, 1) + second(2, 2), square = lever_ * lever_;
  Matrix6 response{};
  for (int j = 0; j < 3; ++j) {
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    response(j, j) = mobility_;
    response(j, 3 + k) = response(3 + k, j) = -first[l];
    response(j, 3 + l) = response(3 + l, j) = first[k];
    for (int m = 0; m < 3; ++m) response(3 + j, 3 + m) = ((j == m ? trace : 0.0) - second(j, m)) / square;
  }
  return response;
}

Vector3<double> ExplicitCloud::constraint_force(const Node& node, const Matrix3<double>& rotation, const Vector6& multipliers) const {
  return node.weight * ((1.0 / lever_) * cross(multipliers.rotation(), rotation * node.arm) - multipliers.translation());
}

void ExplicitCloud::find_changes(const double* force, double average, const Matrix3<double>& rotation, const Vector6& multipliers) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    auto sum = constraint_force(nodes_[i], rotation, multipliers);
    if (force != nullptr) sum = sum + row(force, nodes_[i].node);
    change_[i] = average * nodes_[i].inverse_mass * sum;
  }
}

void ExplicitCloud::add_changes(double* velocity) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (int c = 0; c < 3; ++c) velocity[4 * std::ptrdiff_t{nodes_[i].node} + c] += change_[i][c];
}

void ExplicitCloud::set_accelerations(double average, double* acceleration) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (int c = 0; c < 3; ++c) acceleration[4 * std::ptrdiff_t{nodes_[i].node} + c] = change_[i][c] / average;
}

void ExplicitCloud::add_constraint_forces(const Matrix3<double>& rotation, const Vector6& multipliers, double* force) const {
  for (const auto& each : nodes_) {
    const auto addend = constraint_force(each, rotation, multipliers);
    for (int c = 0; c < 3; ++c) force[4 * std::ptrdiff_t{each.node} + c] += addend[c];
  }
}

}  // namespace balocco
