#include "mesh_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact_model.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

using namespace test;

const PressureLaw straight{.kind = PressureLaw::Kind::linear, .slope = 100.0};
/// Pushes where the places of the tests are, with a slope like that.
const PressureLaw curved{.kind = PressureLaw::Kind::exponential, .clearance = 1.5, .pressure = 30.0, .greatest_slope = 90.0};

/// The plate of the other tests as master, seen from above, and single nodes as slaves.
struct MeshPair {
  Model model;
  Domain domain;
  std::vector<double> position;
  MeshContact contact;
  std::vector<ContactPoint> start, now;

  explicit MeshPair(int bricks, double friction_coefficient = friction, const PressureLaw& law = straight) : model(plate_on_road(bricks)) {
    add_node(model, {0, 0, 0});
    model.rigid_bodies.clear();
    Surface top = model.surfaces[0], foot = model.surfaces[0];
    for (auto& face : top.faces) face.face = 1;
    foot.kind = Surface::Kind::nodes;
    foot.faces.clear();
    foot.nodes = {model.nodes.size() - 1};
    model.surfaces = {foot, top};
    model.interactions[0].friction = friction_coefficient;
    model.interactions[0].behavior = law;
    domain = whole(model);
    position = positions(model, domain);
    contact = MeshContact(model, 0, domain);
    start.resize(contact.size());
    now = start;
  }
  void place(const Point& at) {
    for (int i = 0; i < 3; ++i) position[4 * (model.nodes.size() - 1) + i] = at[i];
    contact.follow(position.data());
  }
  void start_at(const Point& at) {
    place(at);
    contact.start_step(position.data(), true, start);
  }
  MeshTangent tangent() {
    MeshTangent result;
    contact.follow(position.data());
    const auto pairing = contact.pairing(0, position.data(), start[0]);
    now = start;
    contact.linearize(0, pairing, position.data(), start[0], now[0], false, {}, result);
    return result;
  }
};

TEST(MeshContact, PushesAsTheSlopeSaysAndBothSidesAlike) {
  MeshPair pair(2);
  pair.start_at({7, 4, height + 0.01});
  EXPECT_FALSE(pair.tangent().closed);
  pair.start_at({7, 4, height - 0.02});
  const auto tangent = pair.tangent();
  ASSERT_TRUE(tangent.closed);
  EXPECT_NEAR(tangent.force[2], 2.0, 1e-12);
  Vector3<double> force{}, moment{};
  for (std::size_t i = 0; i < tangent.nodes.size(); ++i) {
    const double* x = &pair.position[4 * tangent.nodes[i]];
    const Vector3<double> here{tangent.force[3 * i], tangent.force[3 * i + 1], tangent.force[3 * i + 2]};
    force = force + here;
    moment = moment + cross(Vector3<double>{x[0], x[1], x[2]}, here);
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(force[k], 0.0, 1e-13);
    EXPECT_NEAR(moment[k], 0.0, 1e-11);
  }
}

TEST(MeshContact, SurfacesThatFaceTheSameWayAreRefused) {
  Model model = plate_on_road(2);
  model.rigid_bodies.clear();
  Surface above = model.surfaces[0];
  for (auto& face : above.faces) face.face = 1;
  model.surfaces[1] = above;  // the two sides of one plate look away from each other
  EXPECT_NO_THROW(MeshContact(model, 0, whole(model)));
  model.surfaces[1] = model.surfaces[0];
  EXPECT_THROW(MeshContact(model, 0, whole(model)), InputError);
}

TEST(MeshContact, ReachesATenthOfAFaceBeyondTheEndOfTheSurface) {
  MeshPair pair(2);
  pair.start_at({-0.9, 4, height - 0.02});
  EXPECT_TRUE(pair.tangent().closed);
  pair.start_at({-1.1, 4, height - 0.02});
  EXPECT_FALSE(pair.tangent().closed);
}

