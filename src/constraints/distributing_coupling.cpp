#include "constraints/distributing_coupling.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace balocco {

DistributingConstraint::DistributingConstraint(const Model& model, const DistributingCoupling& coupling)
    : weight_(coupling.weights), freedoms_(coupling.freedoms) {
  nodes_.push_back(coupling.reference);
  nodes_.insert(nodes_.end(), coupling.nodes.begin(), coupling.nodes.end());
  rows_ = static_cast<int>(std::ranges::count(freedoms_, true));
  rotates_ = std::any_of(freedoms_.begin() + 3, freedoms_.end(), [](bool is) { return is; });
  double sum = 0.0;
  for (const double weight : weight_) sum += weight;
  for (double& weight : weight_) weight /= sum;
  const auto place = [&](std::int32_t row) { return Vector3<double>{model.nodes.coordinates[row]}; };
  Vector3<double> center{};
  for (std::size_t i = 0; i < weight_.size(); ++i) center = center + weight_[i] * place(coupling.nodes[i]);
  double length = 0.0;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    arm_.push_back(place(coupling.nodes[i]) - center);
    length += weight_[i] * std::sqrt(dot(arm_.back(), arm_.back()));
  }
  if (length > 0.0) lever_ = length;
  if (coupling.axes != DistributingCoupling{}.axes)
    for (int axis = 0; axis < 3; ++axis)
      for (const auto& arm : arm_) own_arm_[axis].push_back(cross(Vector3<double>{coupling.axes[axis]}, arm));
  if (std::count(freedoms_.begin() + 3, freedoms_.end(), true) == 3) find_loose_directions();
  offset_ = place(coupling.reference) - center;
  rotates_ = rotates_ || dot(offset_, offset_) > 1e-24 * lever_ * lever_;  // a mean that moves an offset turns it
}

void DistributingConstraint::find_loose_directions() {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < weight_.size(); ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        inertia(j, k) += weight_[i] * ((j == k ? dot(arm_[i], arm_[i]) : 0.0) - arm_[i][j] * arm_[i][k]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  for (int n = 0; n < 3; ++n) {
    if (solver.eigenvalues()[n] > 1e-9 * lever_ * lever_) continue;
    const Eigen::Vector3d axis = solver.eigenvectors().col(n);
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) loose_(j, k) += axis[j] * axis[k];
  }
}

Vector3<double> DistributingConstraint::mean(std::span<const NodePlace> places) const {
  Vector3<double> center{};
  for (std::size_t i = 0; i < weight_.size(); ++i) center = center + weight_[i] * places[i + 1].position;
  return center;
}

CloudMoments DistributingConstraint::moments(std::span<const NodePlace> places) const {
  CloudMoments sums{.center = mean(places), .spread = {}};
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const auto to = places[i + 1].position - places[0].position;
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) sums.spread(j, k) += weight_[i] * arm_[i][j] * to[k];
  }
  return sums;
}

std::vector<int> DistributingConstraint::components() const {
  std::vector<int> components;
  for (int c = 0; c < 6; ++c)
    if (freedoms_[c]) components.push_back(c);
  return components;
}

void DistributingConstraint::gaps_of(const CloudMoments& moments, const NodePlace& reference, std::span<double> g) const {
  const auto apart = reference.position - moments.center - reference.rotation * offset_;
  const auto turned = reference.rotation * moments.spread;  // sum w (R A) x^T
  const Vector3<double> loose = lever_ * (loose_ * reference.turn);
  std::size_t row = 0;
  for (int c = 0; c < 6; ++c) {
    if (!freedoms_[c]) continue;
    const int j = c % 3, k = (j + 1) % 3, l = (j + 2) % 3;
    g[row++] = c < 3 ? apart[j] : loose[j] + (turned(k, l) - turned(l, k)) / lever_;
  }
}

void DistributingConstraint::gaps(std::span<const NodePlace> places, std::span<double> g) const {
  if (knows_moments_alone()) return gaps_of(moments(places), places[0], g);
  const auto center = mean(places);
  const auto& rotation = places[0].rotation;
  const auto apart = places[0].position - center - rotation * offset_;
  Vector3<double> moment{};
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < weight_.size(); ++i)
      moment[axis] += (weight_[i] / lever_) * dot(rotation * own_arm_[axis][i], places[i + 1].position - center);
  std::size_t row = 0;
  for (int c = 0; c < 6; ++c)
    if (freedoms_[c]) g[row++] = c < 3 ? apart[c] : moment[c - 3];
}

