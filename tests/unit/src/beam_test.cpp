// Beams: kernel and group, one element at a time.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>

#include "elements/beams/beam.hpp"
#include "elements/element_type.hpp"
#include "math/exact_sum.hpp"
#include "model/diagnostics.hpp"
#include "symmetric_eigenvalues.hpp"

namespace balocco::test {
namespace {

/// Beams of one section, a node's rotation beside its position.
struct Beam {
  Model model;
  std::unique_ptr<ElementGroup> group;
  std::vector<double> position, orientation, velocity, spin, force, moment, history;

  explicit Beam(const std::vector<Point>& nodes, BeamProfile profile = rectangle(0.2, 0.1)) {
    model.name = "beam";
    model.nodes.coordinates = nodes;
    ElementTable table;
    table.type = find_element_type("B31");
    for (std::size_t i = 0; i < nodes.size(); ++i) model.nodes.id.push_back(static_cast<std::int64_t>(i) + 1);
    for (std::int32_t i = 0; i + 1 < model.nodes.size(); ++i) {
      table.id.push_back(i + 1);
      table.connectivity.insert(table.connectivity.end(), {i, i + 1});
      table.section.push_back(0);
      table.location.emplace_back();
    }
    model.elements.push_back(std::move(table));
    model.sections.emplace_back();
    model.sections[0].kind = Section::Kind::beam;
    model.sections[0].material = 0;
    model.sections[0].beam = std::move(profile);
    model.materials.emplace_back();
    model.materials[0].law = "elastic";
    model.materials[0].parameters = {1e7, 0.3};
    model.materials[0].density = 1e-3;
  }

  static BeamProfile rectangle(double a, double b) {
    BeamProfile profile;
    profile.shape = BeamProfile::Shape::rectangle;
    profile.dimensions = {a, b};
    return profile;
  }

  void build() {
    GroupInput input{.model = model, .table = 0, .section = 0, .rows = {}, .interface_count = 0, .connectivity = {}};
    for (std::int32_t row = 0; row < model.elements[0].size(); ++row) input.rows.push_back(row);
    input.connectivity = model.elements[0].connectivity;
    input.scratch_node = model.nodes.size();
    group = model.elements[0].type->make_group(input);
    const std::size_t size = 4 * static_cast<std::size_t>(model.nodes.size() + 1);
    for (auto* array : {&position, &orientation, &velocity, &spin, &force, &moment}) array->assign(size, 0.0);
    for (std::int32_t node = 0; node < model.nodes.size(); ++node) {
      std::copy_n(model.nodes.coordinates[node].data(), 3, &position[4 * node]);
      orientation[4 * node] = 1.0;
    }
    history = group->initial_history();
  }

  NodalMotion motion() const { return {position.data(), velocity.data(), orientation.data(), spin.data()}; }

  void turn(std::int32_t node, const Vector3<double>& by) {
    double* const q = &orientation[4 * node];
    const auto now = turned(Quaternion<double>{q[0], q[1], q[2], q[3]}, by);
    std::copy_n(now.begin(), 4, q);
  }

  /// Moves freedom 0-5 of a node.
  void move(int freedom, std::int32_t node, double by) {
    if (freedom < 3) {
      position[4 * node + freedom] += by;
    } else {
      Vector3<double> spin_vector{};
      spin_vector[freedom - 3] = by;
      turn(node, spin_vector);
    }
  }

  void rotate_rigidly(const Vector3<double>& by) {
    const auto q = exponential(by);
    const auto r = rotation_matrix(q);
    for (std::int32_t node = 0; node < model.nodes.size(); ++node) {
      const auto x = r * Vector3<double>{{position[4 * node], position[4 * node + 1], position[4 * node + 2]}};
      std::copy_n(x.component.begin(), 3, &position[4 * node]);
      turn(node, by);
    }
  }

  void disturb(double size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-size, size);
    for (std::int32_t node = 0; node < model.nodes.size(); ++node)
      for (int freedom = 0; freedom < 6; ++freedom) move(freedom, node, uniform(random));
  }

  std::vector<double> own_history() const { return std::vector<double>(group->history_size(), 0.0); }

