#include "explicit_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <experimental/simd>
#include <numeric>

#include "math/exact_sum.hpp"
#include "vectors.hpp"

namespace balocco {

namespace {

void add_dyad(Matrix3<double>& sum, const Vector3<double>& a, const Vector3<double>& b) {
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) sum(j, k) += a[j] * b[k];
}

Vector3<double> row(const double* nodal, std::int32_t node) { return vector_of(nodal + 4 * std::ptrdiff_t{node}); }

using Four = std::experimental::fixed_size_simd<double, 4>;

Four four(const double* nodal, std::int32_t node) { return Four(nodal + 4 * std::ptrdiff_t{node}, std::experimental::element_aligned); }

/// Order-free sums of vectors in two parts: what rounding to the first part's quantum leaves is a hundred bits below the largest sum in
/// the second one.
class SplitSum {
 public:
  SplitSum(double largest, std::size_t addends) : coarse_(rounding_constant(largest)) {
    const double quantum = std::ldexp(coarse_ / 1.5, -52);
    fine_ = rounding_constant(static_cast<double>(addends) * quantum);
  }
  void add(const Four& addend) {
    const Four main = rounded(addend, Four(coarse_));
    main_ += main;
    rest_ += rounded(addend - main, Four(fine_));
  }
  double* put(double* out) const {
    main_.copy_to(out, std::experimental::element_aligned);
    rest_.copy_to(out + 4, std::experimental::element_aligned);
    return out + 8;
  }
  static Vector3<double> value(const double* in) { return vector_of(in) + vector_of(in + 4); }

 private:
  double coarse_, fine_ = 0.0;
  Four main_ = 0.0, rest_ = 0.0;
};

/// Sums of a vector of every node, times its weight and times its weighted arm.
struct MomentSums {
  SplitSum center, spread[3];
  MomentSums(double largest, std::size_t addends)
      : center(largest, addends), spread{{largest, addends}, {largest, addends}, {largest, addends}} {}
  void add(const Four& vector, double weight, const Vector3<double>& arm) {
    const Four weighted = weight * vector;
    center.add(weighted);
    for (int j = 0; j < 3; ++j) spread[j].add(arm[j] * weighted);
  }
  double* put(double* out) const {
    out = center.put(out);
    for (const auto& sum : spread) out = sum.put(out);
    return out;
  }
};

CloudMoments moments_of(const double* sums, double reach) {
  CloudMoments moments{.center = SplitSum::value(sums), .spread = {}};
  for (int j = 0; j < 3; ++j) {
    const auto row = reach * SplitSum::value(sums + 8 * (j + 1));
    for (int k = 0; k < 3; ++k) moments.spread(j, k) = row[k];
  }
  return moments;
}

}  // namespace

ExplicitCloud::ExplicitCloud(const DistributingConstraint& coupling, const std::vector<std::int32_t>& nodes, const Domain& domain,
                             const std::vector<double>& inverse_mass)
    : lever_(coupling.lever()) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto kind = [&](std::size_t i) { return domain.owned[nodes[i]] ? 0 : domain.computed[nodes[i]] ? 1 : 2; };
  std::ranges::stable_sort(order, {}, kind);
  in_order_.resize(nodes.size());
  for (const auto i : order) {
    in_order_[i] = nodes_.size();
    nodes_.push_back({nodes[i], coupling.weights()[i], 0.0, coupling.arms()[i]});
    if (kind(i) == 0) ++owned_;
    if (kind(i) <= 1) ++computed_;
    for (int c = 0; c < 3; ++c) reach_ = std::max(reach_, std::abs(nodes_.back().arm[c]));
  }
  change_.resize(computed_);
  take_inertia(inverse_mass);
}

void ExplicitCloud::take_inertia(const std::vector<double>& inverse_mass) {
  mobility_ = 0.0;
  first_ = {};
  second_ = {};
  for (const auto i : in_order_) {
    auto& each = nodes_[i];
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

void ExplicitCloud::sum(Share share, const Motion& motion, const Vector3<double>& reference, const Largest& largest) {
  MomentSums places(largest.place, nodes_.size()), rates(largest.rate, nodes_.size());
  const Four origin([&](auto lane) { return lane < 3 ? reference[lane] : 0.0; });
  const double inverse_reach = reach_ > 0.0 ? 1.0 / reach_ : 0.0;
  const std::size_t count = share == Share::owned ? owned_ : nodes_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto& each = share == Share::owned ? nodes_[i] : nodes_[in_order_[i]];
    const auto arm = inverse_reach * each.arm;
    places.add(four(motion.position, each.node) - origin, each.weight, arm);
    Four rate = 0.0;
    if (motion.velocity != nullptr) rate = four(motion.velocity, each.node);
    if (motion.force != nullptr) rate += (motion.average * each.inverse_mass) * four(motion.force, each.node);
    rates.add(rate, each.weight, arm);
  }
  rates.put(places.put(sums_.data()));
}

void ExplicitCloud::take_sums(const Vector3<double>& reference) {
  places_ = moments_of(sums_.data(), reach_);
  places_.center = reference + places_.center;
  velocities_ = moments_of(sums_.data() + sum_count / 2, reach_);
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
  for (std::size_t i = 0; i < computed_; ++i) {
    auto sum = constraint_force(nodes_[i], rotation, multipliers);
    if (force != nullptr) sum = sum + row(force, nodes_[i].node);
    change_[i] = average * nodes_[i].inverse_mass * sum;
  }
}

void ExplicitCloud::add_changes(double* velocity) const {
  for (std::size_t i = 0; i < computed_; ++i)
    for (int c = 0; c < 3; ++c) velocity[4 * std::ptrdiff_t{nodes_[i].node} + c] += change_[i][c];
}

void ExplicitCloud::set_accelerations(double average, double* acceleration) const {
  for (std::size_t i = 0; i < computed_; ++i)
    for (int c = 0; c < 3; ++c) acceleration[4 * std::ptrdiff_t{nodes_[i].node} + c] = change_[i][c] / average;
}

void ExplicitCloud::add_constraint_forces(const Matrix3<double>& rotation, const Vector6& multipliers, double* force) const {
  for (const auto& each : computed()) {
    const auto addend = constraint_force(each, rotation, multipliers);
    for (int c = 0; c < 3; ++c) force[4 * std::ptrdiff_t{each.node} + c] += addend[c];
  }
}

}  // namespace balocco