TEST(MeshContact, SticksAndSlipsRelativeToTheMaterialOfTheMaster) {
  MeshPair pair(2);
  pair.start_at({7, 4, height - 0.02});
  // Master and slave carried along together: no friction.
  for (std::size_t i = 0; i < pair.position.size(); i += 4) pair.position[i] += 0.3;
  EXPECT_NEAR(pair.tangent().force[0], 0.0, 1e-12);
  pair.position[4 * (pair.model.nodes.size() - 1)] += 0.001;
  EXPECT_NEAR(pair.tangent().force[0], -0.1, 1e-10);
  pair.position[4 * (pair.model.nodes.size() - 1)] += 1.0;
  EXPECT_NEAR(pair.tangent().force[0], -friction * 2.0, 1e-10);
  EXPECT_NEAR(pair.now[0].slip, 1.001 - friction * 0.02, 1e-10);
  pair.start = pair.now;
  EXPECT_NEAR(pair.tangent().force[0], -friction * 2.0, 1e-10);  // the anchor came along: the same force at the same place
  EXPECT_NEAR(pair.now[0].slip, pair.start[0].slip, 1e-10);
}

/// The derivative is that of the force: central differences, sliding or sticking, over faces, on an edge that they share, off its foot.
class MeshTangentOf : public testing::TestWithParam<std::tuple<Point, Point, bool, PressureLaw>> {};

TEST_P(MeshTangentOf, ForceIsItsDerivative) {
  const auto [at, moved, valley, law] = GetParam();
  MeshPair pair(2, friction, law);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  for (std::size_t node = 0; node + 1 < static_cast<std::size_t>(pair.model.nodes.size()); ++node)
    for (int i = 0; i < 3; ++i) pair.position[4 * node + i] += noise(random);
  // A valley along x = 10: what lies below its edge is nearest to the edge.
  if (valley)
    for (std::size_t node = 0; node + 1 < static_cast<std::size_t>(pair.model.nodes.size()); ++node)
      pair.position[4 * node + 2] += 0.5 * std::abs(pair.position[4 * node] - 10.0);
  const auto reference = at;
  pair.start_at(reference);
  pair.tangent();
  pair.start = pair.now;
  for (int i = 0; i < 3; ++i) pair.position[4 * (pair.model.nodes.size() - 1) + i] += moved[i];
  const auto exact = pair.tangent();
  ASSERT_TRUE(exact.closed);
  // A node may stand in two lists, of the foot's face and the anchor's: their sums count.
  const std::size_t freedoms = 3 * static_cast<std::size_t>(pair.model.nodes.size());
  const auto forces = [&](const MeshTangent& tangent) {
    std::vector<double> sum(freedoms, 0.0);
    for (std::size_t i = 0; i < tangent.force.size(); ++i) sum[3 * tangent.nodes[i / 3] + i % 3] += tangent.force[i];
    return sum;
  };
  std::vector<double> derivative(freedoms * freedoms, 0.0);
  const auto place_in_model = [&](std::size_t i) { return 3 * static_cast<std::size_t>(exact.nodes[i / 3]) + i % 3; };
  for (std::size_t row = 0; row < exact.force.size(); ++row)
    for (std::size_t column = 0; column < exact.force.size(); ++column)
      derivative[place_in_model(row) * freedoms + place_in_model(column)] += exact.derivative[row * exact.force.size() + column];
  for (std::size_t column = 0; column < freedoms; ++column) {
    const std::size_t entry = 4 * (column / 3) + column % 3;
    constexpr double step = 1e-5;
    const double before = pair.position[entry];
    pair.position[entry] = before + step;
    const auto up = forces(pair.tangent());
    pair.position[entry] = before - step;
    const auto down = forces(pair.tangent());
    pair.position[entry] = before;
    for (std::size_t row = 0; row < freedoms; ++row)
      EXPECT_NEAR(derivative[row * freedoms + column], (up[row] - down[row]) / (2.0 * step), 2e-5) << "row " << row << ", column " << column;
  }
}

INSTANTIATE_TEST_SUITE_P(Places, MeshTangentOf,
                         testing::Values(std::tuple{Point{6.2, 4.1, 4.7}, Point{0.002, -0.003, -0.01}, false, straight},
                                         std::tuple{Point{6.2, 4.1, 4.7}, Point{0.9, 0.4, -0.1}, false, straight},
                                         std::tuple{Point{9.4, 4.1, 4.6}, Point{1.2, 0.4, -0.1}, false, straight},
                                         std::tuple{Point{9.9, 4.1, 3.2}, Point{0.02, 0.003, -0.01}, true, straight},
                                         std::tuple{Point{6.2, 4.1, 5.4}, Point{0.9, 0.4, -0.1}, false, curved},
                                         std::tuple{Point{6.2, 4.1, 3.6}, Point{1.3, 0.4, -0.1}, false, curved}));

}  // namespace
}  // namespace balocco
