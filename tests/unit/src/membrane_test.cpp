#include <gtest/gtest.h>

#include <cmath>

#include "membrane_fixture.hpp"

namespace balocco::test {
namespace {

const std::vector<std::string> membranes{"M3D4", "M3D4R", "M3D3"};

class Membrane : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Types, Membrane, testing::ValuesIn(membranes), [](const auto& info) { return info.param; });

Point deformed(const Point& x) {  // large stretch, shear and rotation out of the plane
  return {1.2 * x[0] + 0.3 * x[1] - 0.1 * x[2] + 4.0, 0.9 * x[1] - 0.2 * x[0] + 0.4 * x[2], 0.5 * x[0] + 0.8 * x[2] - 0.3 * x[1]};
}

Point turned(const Point& x) {  // by 2 rad about (1, 2, 2) / 3, then shifted
  const Eigen::Matrix3d r = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 2) / 3.0).toRotationMatrix();
  const Eigen::Vector3d y = r * Eigen::Vector3d(x[0], x[1], x[2]);
  return {y[0] + 1.0, y[1] - 2.0, y[2] + 3.0};
}

// An affine motion strains every point alike, so inner nodes of any mesh are in balance: round-off only, which grows with the
// number of addends (6 elements) and the size of their forces (about 100).
TEST_P(Membrane, PatchIsInBalanceUnderAnyAffineMotion) {
  for (const auto& [law, parameters] : std::vector<std::pair<std::string, std::vector<double>>>{
           {"elastic", {100.0, 0.3}}, {"neo-hooke", {15.0, 0.0}}}) {
    Sheet sheet = skewed_patch(GetParam());
    sheet.set_law(law, parameters);
    sheet.build();
    sheet.position = sheet.positions(deformed);
    std::vector<double> net(sheet.position.size(), 0.0);
    double largest = 0.0;
    for (std::int32_t e = 0; e < sheet.group->size(); ++e) {
      const Eigen::VectorXd f = sheet.force(e);
      largest = std::max(largest, f.cwiseAbs().maxCoeff());
      for (int i = 0; i < f.size(); ++i) net[4 * sheet.group->nodes(e)[i / 3] + i % 3] += f[i];
    }
    ASSERT_GT(largest, 1.0);
    for (int j = 1; j < 4; ++j)
      for (int i = 1; i < 4; ++i)
        for (int c = 0; c < 3; ++c) EXPECT_LT(std::fabs(net[4 * (5 * j + i) + c]), 1e-13 * largest * 10.0);
  }
}

TEST_P(Membrane, PatchHasTheSameStressInEveryElement) {
  Sheet sheet = skewed_patch(GetParam());
  sheet.build();
  sheet.position = sheet.positions(deformed);
  std::array<double, 6> first{}, other{};
  sheet.group->output("S", 0, 0, {sheet.position.data()}, sheet.initial_history(), first);
  for (std::int32_t e = 0; e < sheet.group->size(); ++e)
    for (int q = 0; q < sheet.group->integration_points(); ++q) {
      sheet.group->output("S", e, q, {sheet.position.data()}, sheet.initial_history(), other);
      for (int c = 0; c < 6; ++c) EXPECT_NEAR(other[c], first[c], 1e-12 * std::fabs(first[0]));
    }
}

// Also on a warped surface, where the one-point element holds a reference hourglass amplitude.
TEST_P(Membrane, RotationStrainsNothing) {
  Sheet sheet = skewed_patch(GetParam(), 0.2);
  sheet.build();
  sheet.position = sheet.positions(turned);
  for (std::int32_t e = 0; e < sheet.group->size(); ++e) {
    EXPECT_LT(sheet.force(e).cwiseAbs().maxCoeff(), 1e-12);  // 100 (modulus) * 10 (distance) * round-off
    EXPECT_LT(sheet.energies(e).strain + sheet.energies(e).hourglass, 1e-24);
  }
}

// A flat membrane at rest: six rigid modes. The fully integrated quadrilateral also warps freely; hourglass control stops that.
TEST_P(Membrane, HasTheRightNumberOfZeroEigenvalues) {
  const int expected = GetParam() == "M3D4" ? 7 : 6;
  for (const Point corner : {Point{2.0, 1.0, 0.0}, Point{2.6, 1.7, 0.0}}) {
    Sheet sheet = rectangle(GetParam(), 2.0, 1.0);
    if (GetParam() != "M3D3") sheet.model.nodes.coordinates[2] = corner;
    sheet.build();
    const Eigen::MatrixXd k = sheet.stiffness();
    EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff());
    const Eigen::VectorXd values = symmetric_eigenvalues(k);
    const double zero = 1e-12 * values.maxCoeff();
    EXPECT_EQ((values.array().abs() < zero).count(), GetParam() == "M3D3" ? 6 : expected);
    EXPECT_GT(values.minCoeff(), -zero);
  }
}