  Eigen::Matrix<double, 12, 1> forces(std::int32_t element = 0) const {
    Eigen::Matrix<double, 12, 1> f;
    auto updated = own_history();
    group->linearize(element, motion(), own_history(), updated, {f.data(), 12}, {});
    return f;
  }

  Eigen::Matrix<double, 12, 12> stiffness(std::int32_t element = 0) const {
    Eigen::Matrix<double, 12, 12, Eigen::RowMajor> k;
    Eigen::Matrix<double, 12, 1> f;
    auto updated = own_history();
    group->linearize(element, motion(), own_history(), updated, {f.data(), 12}, {k.data(), 144});
    return k;
  }

  double energy(std::int32_t element = 0) const { return group->energies(element, motion(), own_history()).strain; }

  StableIncrement add_forces(double largest = 1e6) {
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] = moment[i] = i % 4 == 3 ? rounding_constant(largest) : 0.0;
    StableIncrement stable;
    for (const auto portion : {Portion::interface, Portion::interior})
      stable.merge(group->add_forces(portion, {.motion = motion(), .forces = {force.data(), moment.data()}}, history));
    return stable;
  }
};

Beam oblique() { return Beam({{1.0, 2.0, 3.0}, {1.6, 2.4, 3.7}}); }

TEST(Beam, ForcesAreTheDerivativeOfTheEnergy) {
  Beam beam = oblique();
  beam.build();
  beam.disturb(0.3);
  const auto f = beam.forces();
  const double step = 1e-6;
  for (int i = 0; i < 12; ++i) {
    Beam up = oblique(), down = oblique();
    for (Beam* side : {&up, &down}) {
      side->build();
      side->position = beam.position;
      side->orientation = beam.orientation;
      side->move(i % 6, i / 6, side == &up ? step : -step);
    }
    EXPECT_NEAR((up.energy() - down.energy()) / (2.0 * step), f[i], 2e-8 * f.norm()) << i;
  }
}

TEST(Beam, StiffnessIsTheDerivativeOfTheForces) {
  Beam beam = oblique();
  beam.build();
  beam.disturb(0.3);
  const auto k = beam.stiffness();
  const double step = 1e-6;
  for (int j = 0; j < 12; ++j) {
    Beam up = oblique(), down = oblique();
    for (Beam* side : {&up, &down}) {
      side->build();
      side->position = beam.position;
      side->orientation = beam.orientation;
      side->move(j % 6, j / 6, side == &up ? step : -step);
    }
    const auto column = (up.forces() - down.forces()) / (2.0 * step);
    EXPECT_LT((column - k.col(j)).norm(), 1e-8 * k.norm()) << j;
  }
}

TEST(Beam, RigidRotationStrainsNothing) {
  Beam beam = oblique();
  beam.build();
  const double scale = beam.stiffness().norm();
  for (const Vector3<double>& by : {Vector3<double>{{0.4, -0.2, 0.9}}, Vector3<double>{{2.0, 2.5, -0.3}}}) {
    beam.rotate_rigidly(by);
    EXPECT_LT(beam.forces().norm(), 1e-14 * scale);
  }
}

TEST(Beam, HasSixZeroModes) {
  Beam beam = oblique();
  beam.build();
  const auto k = beam.stiffness();
  EXPECT_LT((k - k.transpose()).norm(), 1e-12 * k.norm());
  const auto modes = symmetric_eigenvalues(k);
  EXPECT_LT(std::abs(modes[5]), 1e-10 * modes[11]);
  EXPECT_GT(modes[6], 1e-4 * modes[11]);
}

TEST(Beam, StrainDependsOnThePlaceNotOnThePath) {
  Beam one = oblique(), other = oblique();
  for (Beam* beam : {&one, &other}) beam->build();
  one.disturb(0.2);
  other.rotate_rigidly({{3.0, 0.5, -1.0}});
  const Quaternion<double> q = exponential({{3.0, 0.5, -1.0}});
  const auto r = rotation_matrix(q);
  for (int node = 0; node < 2; ++node) {  // the same place as `one`, seen from a turned frame; signs of quaternions differ
    const double* const p = &one.orientation[4 * node];
    auto turned_too = product(q, Quaternion<double>{p[0], p[1], p[2], p[3]});
    if (node == 1)
      for (double& component : turned_too) component = -component;
    std::copy_n(turned_too.begin(), 4, &other.orientation[4 * node]);
    const auto x = r * Vector3<double>{{one.position[4 * node], one.position[4 * node + 1], one.position[4 * node + 2]}};
    std::copy_n(x.component.begin(), 3, &other.position[4 * node]);
  }
  EXPECT_NEAR(other.energy(), one.energy(), 1e-12 * one.energy());
}

