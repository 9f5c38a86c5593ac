// Small models of one solid element type for the tests: nodes, one table, one section, one group on one rank.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "elements/element_type.hpp"
#include "elements/solids/nodal_shapes.hpp"
#include "math/exact_sum.hpp"
#include "model/model.hpp"

namespace balocco::test {

struct SolidOptions {
  std::string type = "C3D8R";
  std::string law = "elastic";
  std::vector<double> parameters{1000.0, 0.3};
  std::vector<MaterialOption> material_options{};
  double density = 1.0, damping_beta = 0.0;
  HourglassControl hourglass = HourglassControl::enhanced;
  double hourglass_scale = 1.0;
  bool pointwise_dilatation = false;
};

struct SolidCase {
  Model model;
  std::unique_ptr<ElementGroup> group;
  std::vector<double> position, velocity, force, history;

  int nodes() const { return static_cast<int>(model.nodes.coordinates.size()); }
  int dofs() const { return 3 * nodes(); }

  /// Moves every node to `map`(reference position).
  void move(const std::function<Point(const Point&)>& map) {
    for (int i = 0; i < nodes(); ++i) {
      const Point x = map(model.nodes.coordinates[i]);
      std::copy(x.begin(), x.end(), position.begin() + 4 * i);
    }
  }

  /// Runs one explicit force evaluation; `force` then holds minus the internal force.
  StableIncrement explicit_cycle(double increment = 0.0, double b1 = 0.0, double b2 = 0.0, double constant = 0.0) {
    for (std::size_t i = 0; i < force.size(); ++i) force[i] = i % 4 == 3 ? constant : 0.0;
    ExplicitCycle cycle{{position.data(), velocity.data()}, {force.data()}, increment, b1, b2};
    StableIncrement smallest = group->add_forces(Portion::interface, cycle, history);
    smallest.merge(group->add_forces(Portion::interior, cycle, history));
    return smallest;
  }

  std::vector<double> element_history(int element) const {
    std::vector<double> own(group->history_size());
    for (std::size_t k = 0; k < own.size(); ++k) own[k] = history[k * group->padded_size() + element];
    return own;
  }

  /// Force and stiffness of one element at the current positions.
  bool linearize(int element, Eigen::VectorXd& f, Eigen::MatrixXd& k) const {
    const int n = 3 * group->nodes_per_element();
    const std::vector<double> old_history = element_history(element);
    std::vector<double> new_history(old_history), forces(n), stiffness(n * n);
    const bool valid = group->linearize(element, {position.data()}, old_history, new_history, forces, stiffness);
    f = Eigen::Map<Eigen::VectorXd>(forces.data(), n);
    k = Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(stiffness.data(), n, n);
    return valid;
  }

  /// Assembled internal force and stiffness, dense.
  void assemble(Eigen::VectorXd& f, Eigen::MatrixXd& k) const {
    f = Eigen::VectorXd::Zero(dofs());
    k = Eigen::MatrixXd::Zero(dofs(), dofs());
    for (int e = 0; e < group->size(); ++e) {
      Eigen::VectorXd element_force;
      Eigen::MatrixXd element_stiffness;
      linearize(e, element_force, element_stiffness);
      const auto nodes = group->nodes(e);
      for (int a = 0; a < 3 * static_cast<int>(nodes.size()); ++a) {
        f(3 * nodes[a / 3] + a % 3) += element_force(a);
        for (int b = 0; b < 3 * static_cast<int>(nodes.size()); ++b)
          k(3 * nodes[a / 3] + a % 3, 3 * nodes[b / 3] + b % 3) += element_stiffness(a, b);
      }
    }
  }
};

inline SolidCase make_case(const SolidOptions& options, std::vector<Point> points,
                           std::vector<std::int32_t> connectivity, std::int32_t interface_count = 0) {
  SolidCase c;
  c.model.nodes.coordinates = points;
  for (std::size_t i = 0; i < points.size(); ++i) c.model.nodes.id.push_back(static_cast<std::int64_t>(i) + 1);
  ElementTable table;
  table.type = find_element_type(options.type);
  table.connectivity = connectivity;
  const int count = static_cast<int>(connectivity.size()) / table.type->nodes;
  for (int e = 0; e < count; ++e) table.id.push_back(e + 1);
  table.section.assign(count, 0);
  c.model.elements.push_back(table);
  Material material;
  material.name = "M";
  material.law = options.law;
  material.parameters = options.parameters;
  material.options = options.material_options;
  material.density = options.density;
  material.damping_beta = options.damping_beta;
  c.model.materials.push_back(material);
  Section section;
  section.material = 0;
  section.hourglass = options.hourglass;
  section.hourglass_scale = options.hourglass_scale;
  section.pointwise_dilatation = options.pointwise_dilatation;
  c.model.sections.push_back(section);

  std::vector<std::int32_t> rows(count);
  for (int e = 0; e < count; ++e) rows[e] = e;
  const auto scratch = static_cast<std::int32_t>(points.size());
  c.group = table.type->make_group({c.model, 0, 0, rows, interface_count, connectivity, scratch});
  c.position.assign(4 * points.size() + 4, 0.0);
  c.velocity.assign(4 * points.size() + 4, 0.0);
  c.force.assign(4 * points.size() + 4, 0.0);
  c.history = c.group->initial_history();
  c.move([](const Point& x) { return x; });
  return c;
}

/// Corners of the elements of a type that fill a brick.
inline std::vector<int> corners_in_brick(const ElementType& type) {
  if (type.shape == Shape::wedge || type.shape == Shape::quadratic_wedge) return {0, 1, 2, 4, 5, 6, 0, 2, 3, 4, 6, 7};
  if (type.shape == Shape::tetrahedron || type.shape == Shape::quadratic_tetrahedron)
    return {0, 1, 2, 6, 0, 2, 3, 6, 0, 3, 7, 6, 0, 7, 4, 6, 0, 4, 5, 6, 0, 5, 1, 6};
  return {0, 1, 2, 3, 4, 5, 6, 7};
}

/// The middle of each edge of a quadratic element, made when it is first met: corners first, then these.
class Middles {
 public:
  explicit Middles(std::vector<Point>& points) : points_(points) {}
  std::int32_t operator()(std::int32_t a, std::int32_t b) {
    const auto [place, fresh] = known_.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(points_.size()));
    if (fresh) {
      Point middle;
      for (int i = 0; i < 3; ++i) middle[i] = 0.5 * (points_[a][i] + points_[b][i]);
      points_.push_back(middle);
    }
    return place->second;
  }

