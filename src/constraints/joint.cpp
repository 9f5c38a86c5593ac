#include "constraints/joint.hpp"

#include <cmath>

#include "constraints/motion_seeds.hpp"

namespace balocco {

namespace {

int rows_of(const Joint::Piece& piece) {
  switch (piece.part) {
    case Joint::Part::offset:
    case Joint::Part::align:
      return piece.along[0] + piece.along[1] + piece.along[2];
    case Joint::Part::revolute:
    case Joint::Part::slot:
      return 2;
    default:
      return 1;
  }
}

}  // namespace

JointConstraint::JointConstraint(const Model& model, const Joint& joint, double model_size) : pieces_(joint.pieces), lever_(model_size) {
  nodes_.assign(joint.nodes.begin(), joint.nodes.end());
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) {
      axes_[0](i, c) = joint.axes[i][c];
      axes_[1](i, c) = joint.second_axes[i][c];
    }
  const Vector3<double> arm = Vector3<double>{model.nodes.coordinates[nodes_[1]]} - Vector3<double>{model.nodes.coordinates[nodes_[0]]};
  offset_ = axes_[0] * arm;
  length_ = std::sqrt(dot(arm, arm));
  if (length_ > 0.0) lever_ = length_;
  for (const auto& piece : pieces_) {
    rows_ += rows_of(piece);
    const bool of_rotations = piece.part == Joint::Part::align || piece.part == Joint::Part::revolute || piece.part == Joint::Part::universal;
    turns_[1] = turns_[1] || of_rotations;
    // Two nodes in one place that stay together: along which axes does not matter.
    const bool pins = piece.part == Joint::Part::offset && rows_of(piece) == 3 && !(length_ > 1e-9 * model_size);
    turns_[0] = turns_[0] || (piece.part != Joint::Part::distance && !pins);
  }
}

template <class T>
std::array<JointConstraint::Frame<T>, 2> JointConstraint::frames(std::span<const NodePlace> places,
                                                                 const std::array<MotionSeed<T>, 2>& seeds) const {
  std::array<Frame<T>, 2> result;
  for (int node = 0; node < 2; ++node) {
    for (int c = 0; c < 3; ++c) result[node].position[c] = places[node].position[c] + seeds[node].displacement[c];
    result[node].axes = constant<T>(axes_[node] * transpose(places[node].rotation)) * transpose(seeds[node].turn);
  }
  return result;
}

template <class T>
void JointConstraint::evaluate(const std::array<Frame<T>, 2>& frames, T* g) const {
  const auto& [first, second] = frames;
  const auto e = [&](int i) { return row_of(first.axes, i); };
  const auto f = [&](int i) { return row_of(second.axes, i); };
  const Vector3<T> arm = second.position - first.position;
  for (const auto& piece : pieces_) switch (piece.part) {
      case Joint::Part::offset:
        for (int i = 0; i < 3; ++i)
          if (piece.along[i]) *g++ = dot(e(i), arm) - offset_[i];
        break;
      case Joint::Part::slot:
        for (int i = 1; i < 3; ++i) *g++ = dot(e(i), arm) - offset_[i];
        break;
      case Joint::Part::plane:
        *g++ = dot(e(0), arm) - offset_[0];
        break;
      case Joint::Part::distance:
        *g++ = square_root(dot(arm, arm)) - length_;
        break;
      case Joint::Part::align:  // the sine of the angle about each axis
        for (int i = 0; i < 3; ++i)
          if (piece.along[i]) *g++ = 0.5 * lever_ * (dot(e((i + 2) % 3), f((i + 1) % 3)) - dot(e((i + 1) % 3), f((i + 2) % 3)));
        break;
      case Joint::Part::revolute:
        for (int i = 1; i < 3; ++i) *g++ = lever_ * dot(e(i), f(0));
        break;
      case Joint::Part::universal:
        *g++ = lever_ * dot(e(0), f(2));
        break;
    }
}

void JointConstraint::gaps(std::span<const NodePlace> places, std::span<double> g) const {
  const MotionSeed<double> still{{}, Matrix3<double>::identity()};
  evaluate<double>(frames<double>(places, {still, still}), g.data());
}

void JointConstraint::gradient(std::span<const NodePlace> places, std::span<double> dg) const {
  std::array<Slope, 16> g;
  evaluate<Slope>(frames<Slope>(places, {slope_seed(0), slope_seed(1)}), g.data());
  for (int i = 0; i < rows_; ++i)
    for (int k = 0; k < 12; ++k) dg[12 * i + k] = g[i].derivative[k];
}

void JointConstraint::add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers,
                                    std::span<double> pairs) const {
  std::array<Curvature, 16> g;
  evaluate<Curvature>(frames<Curvature>(places, {curvature_seed(0), curvature_seed(1)}), g.data());
  for (int i = 0; i < rows_; ++i)
    for (int k = 0; k < 12; ++k)
      for (int l = 0; l < 12; ++l) pairs[12 * k + l] += multipliers[i] * g[i].derivative[k].derivative[l];
}

}  // namespace balocco