// The error of central differences of the force against the tangent falls with the square of the step.
TEST_P(Membrane, TangentIsTheDerivativeOfTheForce) {
  for (const auto& [law, parameters] : std::vector<std::pair<std::string, std::vector<double>>>{
           {"elastic", {100.0, 0.3}}, {"lamina", {300.0, 10.0, 0.4, 5.0, 5.0, 5.0}}, {"mooney-rivlin", {10.0, 4.0, 0.0}}}) {
    Sheet sheet = skewed_patch(GetParam(), 0.1);
    sheet.set_law(law, parameters);
    sheet.build();
    sheet.position = sheet.positions(deformed);
    sheet.disturb(0.15, 3);
    const Eigen::MatrixXd k = sheet.stiffness();
    const auto error = [&](double step) {
      Eigen::MatrixXd difference(k.rows(), k.cols());
      for (int j = 0; j < k.cols(); ++j) {
        double& x = sheet.position[4 * sheet.group->nodes(0)[j / 3] + j % 3];
        const double at = x;
        x = at + step;
        const Eigen::VectorXd up = sheet.force();
        x = at - step;
        difference.col(j) = (up - sheet.force()) / (2.0 * step);
        x = at;
      }
      return (difference - k).norm() / k.norm();
    };
    const double coarse = error(2e-2), fine = error(1e-2);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << law;
    EXPECT_LT(error(1e-5), 1e-8) << law;
  }
}

TEST_P(Membrane, ForceIsTheDerivativeOfTheEnergy) {
  Sheet sheet = skewed_patch(GetParam(), 0.1);
  sheet.set_law("neo-hooke", {10.0, 0.02});
  sheet.build();
  sheet.disturb(0.15, 5);
  const Eigen::VectorXd force = sheet.force();
  const auto energy = [&] { return sheet.energies().strain + sheet.energies().hourglass; };
  const double step = 1e-5;
  for (int j = 0; j < force.size(); ++j) {
    double& x = sheet.position[4 * sheet.group->nodes(0)[j / 3] + j % 3];
    const double at = x;
    x = at + step;
    const double up = energy();
    x = at - step;
    EXPECT_NEAR((up - energy()) / (2.0 * step), force[j], 1e-8 * force.norm());
    x = at;
  }
}

// Pure bending in the plane of a rectangle: assumed-strain hourglass control gives E t b^3 / (12 a) of beam theory (nu free).
TEST(MembraneHourglass, BendsAsBeamTheory) {
  const double a = 2.0, b = 0.5, young = 100.0, thickness = 0.5, angle = 1e-6;
  Sheet sheet = rectangle("M3D4R", a, b);
  sheet.build();
  const double u = 0.25 * angle * b;  // ends turn by +-angle / 2
  sheet.position[0] += u;
  sheet.position[4] -= u;
  sheet.position[8] += u;
  sheet.position[12] -= u;
  const double energy = 0.5 * young * thickness * b * b * b / (12.0 * a) * angle * angle;
  EXPECT_NEAR(sheet.energies().hourglass, energy, 1e-5 * energy);  // second order in the angle
  std::array<double, 1> artificial{}, elastic{};
  sheet.group->output("ELASE", 0, 0, {sheet.position.data()}, sheet.initial_history(), artificial);
  sheet.group->output("ELSE", 0, 0, {sheet.position.data()}, sheet.initial_history(), elastic);
  EXPECT_NEAR(artificial[0], energy, 1e-5 * energy);
  EXPECT_LT(elastic[0], 1e-5 * energy);
  EXPECT_LT(sheet.energies().strain, 1e-5 * energy);
}