void DistributingConstraint::reference_gradient(const CloudMoments& moments, const Matrix3<double>& rotation, std::span<double> dg) const {
  const auto offset = rotation * offset_;
  const auto turned = rotation * moments.spread;
  const double trace = turned(0, 0) + turned(1, 1) + turned(2, 2);
  std::ranges::fill(dg, 0.0);
  std::size_t row = 0;
  for (int c = 0; c < 6; ++c) {
    if (!freedoms_[c]) continue;
    double* const line = &dg[6 * row++];
    const int j = c % 3, k = (j + 1) % 3, l = (j + 2) % 3;
    if (c < 3) {
      line[j] = 1.0;
      line[3 + k] = -offset[l];  // -(spin x offset)
      line[3 + l] = offset[k];
      continue;
    }
    // (spin x arm) x to = arm (spin . to) - spin (arm . to)
    for (int m = 0; m < 3; ++m) line[3 + m] = lever_ * loose_(j, m) + (turned(j, m) - (j == m ? trace : 0.0)) / lever_;
  }
}

void DistributingConstraint::gradient(std::span<const NodePlace> places, std::span<double> dg) const {
  const auto center = mean(places);
  const auto& rotation = places[0].rotation;
  std::ranges::fill(dg, 0.0);
  const auto width = static_cast<std::size_t>(columns());
  std::array<double, 36> of_reference{};
  reference_gradient(knows_moments_alone() ? moments(places) : CloudMoments{}, rotation, std::span(of_reference).first(6 * static_cast<std::size_t>(rows_)));
  std::size_t row = 0;
  for (int c = 0; c < 6; ++c) {
    if (!freedoms_[c]) continue;
    double* const line = &dg[width * row];
    std::copy_n(&of_reference[6 * row++], 6, line);
    const int j = c % 3, k = (j + 1) % 3, l = (j + 2) % 3;
    if (c < 3) {
      for (std::size_t i = 0; i < weight_.size(); ++i) line[6 * (i + 1) + j] = -weight_[i];
    } else if (!own_arm_[j].empty()) {
      std::fill_n(line, 6, 0.0);
      for (std::size_t i = 0; i < weight_.size(); ++i) {
        const auto arm = (weight_[i] / lever_) * (rotation * own_arm_[j][i]), by_spin = cross(arm, places[i + 1].position - center);
        for (int m = 0; m < 3; ++m) {
          line[3 + m] += by_spin[m];
          line[6 * (i + 1) + m] = arm[m];
        }
      }
    } else {
      for (std::size_t i = 0; i < weight_.size(); ++i) {
        const auto arm = (weight_[i] / lever_) * (rotation * arm_[i]);
        line[6 * (i + 1) + l] = arm[k];
        line[6 * (i + 1) + k] = -arm[l];
      }
    }
  }
}

void DistributingConstraint::add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers,
                                           std::span<double> pairs) const {
  Vector3<double> force{}, moment{};
  std::size_t row = 0;
  for (int c = 0; c < 6; ++c)
    if (freedoms_[c]) (c < 3 ? force : moment)[c % 3] = multipliers[row++];
  const auto center = mean(places);
  const auto& rotation = places[0].rotation;
  // Virtual spin e and real spin d of a vector b, against c: c . (e x (d x b)) = (e . b)(c . d) - (c . b)(e . d).
  const auto add_spins = [&](double factor, const Vector3<double>& b, const Vector3<double>& c) {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) pairs[12 * (3 + i) + 3 + k] += factor * (b[i] * c[k] - (i == k ? dot(b, c) : 0.0));
  };
  add_spins(-1.0, rotation * offset_, force);
  for (int axis = 0; axis < 3 && !own_arm_[axis].empty(); ++axis)
    for (std::size_t node = 0; node < weight_.size(); ++node) {
      const auto arm = (moment[axis] * weight_[node] / lever_) * (rotation * own_arm_[axis][node]);
      add_spins(1.0, arm, places[node + 1].position - center);
      double* const pair = &pairs[144 * node];
      for (int i = 0; i < 3; ++i) {  // (spin x arm) . displacement
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        pair[12 * (6 + i) + 3 + k] += arm[l];
        pair[12 * (6 + i) + 3 + l] -= arm[k];
        pair[12 * (3 + k) + 6 + i] += arm[l];
        pair[12 * (3 + l) + 6 + i] -= arm[k];
      }
    }
  if (!own_arm_[0].empty()) return;
  for (std::size_t node = 0; node < weight_.size(); ++node) {
    const auto arm = (weight_[node] / lever_) * (rotation * arm_[node]);
    add_spins(1.0, arm, cross(places[node + 1].position - center, moment));
    double* const pair = &pairs[144 * node];
    const double along = dot(moment, arm);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const double value = (i == k ? along : 0.0) - arm[i] * moment[k];  // displacement i of the node, spin k
        pair[12 * (6 + i) + 3 + k] += value;
        pair[12 * (3 + k) + 6 + i] += value;
      }
  }
}

}  // namespace balocco
