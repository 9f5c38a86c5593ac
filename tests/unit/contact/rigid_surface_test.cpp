#include "rigid_surface.hpp"

#include <gtest/gtest.h>

#include "contact_model.hpp"

namespace balocco {
namespace {

using test::line;

// A drum of radius 50 about the global y axis, outward.
TEST(RigidSurface, RevolvedProfileMeasuresTheDistanceToTheAxis) {
  AnalyticalSurface drum;
  drum.kind = AnalyticalSurface::Kind::revolved;
  drum.origin = {1, 2, 3};
  drum.axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  drum.profile = {line({50, 10}, {50, -10})};  // runs in -z of the profile: outward is +r
  const RigidSurface surface(drum, {1, 1, 1});
  using Scalar = Dual<3>;
  const Vector3<Scalar> place{Scalar(24.0, 0), Scalar(4.0, 1), Scalar(2.0 + 32.0, 2)};  // (24, 3, 32) from the origin
  const auto at = surface.nearest(place);
  EXPECT_DOUBLE_EQ(at.distance.value, -10.0);
  const double expected[3] = {0.6, 0.0, 0.8};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(at.normal[i].value, expected[i], 1e-15);
    EXPECT_NEAR(at.distance.derivative[i], expected[i], 1e-15);
  }
  EXPECT_NEAR(at.normal[0].derivative[2], -0.6 * 0.8 / 40.0, 1e-15);
  EXPECT_DOUBLE_EQ(surface.nearest(Vector3<double>{0.0, 5.0, 2.0}).distance, -50.0);  // on the axis
}

}  // namespace
}  // namespace balocco