// Stiffness control is the weak, isotropic kind: 0.005 of the shear modulus in every direction.
TEST(MembraneHourglass, StiffnessControlIsIsotropic) {
  Sheet sheet = rectangle("M3D4R", 2.0, 1.0);
  sheet.model.sections[0].hourglass = HourglassControl::stiffness;
  sheet.build();
  const Eigen::MatrixXd stiffness = sheet.stiffness();
  Eigen::Matrix3d k = Eigen::Matrix3d::Zero();  // of the mode that moves neighbouring corners against each other
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 12; ++column)
      k(row % 3, column % 3) += (row / 3 + column / 3) % 2 == 0 ? stiffness(row, column) : -stiffness(row, column);
  // q = gamma . x = 4; stiffness 0.005 G V <g . g>, <g . g> = (1 / a^2 + 1 / b^2) / 12
  const double expected = 16.0 * 0.005 * (100.0 / 2.6) * (0.5 * 2.0) * (1.0 / 4.0 + 1.0) / 12.0;
  EXPECT_LT((k - expected * Eigen::Matrix3d::Identity()).norm(), 1e-12 * expected);
}

// Tension stiffens the warping of the one-point element exactly as that of the fully integrated one.
TEST(MembraneHourglass, TensionResistsWarping) {
  const auto warping_stiffness = [](const std::string& type) {
    Sheet sheet = rectangle(type, 2.0, 1.0);
    sheet.build();
    sheet.position = sheet.positions([](const Point& x) { return Point{1.1 * x[0], 1.05 * x[1], 0.0}; });
    Eigen::VectorXd mode = Eigen::VectorXd::Zero(12);
    for (int i = 0; i < 4; ++i) mode[3 * i + 2] = i % 2 == 0 ? 1.0 : -1.0;
    return mode.dot(sheet.stiffness() * mode);
  };
  Sheet rest = rectangle("M3D4R", 2.0, 1.0);
  rest.build();
  Eigen::VectorXd mode = Eigen::VectorXd::Zero(12);
  for (int i = 0; i < 4; ++i) mode[3 * i + 2] = i % 2 == 0 ? 1.0 : -1.0;
  const double control = mode.dot(rest.stiffness() * mode), full = warping_stiffness("M3D4");
  EXPECT_GT(full, 1.0);
  EXPECT_NEAR(warping_stiffness("M3D4R") - control, full, 1e-10 * full);
}

TEST_P(Membrane, MassIsDensityTimesVolume) {
  Sheet sheet = skewed_patch(GetParam());
  sheet.build();
  double sum = 0.0;
  std::vector<double> mass(sheet.group->nodes_per_element());
  for (std::int32_t e = 0; e < sheet.group->size(); ++e) {
    sheet.group->lumped_mass(e, mass);
    for (double m : mass) {
      EXPECT_GT(m, 0.0);
      sum += m;
    }
  }
  EXPECT_NEAR(sum, 2e-3 * 0.5 * (4.0 * 3.2), 1e-15);
}

// Uniaxial stretch 1.3 of the material along local direction 1: strains and Cauchy stress in closed form.
TEST_P(Membrane, OutputsCauchyStressAndLogarithmicStrain) {
  Sheet sheet = rectangle(GetParam(), 2.0, 1.0);
  sheet.set_law("neo-hooke", {10.0, 2e-7});  // bulk modulus 1e7: incompressible to 1e-6
  sheet.build();
  const double stretch = 1.3, across = 1.0 / std::sqrt(stretch);
  sheet.position = sheet.positions([&](const Point& x) { return turned({stretch * x[0], across * x[1], 0.0}); });
  const auto history = sheet.initial_history();
  std::array<double, 6> s{}, le{};
  std::array<double, 1> thickness{}, mises{};
  sheet.group->output("S", 0, 0, {sheet.position.data()}, history, s);
  sheet.group->output("LE", 0, 0, {sheet.position.data()}, history, le);
  sheet.group->output("STH", 0, 0, {sheet.position.data()}, history, thickness);
  sheet.group->output("MISES", 0, 0, {sheet.position.data()}, history, mises);
  const double expected = 2.0 * 10.0 * (stretch * stretch - 1.0 / stretch);
  EXPECT_NEAR(s[0], expected, 1e-4);
  EXPECT_NEAR(s[1], 0.0, 1e-4);
  EXPECT_NEAR(mises[0], expected, 1e-4);
  EXPECT_NEAR(le[0], std::log(stretch), 1e-12);
  EXPECT_NEAR(le[1], -0.5 * std::log(stretch), 1e-12);
  EXPECT_NEAR(le[2], -0.5 * std::log(stretch), 1e-5);
  EXPECT_NEAR(thickness[0], 0.5 * across, 1e-5);
  EXPECT_EQ(sheet.group->output_components("S"), 6);
  EXPECT_EQ(sheet.group->output_components("PEEQ"), 0);
}

