// The reduced equations of a static step: their stiffness is the derivative of their residual, but for half the cross product of residual
// moments and spins, and neither depends on the number of ranks. These tests hold on any number of ranks.
#include "implicit_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "implicit_fixture.hpp"

namespace balocco {
namespace {

using namespace test;

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

struct StaticEquations : testing::Test {
  const Model model = beam();
  const Communicator communicator;
  Equations beam_{model, communicator};

  /// Strains of some per cent, bodies turned, contact partly closed, sticking and sliding.
  void SetUp() override { beam_.system.move(beam_.noise(1.0), 0.03); }

  double tangent_error(double h) {
    const auto direction = beam_.noise(0.4);
    const auto start = beam_.system.configuration();
    std::array<std::vector<double>, 2> residual;
    for (const int side : {0, 1}) {
      beam_.system.restore(start);
      beam_.system.move(direction, side == 0 ? -h : h);
      residual[side] = beam_.gathered(beam_.residual(direction));
    }
    beam_.system.restore(start);
    const auto moments = beam_.gathered(beam_.residual(direction)), spins = beam_.gathered(direction);
    auto product = beam_.gathered(beam_.product());
    for (std::size_t body = 3 * model.nodes.id.size(); body < product.size(); body += 3)  // the half that statics leave out
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t a = body + i, b = body + (i + 1) % 3, c = body + (i + 2) % 3;
        product[a] -= 0.5 * (moments[b] * spins[c] - moments[c] * spins[b]);
      }
    double error = 0.0;
    for (std::size_t i = 0; i < product.size(); ++i)
      error = std::max(error, std::abs((residual[1][i] - residual[0][i]) / (2 * h) - product[i]));
    return error / largest(product);
  }
};

TEST_F(StaticEquations, ReducedStiffnessIsTheDerivativeOfTheResidual) {
  beam_.residual(beam_.noise(0.4));
  ASSERT_GT(beam_.system.closed_points(), 2);
  ASSERT_LT(beam_.system.closed_points(), 10);
  const double coarse = tangent_error(4e-4), fine = tangent_error(2e-4);
  EXPECT_LT(fine, 1e-5);
  EXPECT_LT(fine, 0.27 * coarse) << coarse << " " << fine;
}

TEST_F(StaticEquations, TheMatrixIsTheStiffnessOfTheFreeSlots) {
  const auto& map = beam_.map();
  auto motion = beam_.noise(0.4);
  for (std::int32_t slot = 0; slot < map.slots(); ++slot)
    if (map.role(slot) != ImplicitDofMap::Role::free) motion[slot] = 0.0;
  beam_.residual(motion);
  const auto product = beam_.product();
  PetscVector direction, image;
  petsc(MatCreateVecs(beam_.system.stiffness().matrix(), direction.address(), image.address()));
  double* values = nullptr;
  petsc(VecGetArray(direction, &values));
  for (std::size_t i = 0; i < map.owned_free_slots().size(); ++i) values[i] = motion[map.owned_free_slots()[i]];
  petsc(VecRestoreArray(direction, &values));
  petsc(MatMult(beam_.system.stiffness().matrix(), direction, image));
  const double* result = nullptr;
  petsc(VecGetArrayRead(image, &result));
  const double scale = largest(beam_.gathered(product));
  for (std::size_t i = 0; i < map.owned_free_slots().size(); ++i)  // sums of some hundred terms
    EXPECT_NEAR(result[i], product[map.owned_free_slots()[i]], 1e-13 * scale);
  petsc(VecRestoreArrayRead(image, &result));
}

// The same model whole on each rank gives the same equations, but for the order of sums.
TEST_F(StaticEquations, ResidualAndStiffnessDoNotDependOnTheRanks) {
  const Communicator alone(MPI_COMM_SELF);
  Equations whole(model, alone);
  whole.system.move(whole.noise(1.0), 0.03);
  const auto residual = beam_.gathered(beam_.residual(beam_.noise(0.4)));
  const auto product = beam_.gathered(beam_.product());
  const auto expected_residual = whole.gathered(whole.residual(whole.noise(0.4)));
  const auto expected_product = whole.gathered(whole.product());
  EXPECT_LT(largest(difference(residual, expected_residual)), 1e-13 * largest(expected_residual));
  EXPECT_LT(largest(difference(product, expected_product)), 1e-13 * largest(expected_product));
  EXPECT_EQ(beam_.system.closed_points(), whole.system.closed_points());
}

// Forces on carried nodes and their moments about the hub are what the hub's slots feel: moving all slots as one rigid
// motion of everything does no work, since the loads beside pressure are left out.
TEST(ImplicitSystem, ARigidMotionOfEverythingDoesNoWorkOnInternalAndContactForces) {
  Model model = beam();
  model.steps[0].surface_loads.clear();
  model.steps[0].concentrated_loads.clear();
  const Communicator communicator;
  Equations beam(model, communicator);
  beam.system.move(beam.noise(1.0), 0.03);
  const auto residual = beam.residual(std::vector<double>(beam.map().slots(), 0.0));
  ASSERT_GT(largest(beam.gathered(residual)), 1.0);
  const Point velocity{0.3, -0.5, 0.7}, spin{0.2, 0.6, -0.4};
  double power = 0.0;
  for (const auto slot : beam.map().owned_slots()) {
    if (beam.map().role(slot) == ImplicitDofMap::Role::absent) continue;
    const auto node = beam.map().node_of(slot);
    const double* x = &beam.analysis.current.position[4 * node];
    const Point moving{velocity[0] + spin[1] * x[2] - spin[2] * x[1], velocity[1] + spin[2] * x[0] - spin[0] * x[2],
                       velocity[2] + spin[0] * x[1] - spin[1] * x[0]};
    const Point& rate = beam.map().is_rotation(slot) ? spin : moving;
    for (int i = 0; i < 3; ++i) power += beam.map().directions(node)(slot % 3, i) * rate[i] * residual[slot];
  }
  std::array<double, 1> sum{power};
  communicator.sum(std::span<double>(sum));
  EXPECT_NEAR(sum[0], 0.0, 1e-11 * largest(beam.gathered(residual)));
}

}  // namespace
}  // namespace balocco
