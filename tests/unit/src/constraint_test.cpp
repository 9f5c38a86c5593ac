// Every kind of constraint: derivatives against differences, and nothing is felt of rigid motions.
#include "constraints/constraint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "constraints/linkages.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

Model sample_model() {
  Model model;
  for (const Point& x : {Point{0.1, 0.2, 0.3}, Point{1.3, 0.1, -0.4}, Point{0.9, 1.2, 0.2}, Point{-0.3, 0.8, 0.7}, Point{0.4, -0.6, 1.1}}) {
    model.nodes.row_of_id[model.nodes.size() + 1] = model.nodes.size();
    model.nodes.id.push_back(model.nodes.size() + 1);
    model.nodes.coordinates.push_back(x);
  }
  using Part = Joint::Part;
  const std::array<std::array<double, 3>, 3> axes{{{0.6, 0.8, 0.0}, {-0.8, 0.6, 0.0}, {0.0, 0.0, 1.0}}};
  const auto joint = [&](std::vector<Joint::Piece> pieces) {
    model.constraints.push_back({Joint{.nodes = {0, 1}, .pieces = std::move(pieces), .axes = axes, .second_axes = axes}, "*MPC", -1, 0});
  };
  joint({{.part = Part::offset}, {.part = Part::align}});
  joint({{.part = Part::offset, .along = {true, false, true}}, {.part = Part::revolute}});
  joint({{.part = Part::slot}, {.part = Part::universal}});
  joint({{.part = Part::plane}, {.part = Part::distance}, {.part = Part::align, .along = {false, true, false}}});
  model.constraints.push_back({DistributingCoupling{0, {1, 2, 3, 4}, {1.0, 2.0, 0.5, 1.5}}, "*COUPLING", -1, 0});
  model.constraints.push_back({Tie{0, {1, 2, 3}, {0.3, 0.5, 0.2}, true, true}, "*TIE", -1, 0});
  model.constraints.push_back({Tie{0, {1, 2, 3}, {0.3, 0.5, 0.2}, false, false}, "*TIE", -1, 0});
  model.constraints.push_back({LinearEquation{{{0, 0, 1.0}, {1, 1, -2.0}, {2, 5, 0.5}, {0, 3, 0.7}}}, "*EQUATION", -1, 0});
  model.constraints.push_back({Alignment{{0, 1, 2, 3}}, "*MPC", -1, 0});
  model.constraints.push_back({Alignment{{0, 1, 2}}, "*MPC", -1, 0});
  model.constraints.push_back({MeanRotation{{0, 1, 2, 3}, 4, {0.6, 0.0, 0.8}}, "*MPC", -1, 0});
  return model;
}

std::vector<NodePlace> places_at_start(const Model& model, const Constraint& constraint) {
  std::vector<NodePlace> places;
  for (const auto row : constraint.nodes()) places.push_back({.position = {model.nodes.coordinates[row]}});
  return places;
}

void turn(NodePlace& place, const Vector3<double>& spin) {
  place.rotation = rotation_matrix(exponential(spin)) * place.rotation;
  place.turn = place.turn + spin;
}

/// Away from the start, and different for every node.
std::vector<NodePlace> disturbed(std::vector<NodePlace> places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double s = 0.1 * static_cast<double>(i + 1);
    places[i].position = places[i].position + Vector3<double>{{s, -0.5 * s, 0.3 * s}};
    turn(places[i], {{0.4 * s, 0.7, -s}});
  }
  return places;
}

void move(NodePlace& place, int column, double by) {
  if (column < 3) {
    place.position[column] += by;
    return;
  }
  Vector3<double> spin{};
  spin[column - 3] = by;
  turn(place, spin);
}

std::vector<double> gradient_at(const Constraint& constraint, const std::vector<NodePlace>& places) {
  std::vector<double> gradient(static_cast<std::size_t>(constraint.rows() * constraint.columns()));
  constraint.gradient(places, gradient);
  return gradient;
}

constexpr double step = 1e-5;

TEST(Constraints, GradientsAreThoseOfDifferences) {
  const auto model = sample_model();
  for (const auto& constraint : make_constraints(model)) {
    const auto places = disturbed(places_at_start(model, *constraint));
    const auto gradient = gradient_at(*constraint, places);
    std::vector<double> ahead(constraint->rows()), behind(constraint->rows());
    for (int column = 0; column < constraint->columns(); ++column) {
      if (column % 6 >= 3 && !constraint->turns(column / 6)) continue;
      auto one = places, other = places;
      move(one[column / 6], column % 6, step);
      move(other[column / 6], column % 6, -step);
      constraint->gaps(one, ahead);
      constraint->gaps(other, behind);
      for (int row = 0; row < constraint->rows(); ++row)
        EXPECT_NEAR(gradient[row * constraint->columns() + column], (ahead[row] - behind[row]) / (2.0 * step), 1e-9);
    }
  }
}

