#include "constraints/alignment.hpp"

#include <cmath>

#include "math/dual.hpp"

namespace balocco {

namespace {

constexpr int most_motions = 12;  // three of each of four nodes
using Slope = Dual<most_motions>;
using Curvature = Dual<most_motions, Slope>;

/// Positions of the nodes, whose motions are the independent variables.
template <class T, class Seed>
std::vector<Vector3<T>> moving(std::span<const NodePlace> places, Seed seed) {
  std::vector<Vector3<T>> positions(places.size());
  for (std::size_t node = 0; node < places.size(); ++node)
    for (int c = 0; c < 3; ++c) positions[node][c] = seed(places[node].position[c], 3 * static_cast<int>(node) + c);
  return positions;
}

}  // namespace

AlignmentConstraint::AlignmentConstraint(const Model& model, const Alignment& alignment) {
  nodes_ = alignment.nodes;
  rows_ = nodes_.size() == 3 ? 2 : 1;
  const Vector3<double> along = Vector3<double>{model.nodes.coordinates[nodes_[1]]} - Vector3<double>{model.nodes.coordinates[nodes_[0]]};
  int least = 0;
  for (int c = 1; c < 3; ++c)
    if (std::abs(along[c]) < std::abs(along[least])) least = c;
  Vector3<double> axis{};
  axis[least] = 1.0;
  across_[0] = cross(along, axis);
  across_[1] = cross(along, across_[0]);
  for (auto& direction : across_) direction = (1.0 / std::sqrt(dot(direction, direction))) * direction;
}

template <class T>
void AlignmentConstraint::evaluate(std::span<const Vector3<T>> position, T* g) const {
  const auto first = position[1] - position[0], held = position.back() - position[0];
  if (rows_ == 1) {
    const auto normal = cross(first, position[2] - position[0]);
    g[0] = dot(normal, held) / square_root(dot(normal, normal));
    return;
  }
  const auto off = held - (dot(first, held) / dot(first, first)) * first;
  for (int row = 0; row < 2; ++row) g[row] = across_[row][0] * off[0] + across_[row][1] * off[1] + across_[row][2] * off[2];
}

void AlignmentConstraint::gaps(std::span<const NodePlace> places, std::span<double> g) const {
  evaluate<double>(moving<double>(places, [](double x, int) { return x; }), g.data());
}

void AlignmentConstraint::gradient(std::span<const NodePlace> places, std::span<double> dg) const {
  std::array<Slope, 2> g;
  evaluate<Slope>(moving<Slope>(places, [](double x, int k) { return Slope(x, k); }), g.data());
  std::ranges::fill(dg, 0.0);
  for (int row = 0; row < rows_; ++row)
    for (int k = 0; k < 3 * static_cast<int>(nodes_.size()); ++k) dg[columns() * row + 6 * (k / 3) + k % 3] = g[row].derivative[k];
}

void AlignmentConstraint::add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers,
                                        std::span<double> pairs) const {
  std::array<Curvature, 2> g;
  evaluate<Curvature>(moving<Curvature>(places,
                                        [](double x, int k) {
                                          Curvature seed(Slope(x, k));
                                          seed.derivative[k] = Slope(1.0);
                                          return seed;
                                        }),
                      g.data());
  const auto column = [](int k) { return 6 * (k / 3) + k % 3; };
  const int motions = 3 * static_cast<int>(nodes_.size());
  for (int row = 0; row < rows_; ++row)
    for (int k = 0; k < motions; ++k)
      for (int l = 0; l < motions; ++l) pairs[columns() * column(k) + column(l)] += multipliers[row] * g[row].derivative[k].derivative[l];
}

}  // namespace balocco