/// MH-beam (VERIFY.md): 6 x .2 x .1, E 1e7: the linear deflection of one element is that of Timoshenko's beam.
TEST(Beam, OneElementIsExactForSmallDeflections) {
  Beam beam({{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}}, Beam::rectangle(0.2, 0.1));
  beam.model.sections[0].beam.n1 = {0.0, 1.0, 0.0};  // width .2 along y
  beam.build();
  const Eigen::MatrixXd tip = beam.stiffness().bottomRightCorner<6, 6>().inverse();
  const double e = 1e7, g = e / 2.6, area = 0.02, length = 6.0, cube = length * length * length;
  EXPECT_NEAR(tip(0, 0), length / (e * area), 1e-12);
  EXPECT_NEAR(tip(1, 1), cube / (3.0 * e * 0.1 * 0.008 / 12.0) + length / (0.85 * g * area), 1e-9 * tip(1, 1));
  EXPECT_NEAR(tip(2, 2), cube / (3.0 * e * 0.2 * 0.001 / 12.0) + length / (0.85 * g * area), 1e-9 * tip(2, 2));
  EXPECT_NEAR(tip(3, 3), length / (g * 0.229 * 0.2 * 0.001), 2e-3 * tip(3, 3));  // 0.229 a b^3: Timoshenko's table, b / a = 1/2
}

TEST(Beam, ExplicitForcesAreTheStaticOnes) {
  Beam beam({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.1}, {1.7, 0.6, 0.0}, {2.0, 1.5, 0.4}});
  beam.build();
  beam.disturb(0.1);
  beam.add_forces();
  std::vector<double> expected(24, 0.0);
  for (std::int32_t element = 0; element < 3; ++element) {
    const auto f = beam.forces(element);
    for (int i = 0; i < 12; ++i) expected[6 * (element + i / 6) + i % 6] -= f[i];
  }
  for (int node = 0; node < 4; ++node)
    for (int i = 0; i < 6; ++i) {
      const auto& sum = i < 3 ? beam.force : beam.moment;
      EXPECT_NEAR(sum[4 * node + i % 3], expected[6 * node + i], 1e-8) << node << i;
    }
}

TEST(Beam, StableIncrementIsThatOfWavesAlongTheAxisAndSafe) {
  for (const double length : {0.05, 0.3, 2.0, 20.0})
    for (const double size : {0.0, 0.02}) {
      Beam beam({{0.0, 0.0, 0.0}, {length, 0.0, 0.0}});
      beam.build();
      beam.disturb(size * length);
      const double increment = beam.add_forces(1e12).increment;
      std::array<double, 2> mass{}, inertia{};
      beam.group->lumped_mass(0, mass);
      beam.group->lumped_rotary_inertia(0, inertia);
      Eigen::Matrix<double, 12, 1> scale;
      for (int i = 0; i < 12; ++i) scale[i] = 1.0 / std::sqrt(i % 6 < 3 ? mass[0] : inertia[0]);
      const auto k = beam.stiffness();
      const Eigen::MatrixXd scaled = scale.asDiagonal() * (0.5 * (k + k.transpose())) * scale.asDiagonal();
      const double omega = std::sqrt(symmetric_eigenvalues(scaled)[11]);
      EXPECT_LE(increment, 2.0 / omega * (1.0 + 1e-9)) << length;
      if (size == 0.0) EXPECT_NEAR(increment, length / std::sqrt(1e7 / 1e-3), 1e-9 * increment) << length;
    }
}