 private:
  std::vector<Point>& points_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known_;
};

inline std::span<const std::array<int, 2>> edges_of(const ElementType& type) {
  if (type.shape == Shape::quadratic_tetrahedron) return tetrahedron_edges;
  if (type.shape == Shape::quadratic_wedge) return wedge_edges;
  if (type.shape == Shape::quadratic_hexahedron) return hexahedron_edges;
  return {};
}

/// A block of nx x ny x nz bricks, each one element, two wedges or six tetrahedra, on [0, size], interior nodes moved at random by
/// `skew` cells.
struct Block {
  std::array<int, 3> cells{1, 1, 1};
  Point size{1.0, 1.0, 1.0};
  double skew = 0.0;
  bool skew_boundary = false;
};

inline SolidCase make_block(const SolidOptions& options, const Block& block, std::int32_t interface_count = 0) {
  const int nx = block.cells[0], ny = block.cells[1], nz = block.cells[2];
  std::vector<Point> points;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        Point x{block.size[0] * i / nx, block.size[1] * j / ny, block.size[2] * k / nz};
        const bool inside = i > 0 && i < nx && j > 0 && j < ny && k > 0 && k < nz;
        for (int d = 0; d < 3; ++d) {
          const double offset = block.skew * uniform(random) * block.size[d] / block.cells[d];
          if (inside || block.skew_boundary) x[d] += offset;
        }
        points.push_back(x);
      }
  std::vector<std::int32_t> connectivity;
  const ElementType& type = *find_element_type(options.type);
  const std::size_t corners = static_cast<std::size_t>(type.nodes) - edges_of(type).size();
  Middles middle(points);
  const auto node = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const std::array<int, 8> hex{
            node(i, j, k),     node(i + 1, j, k),     node(i + 1, j + 1, k),     node(i, j + 1, k),
            node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)};
        const auto order = corners_in_brick(type);
        for (std::size_t first = 0; first < order.size(); first += corners) {
          for (std::size_t i = 0; i < corners; ++i) connectivity.push_back(hex[order[first + i]]);
          for (const auto [a, b] : edges_of(type)) connectivity.push_back(middle(hex[order[first + a]], hex[order[first + b]]));
        }
      }
  return make_case(options, points, connectivity, interface_count);
}

/// x = A X + b as a map for SolidCase::move.
inline std::function<Point(const Point&)> affine(const Eigen::Matrix3d& a,
                                                 const Eigen::Vector3d& b = Eigen::Vector3d::Zero()) {
  return [a, b](const Point& p) {
    const Eigen::Vector3d x = a * Eigen::Vector3d(p[0], p[1], p[2]) + b;
    return Point{x(0), x(1), x(2)};
  };
}

inline Eigen::Matrix3d rotation(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// Adds a random displacement of `size` to every node.
inline void shake(SolidCase& c, double size, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  for (int i = 0; i < c.nodes(); ++i)
    for (int d = 0; d < 3; ++d) c.position[4 * i + d] += uniform(random);
}

}  // namespace balocco::test