TEST(Constraints, CurvaturesAreThoseOfDifferences) {
  const auto model = sample_model();
  for (const auto& constraint : make_constraints(model)) {
    const auto places = disturbed(places_at_start(model, *constraint));
    const auto width = static_cast<std::size_t>(constraint->columns());
    std::vector<double> multipliers;
    for (int row = 0; row < constraint->rows(); ++row) multipliers.push_back(1.0 + 0.3 * row);
    const bool coupled = constraint->couples_all();
    std::vector<double> pairs(144 * (constraint->nodes().size() - 1), 0.0), whole(width * width, 0.0);
    constraint->add_curvature(places, multipliers, coupled ? whole : pairs);
    for (std::size_t node = 1; node < constraint->nodes().size() && !coupled; ++node)
      for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t j = 0; j < 12; ++j) {
          const auto place = [&](std::size_t k) { return k < 6 ? k : 6 * (node - 1) + k; };
          whole[place(i) * width + place(j)] += pairs[144 * (node - 1) + 12 * i + j];
        }
    for (std::size_t column = 0; column < width; ++column) {
      if (column % 6 >= 3 && !constraint->turns(static_cast<int>(column / 6))) continue;
      auto one = places, other = places;
      move(one[column / 6], static_cast<int>(column % 6), step);
      move(other[column / 6], static_cast<int>(column % 6), -step);
      const auto ahead = gradient_at(*constraint, one), behind = gradient_at(*constraint, other);
      for (std::size_t i = 0; i < width; ++i) {
        if (i % 6 >= 3 && !constraint->turns(static_cast<int>(i / 6))) continue;
        double difference = 0.0;
        for (std::size_t row = 0; row < multipliers.size(); ++row)
          difference += multipliers[row] * (ahead[row * width + i] - behind[row * width + i]) / (2.0 * step);
        EXPECT_NEAR(whole[i * width + column], difference, 1e-8) << "force " << i << ", motion " << column;
      }
    }
  }
}

TEST(Constraints, NothingIsFeltOfRigidMotions) {
  auto model = sample_model();
  std::erase_if(model.constraints, [](const auto& definition) {  // the others hold in no other place, or feel turns
    return std::holds_alternative<MeanRotation>(definition.kind) || std::holds_alternative<Alignment>(definition.kind);
  });
  for (const auto& constraint : make_constraints(model)) {
    if (constraint->is_linear()) continue;
    auto places = places_at_start(model, *constraint);
    const Vector3<double> spin{{0.8, -1.1, 0.4}}, shift{{3.0, -2.0, 1.0}};
    for (auto& place : places) {
      place.position = rotation_matrix(exponential(spin)) * place.position + shift;
      turn(place, spin);
    }
    std::vector<double> gaps(constraint->rows());
    constraint->gaps(places, gaps);
    for (const double gap : gaps) EXPECT_NEAR(gap, 0.0, 1e-14);
  }
}

/// A turn about the axis is the first displacement of the last node; shifts, and motions along the axis, are none.
TEST(Constraints, TheMeanRotationIsThatOfARigidTurn) {
  Model model = sample_model();
  std::erase_if(model.constraints, [](const auto& definition) { return !std::holds_alternative<MeanRotation>(definition.kind); });
  const auto constraint = std::move(make_constraints(model).front());
  auto places = places_at_start(model, *constraint);
  const double angle = 0.9;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double along = 0.1 * static_cast<double>(i);
    places[i].position = rotation_matrix(exponential(Vector3<double>{{0.6 * angle, 0.0, 0.8 * angle}})) * places[i].position +
                         Vector3<double>{{2.0 + 0.6 * along, -1.0, 3.0 + 0.8 * along}};
  }
  std::vector<double> gap(3);
  constraint->gaps(places, gap);
  EXPECT_GT(gap[0], 0.1);
  places.back().position[0] += angle;
  constraint->gaps(places, gap);
  EXPECT_NEAR(gap[0], 0.0, 1e-14);
}

TEST(Constraints, RowsThatOthersImplyAreFound) {
  const std::vector<SparseRow> rows{{{0, 1.0}, {1, -1.0}}, {{1, 1.0}, {2, -1.0}}, {{0, 2.0}, {2, -2.0}}, {{3, 1.0}, {0, 1.0}}, {}, {{7, 0.0}}};
  EXPECT_EQ(dependent_rows(rows), (std::vector<bool>{false, false, true, false, true, true}));
}

TEST(Constraints, RowsOfManySmallSystemsAreJudgedEachInItsOwn) {
  std::vector<SparseRow> rows;  // as of a car's two thousand welds: all at once they would take hours
  for (std::int64_t column = 0; column < 30000; column += 3)
    for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 2}}) rows.push_back({{column + a, 1.0}, {column + b, -1.0}});
  const auto dependent = dependent_rows(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(dependent[i], i % 3 == 2);
}

TEST(Constraints, SharedNodesMakeALinkage) {
  auto model = sample_model();
  for (int i = 0; i < 4; ++i) {
    model.nodes.coordinates.push_back({1.0 * i, 5.0, 0.0});
    model.nodes.id.push_back(model.nodes.size() + 1);
  }
  model.constraints.push_back({LinearEquation{{{5, 0, 1.0}, {6, 0, -1.0}}}, "*EQUATION", -1, 0});
  const auto linkages = find_linkages(model);
  ASSERT_EQ(linkages.size(), 2U);
  EXPECT_EQ(linkages[0].nodes.size(), 5U);
  EXPECT_EQ(linkages[1].nodes, (std::vector<std::int32_t>{5, 6}));
  EXPECT_FALSE(linkages[1].has_bodies);
}

}  // namespace

}  // namespace balocco