TEST(Beam, PureBendingGivesTheMomentOfTheCurvature) {
  Beam beam({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}});
  beam.model.sections[0].beam.n1 = {0.0, 1.0, 0.0};
  beam.build();
  const double angle = 0.4;  // about z, which is n2: the nodes turn by half of it each
  beam.turn(0, {{0.0, 0.0, -0.5 * angle}});
  beam.turn(1, {{0.0, 0.0, 0.5 * angle}});
  const auto f = beam.forces();
  EXPECT_NEAR(std::abs(f[11]), 1e7 * 0.1 * 0.008 / 12.0 * angle, 1e-10 * std::abs(f[11]));
  EXPECT_NEAR(f.head<3>().norm(), 0.0, 1e-8);
  std::array<double, 3> moment{};
  beam.group->output("SM", 0, 0, beam.motion(), beam.own_history(), moment);
  EXPECT_NEAR(std::abs(moment[1]), std::abs(f[11]), 1e-10 * std::abs(f[11]));
}

TEST(Beam, PointsOfAYieldingSectionAreItsFibres) {
  Beam beam({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}});
  beam.model.sections[0].beam.n1 = {0.0, 1.0, 0.0};
  beam.model.materials[0].options.push_back({"plastic", {0.0}, {{1e4, 0.0}, {2e4, 0.5}}});
  beam.build();
  beam.turn(0, {{0.0, 0.0, -0.05}});
  beam.turn(1, {{0.0, 0.0, 0.05}});
  auto history = beam.own_history();
  std::array<double, 12> force{};
  beam.group->linearize(0, beam.motion(), beam.own_history(), history, force, {});
  const auto fibres = beam_fibres(beam.model.sections[0].beam);
  ASSERT_EQ(beam.group->integration_points(), static_cast<int>(fibres.size()));
  double moment = 0.0, largest = 0.0;
  for (std::size_t point = 0; point < fibres.size(); ++point) {
    std::array<double, 6> stress{};
    beam.group->output("S", 0, static_cast<int>(point), beam.motion(), history, stress);
    moment -= fibres[point].area * fibres[point].x1 * stress[0];
    largest = std::max(largest, std::abs(stress[0]));
  }
  EXPECT_NEAR(moment, force[11], 1e-10 * std::abs(force[11]));
  EXPECT_GT(largest, 1e4);
  EXPECT_LT(largest, 1.05e4);
}

TEST(Beam, ADirectionAlongTheAxisIsRefused) {
  Beam beam({{0.0, 0.0, 0.0}, {0.0, 0.0, 2.0}});  // the default n1 is (0, 0, -1)
  EXPECT_THROW(beam.build(), InputError);
}

TEST(BeamSection, AreasOfProfiles) {
  const auto area = [](BeamProfile::Shape shape, std::vector<double> dimensions) {
    BeamProfile profile;
    profile.shape = shape;
    profile.dimensions = std::move(dimensions);
    return beam_area(profile);
  };
  using Shape = BeamProfile::Shape;
  const auto square = area(Shape::rectangle, {2.0, 2.0});
  EXPECT_NEAR(square.torsion, 0.140577 * 16.0, 1e-5 * 16.0);  // Timoshenko and Goodier: 0.1406 a^4
  const auto pipe = area(Shape::pipe, {3.0, 1.0});
  EXPECT_NEAR(pipe.i11, std::numbers::pi / 4.0 * (81.0 - 16.0), 1e-12 * pipe.i11);
  const auto box = area(Shape::box, {4.0, 6.0, 0.5, 0.5, 0.5, 0.5});
  EXPECT_NEAR(box.i11, (4.0 * 216.0 - 3.0 * 125.0) / 12.0, 1e-12 * box.i11);
  EXPECT_NEAR(box.torsion, 4.0 * std::pow(3.5 * 5.5, 2) * 0.5 / 18.0, 1e-12 * box.torsion);
  const auto i_section = area(Shape::i_section, {5.0, 10.0, 4.0, 4.0, 1.0, 1.0, 0.5});
  EXPECT_NEAR(i_section.i11, (4.0 * 1000.0 - 3.5 * 512.0) / 12.0, 1e-12 * i_section.i11);
}

}  // namespace
}  // namespace balocco::test
