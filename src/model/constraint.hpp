// Equations between the motions of nodes, as a deck says them. Rows of nodes; degrees of freedom count from 0 as in step.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/element_ref.hpp"

namespace balocco {

/// *EQUATION: the sum of coefficient * displacement (rotation) vanishes.
struct LinearEquation {
  struct Term {
    std::int32_t node = -1, dof = 0;
    double coefficient = 0.0;
  };
  std::vector<Term> terms;
};

/// What joins a second node to a frame that moves with a first one. The frame's `axes` (rows: unit vectors e1 e2 e3 at the start)
/// turn with the first node; those of the second, f1 f2 f3, `second_axes`, with the second.
struct Joint {
  enum class Part {
    offset,      // the second node keeps its place in the frame: the directions of `along`
    distance,    // the distance of the nodes stays
    align,       // no relative rotation about the directions of `along`
    revolute,    // relative rotation about e1 alone
    universal,   // e1 stays perpendicular to f3
    slot,        // the second node keeps its place across e1
    plane        // and along e1
  };
  struct Piece {
    Part part = Part::offset;
    std::array<bool, 3> along{true, true, true};  // offset, align
  };
  std::array<std::int32_t, 2> nodes{-1, -1};
  std::vector<Piece> pieces;
  std::array<std::array<double, 3>, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, second_axes = axes;
};

/// How connectors measure the motion of a second frame relative to a first one.
struct RelativeMotionKind {
  /// Coordinates of the second node in the frame of the first, less those at the start; or the change of the distance.
  enum class Translation { none, cartesian, axial } translation = Translation::none;
  /// Cardan (1-2-3) or Euler (3-1-3) angles, or the rotation vector, from the frame of the first node to that of the second.
  enum class Rotation { none, cardan, euler, vector } rotation = Rotation::none;
};

/// Components of relative motion of a connector that something stops, locks, rubs, drives or loads (*CONNECTOR STOP, LOCK, FRICTION,
/// MOTION, LOAD): a row each. What holds in a step is a law between the row's motion and its force (solvers/guide_laws.hpp).
struct Guide {
  /// Coulomb: a force or moment up to coefficient * (internal + sum over `terms` of |arm_c * force_c| of the held components).
  struct Friction {
    double coefficient = 0.0, internal = 0.0;
    std::vector<std::array<double, 6>> terms;  // arms by component, lengths where they turn forces into moments
  };
  /// Bounds of a position: a coordinate, a distance or an angle (radians).
  using Range = std::array<double, 2>;
  static constexpr Range everywhere{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  struct Row {
    int component = 0;  // 0 to 5
    Range stop = everywhere;
    Range lock = everywhere;  // beyond it the connector locks
    bool locks_all = true;    // all rows, or this one alone
    std::optional<Friction> friction;
    std::int32_t angle_node = -1;  // whose rotation about the third direction shows an angle (*MPC REVOLUTE, UNIVERSAL)
  };
  std::array<std::int32_t, 2> nodes{-1, -1};
  std::array<std::array<double, 3>, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, second_axes = axes;  // as of Joint
  RelativeMotionKind kind;
  std::vector<Row> rows;
  std::int32_t joint = -1;  // row of Model::constraints: what the connector holds
};

/// *COUPLING with *DISTRIBUTING: the reference node moves (`freedoms` 0-2) with the weighted mean of the nodes and turns (3-5)
/// with their mean rotation, that which leaves no weighted moment of the displacements.
struct DistributingCoupling {
  std::int32_t reference = -1;
  std::vector<std::int32_t> nodes;
  std::vector<double> weights;  // positive
  std::array<bool, 6> freedoms{true, true, true, true, true, true};
  /// Rows: the directions that 3-5 turn about; they turn with the reference node.
  std::array<std::array<double, 3>, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

/// A node that stays where it is between others: x = sum of weight * (x_i + offset at the start), the offset turning with the others
/// where they turn; and, where `rotations` says so, turns with their weighted mean.
struct Tie {
  std::int32_t node = -1;
  std::vector<std::int32_t> others;
  std::vector<double> weights;  // their sum is 1
  bool others_turn = false;     // then all of them do
  bool rotations = false;
};

/// *MPC PLANE and STRAIGHT: the last node stays in the plane of the three before it, or on the line of the two before it.
struct Alignment {
  std::vector<std::int32_t> nodes;
};

/// *MPC DIST: two nodes that cannot get farther apart.
struct GreatestDistance {
  std::array<std::int32_t, 2> nodes{-1, -1};
  double distance = 0.0;
};

/// *MPC MEANROT: the mean of the angles by which nodes turn about their centre, in the plane across a fixed axis, is the displacement
/// of one more node in its first direction.
struct MeanRotation {
  std::vector<std::int32_t> nodes;
  std::int32_t angle_node = -1;
  std::array<double, 3> axis{};  // unit
};

using ConstraintKind =
    std::variant<LinearEquation, Joint, DistributingCoupling, Tie, Alignment, GreatestDistance, MeanRotation, Guide>;

struct ConstraintDefinition {
  ConstraintKind kind;
  std::string keyword;  // "*EQUATION", for messages
  std::int32_t file = -1, line = 0;
  ElementRef element{};  // the connector that it belongs to
};

}  // namespace balocco
