// Bending and incompressibility against theory: small static problems solved with the elements' own stiffness at the
// reference.
#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include "solid_fixture.hpp"

namespace balocco::test {

namespace {

/// Linear solution K u = f with the given degrees of freedom held.
Eigen::VectorXd solve_linear(const SolidCase& c, const std::function<bool(int, int)>& held,
                             const Eigen::VectorXd& load) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd f;
  Eigen::MatrixXd k;
  Eigen::VectorXd right = load;
  std::vector<bool> fixed(c.dofs());
  for (int i = 0; i < c.dofs(); ++i) {
    fixed[i] = held(i / 3, i % 3);
    if (fixed[i]) {
      entries.emplace_back(i, i, 1.0);
      right(i) = 0.0;
    }
  }
  for (int e = 0; e < c.group->size(); ++e) {
    c.linearize(e, f, k);
    const auto nodes = c.group->nodes(e);
    for (int a = 0; a < k.rows(); ++a)
      for (int b = 0; b < k.cols(); ++b) {
        const int i = 3 * nodes[a / 3] + a % 3, j = 3 * nodes[b / 3] + b % 3;
        if (!fixed[i] && !fixed[j]) entries.emplace_back(i, j, k(a, b));
      }
  }
  Eigen::SparseMatrix<double> matrix(c.dofs(), c.dofs());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
}

struct BentBeam {
  std::string type = "C3D8R";
  std::array<int, 3> cells{6, 1, 1};
  Point size{6.0, 0.1, 0.2};
  double distortion = 0.0;  // slope of the planes between elements in (x, z)
  bool trapezoids = false;  // alternating slope
  std::vector<double> parameters{1e7, 0.3};
};

/// Tip deflection of a cantilever under a unit tip load along `direction` shared by the end's nodes.
double tip_deflection(const BentBeam& beam, int direction) {
  SolidOptions o;
  o.type = beam.type;
  o.parameters = beam.parameters;
  SolidCase c = make_block(o, {beam.cells, beam.size});
  if (beam.distortion != 0.0) {
    std::vector<Point> points = c.model.nodes.coordinates;
    for (auto& p : points) {
      const double index = p[0] * beam.cells[0] / beam.size[0];
      if (index < 0.5 || index > beam.cells[0] - 0.5) continue;
      const double sign = beam.trapezoids && static_cast<int>(std::lround(index)) % 2 == 0 ? -1.0 : 1.0;
      p[0] += sign * beam.distortion * (p[2] - 0.5 * beam.size[2]);
    }
    std::vector<std::int32_t> connectivity;
    for (int e = 0; e < c.group->size(); ++e)
      for (const auto node : c.group->nodes(e)) connectivity.push_back(node);
    c = make_case(o, points, connectivity);
  }
  Eigen::VectorXd load = Eigen::VectorXd::Zero(c.dofs());
  std::vector<int> tip;
  for (int i = 0; i < c.nodes(); ++i)
    if (c.model.nodes.coordinates[i][0] > beam.size[0] - 1e-9) tip.push_back(i);
  for (const int node : tip) load(3 * node + direction) = 1.0 / tip.size();
  const Eigen::VectorXd u = solve_linear(
      c, [&](int node, int) { return c.model.nodes.coordinates[node][0] < 1e-9; }, load);
  double mean = 0.0;
  for (const int node : tip) mean += u(3 * node + direction) / tip.size();
  return mean;
}

/// Pure bending of a rectangular brick by end moments: exact for a beam (free sides) whatever the aspect ratio, since
/// the hourglass stiffness carries the modulus E.
TEST(SolidBending, PureBendingOfOneElementIsExact) {
  const double young = 1000.0, length = 4.0, width = 1.0, height = 0.5;
  for (const double poisson : {0.0, 0.3, 0.499}) {
    SolidOptions o;
    o.parameters = {young, poisson};
    SolidCase c = make_block(o, {{1, 1, 1}, {length, width, height}});
    const double force = 1.0;  // on each of the end's four nodes: moment = 2 force height
    Eigen::VectorXd load = Eigen::VectorXd::Zero(c.dofs());
    for (int i = 0; i < c.nodes(); ++i) {
      const Point& x = c.model.nodes.coordinates[i];
      load(3 * i) = (x[0] > 0.5 * length ? 1.0 : -1.0) * (x[2] > 0.5 * height ? 1.0 : -1.0) * force;
    }
    const auto held = [](int node, int d) { return node == 0 || (node == 1 && d > 0) || (node == 2 && d == 2); };
    const Eigen::VectorXd u = solve_linear(c, held, load);
    // Axial fibre displacements: strain M z / (E I) at z = height / 2 over the length.
    const double moment = 2.0 * force * height, inertia = width * height * height * height / 12.0;
    const double stretch = u(3 * 5) - u(3 * 4), shortening = u(3 * 1) - u(3 * 0);
    const double expected = 2.0 * moment / (young * inertia) * 0.5 * height * length;
    EXPECT_NEAR(stretch - shortening, expected, 1e-10 * expected) << "nu = " << poisson;
  }
}

/// Slender cantilever one element thick: Timoshenko's tip deflection within 2 %.
TEST(SolidBending, CantileverOneElementThick) {
  BentBeam beam;
  beam.cells = {20, 1, 1};
  beam.size = {20.0, 1.0, 1.0};
  beam.parameters = {1000.0, 0.0};
  const double inertia = 1.0 / 12.0, shear_area = 5.0 / 6.0, shear = 500.0;
  const double expected = 8000.0 / (3.0 * 1000.0 * inertia) + 20.0 / (shear_area * shear);
  EXPECT_NEAR(tip_deflection(beam, 2), expected, 0.02 * expected);
  beam.parameters = {1000.0, 0.3};  // the clamp also holds the section: a little stiffer than beam theory
  EXPECT_NEAR(tip_deflection(beam, 2), expected, 0.02 * expected);
}

/// MacNeal and Harder 1985, straight beam 6 x 0.2 x 0.1, E = 1e7, nu = 0.3, six elements: in-plane 0.1081, out of plane
/// 0.4321. They report for 8-node bricks with bubble functions 0.98 (rectangles), 0.62 and 0.53 (parallelograms), 0.05
/// and 0.03 (trapezoids): no 8-node brick that passes the patch test bends as a trapezoid.
TEST(SolidBending, MacNealHarderStraightBeam) {
  const double in_plane = 0.1081, out_of_plane = 0.4321;
  const double slope = 1.0;  // 45 degrees, as in the paper
  struct Row {
    const char* name;
    double distortion;
    bool trapezoids;
    double least;  // of the normalised results: what this element reaches, so that a loss is noticed
  };
  for (const std::string type : {"C3D8R", "C3D8"}) {
    for (const Row& row : {Row{"rectangular", 0.0, false, 0.97}, Row{"parallelogram", slope, false, 0.58},
                           Row{"trapezoidal", slope, true, 0.030}}) {
      BentBeam beam;
      beam.type = type;
      beam.distortion = row.distortion;
      beam.trapezoids = row.trapezoids;
      const double first = tip_deflection(beam, 2) / in_plane, second = tip_deflection(beam, 1) / out_of_plane;
      std::printf("%s %s: in-plane %.3f, out of plane %.3f\n", type.c_str(), row.name, first, second);
      if (type == "C3D8R") {
        EXPECT_GE(first, row.least);
        EXPECT_GE(second, row.least);
        EXPECT_LE(std::max(first, second), 1.03);
      }
    }
  }
}

/// Thick tube under internal pressure in plane strain (Lame): nu = 0.4999 must not lock in bricks. A wedge is a
/// constant-strain triangle there, with one volume constraint each, which no element on its own can relax: it is held
/// to nu = 0.45 only.
TEST(SolidBending, IncompressibleTubeDoesNotLock) {
  const double inner = 1.0, outer = 2.0, young = 1000.0, pressure = 1.0;
  const int radial = 6, around = 12;
  const double quarter = std::acos(0.0);
  for (const std::string type : {"C3D8R", "C3D8", "C3D6"}) {
    const double poisson = type == "C3D6" ? 0.45 : 0.4999;
    const double expected = (1.0 + poisson) / young * pressure * inner * inner / (outer * outer - inner * inner) *
                            ((1.0 - 2.0 * poisson) * inner + outer * outer / inner);
    SolidOptions o;
    o.type = type;
    o.parameters = {young, poisson};
    SolidCase grid = make_block(o, {{radial, around, 1}, {1.0, 1.0, 0.1}});
    std::vector<Point> points = grid.model.nodes.coordinates;
    std::vector<std::int32_t> connectivity;
    for (int e = 0; e < grid.group->size(); ++e)
      for (const auto node : grid.group->nodes(e)) connectivity.push_back(node);
    std::vector<Point> flat = points;
    for (auto& p : points) {
      const double r = inner + p[0] * (outer - inner), angle = p[1] * quarter;
      p = {r * std::cos(angle), r * std::sin(angle), p[2]};
    }
    SolidCase c = make_case(o, points, connectivity);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(c.dofs());
    for (int i = 0; i < c.nodes(); ++i) {
      if (flat[i][0] > 1e-9) continue;
      const bool end = flat[i][1] < 1e-9 || flat[i][1] > 1.0 - 1e-9;
      const double area = inner * quarter / around * 0.05 * (end ? 0.5 : 1.0);  // chord for arc: 0.1 % at 12 elements
      for (int d = 0; d < 2; ++d) load(3 * i + d) = pressure * area * points[i][d] / inner;
    }
    const auto held = [&](int node, int d) {
      return d == 2 || (d == 1 && flat[node][1] < 1e-9) || (d == 0 && flat[node][1] > 1.0 - 1e-9);
    };
    const Eigen::VectorXd u = solve_linear(c, held, load);
    double mean = 0.0;
    int count = 0;
    for (int i = 0; i < c.nodes(); ++i) {
      if (flat[i][0] > 1e-9) continue;
      mean += std::hypot(u(3 * i), u(3 * i + 1));
      ++count;
    }
    std::printf("%s: tube, radial displacement / Lame %.4f\n", type.c_str(), mean / count / expected);
    EXPECT_NEAR(mean / count, expected, (type == "C3D6" ? 0.05 : 0.01) * expected) << type;
  }
}

}  // namespace

}  // namespace balocco::test