// Fibres lie along local direction 1: the x axis by default, the z axis on a plane normal to x, the tangent of a cylinder.
TEST_P(Membrane, LocalDirectionsFollowTheOrientation) {
  const auto axial_stiffness = [&](Sheet& sheet) {
    sheet.set_law("lamina", {300.0, 10.0, 0.0, 5.0, 5.0, 5.0});
    sheet.build();
    std::array<double, 6> s{};
    sheet.position = sheet.positions([](const Point& x) { return Point{x[0] * 1.001, x[1], x[2]}; });
    sheet.group->output("S", 0, 0, {sheet.position.data()}, sheet.initial_history(), s);
    return std::max(s[0], s[1]);
  };
  Sheet by_default = rectangle(GetParam(), 2.0, 1.0);
  EXPECT_NEAR(axial_stiffness(by_default), 0.300, 1e-3);
  Sheet across = rectangle(GetParam(), 2.0, 1.0);
  Orientation turned;
  turned.rotation_axis = 2;
  turned.additional_rotation = 0.5 * M_PI;
  across.model.orientations.push_back(turned);
  across.model.sections[0].orientation = 0;
  EXPECT_NEAR(axial_stiffness(across), 0.010, 1e-4);
  Sheet cylinder = rectangle(GetParam(), 2.0, 1.0);  // axis along y far below: its tangent is the x axis
  Orientation cylindrical;
  cylindrical.system = Orientation::System::cylindrical;
  cylindrical.origin = {1.0, 0.0, -1e4};
  cylindrical.axes = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  cylinder.model.orientations.push_back(cylindrical);
  cylinder.model.sections[0].orientation = 0;
  EXPECT_NEAR(axial_stiffness(cylinder), 0.300, 1e-3);
  Sheet standing = rectangle(GetParam(), 2.0, 1.0);
  for (Point& x : standing.model.nodes.coordinates) x = {0.0, x[0], x[1]};
  standing.set_law("lamina", {300.0, 10.0, 0.0, 5.0, 5.0, 5.0});
  standing.build();
  standing.position = standing.positions([](const Point& x) { return Point{x[0], x[1], 1.001 * x[2]}; });
  std::array<double, 6> s{};
  standing.group->output("S", 0, 0, {standing.position.data()}, standing.initial_history(), s);
  EXPECT_NEAR(s[0], 0.300, 1e-3);
}

TEST_P(Membrane, ElementWithoutAreaIsRefused) {
  Sheet sheet = rectangle(GetParam(), 2.0, 0.0);
  try {
    sheet.build();
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("membrane 1 has no area"), std::string::npos) << error.what();
  }
}

// p r0 / (4 C10 t0) = 1/l - 1/l^7 of a thin incompressible sphere, as the force on a flat square under equal stretch l: the first
// Piola-Kirchhoff stress is 2 C10 (l - 1/l^5). Values: VERIFY table BALLOON.
TEST_P(Membrane, EquibiaxialRubberCarriesTheBalloonPressure) {
  const std::array<std::array<double, 2>, 6> balloon{
      {{1.1, .39593}, {1.2, .55425}, {1.3831, .61973}, {1.5, .60814}, {2.0, .49219}, {3.0, .33288}}};
  Sheet sheet = rectangle(GetParam(), 1.0, 1.0);
  sheet.set_law("neo-hooke", {10.0, 2e-7});
  sheet.build();
  for (const auto& [stretch, pressure] : balloon) {
    sheet.position = sheet.positions([l = stretch](const Point& x) { return Point{l * x[0], l * x[1], 0.0}; });
    const Eigen::VectorXd f = sheet.force();
    double edge = 0.0;  // resultant on the half with the larger x
    for (int i = 0; i < sheet.group->nodes_per_element(); ++i)
      if (sheet.model.nodes.coordinates[i][0] > 0.5) edge += f[3 * i];
    const double traction = GetParam() == "M3D3" ? edge / (0.5 * 0.5) : edge / 0.5;  // per reference area
    EXPECT_NEAR(2.0 * traction / (stretch * stretch) / (4.0 * 10.0), pressure, 1e-4 * pressure) << stretch;
  }
}

}  // namespace
}  // namespace balocco::test
