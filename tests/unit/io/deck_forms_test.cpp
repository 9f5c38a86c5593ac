// Forms of keywords that CalculiX has beside Abaqus's, or both have and few decks use.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "deck_support.hpp"
#include "deck_writer.hpp"
#include "model/check.hpp"

namespace balocco {
namespace {

using test::brick;
using test::errors_of;
using test::read;

const std::string equations = "*EQUATION\n2\n5, 3, 1., 6, 3, -1.\n2\n7, 3, 1., 8, 3, -1.\n2\n7, 1, 1., 8, 1, -1.\n";

std::vector<std::int32_t> removed(const std::string& text, std::size_t step = 0) {
  return read(brick + equations + "*STEP\n*STATIC\n" + text + "*END STEP\n*STEP\n*STATIC\n*END STEP\n")
      .model.steps[step]
      .removed_constraints;
}

TEST(DeckForms, EquationsAreTakenOutByTheirFirstTerm) {
  EXPECT_EQ(removed("*EQUATION, REMOVE\n7, 3\n"), (std::vector<std::int32_t>{1}));
  EXPECT_EQ(removed("*EQUATION, REMOVE\nALLN, 3\n"), (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(removed("*EQUATION, REMOVE ALL\n", 1), (std::vector<std::int32_t>{0, 1, 2})) << "steps to come go without them";
  const auto errors = [](const std::string& text) {
    return errors_of(brick + equations + "*STEP\n*STATIC\n" + text + "*END STEP\n");
  };
  EXPECT_EQ(errors("*EQUATION, REMOVE\n8, 3\n"),
            "job.inp:30: error: *EQUATION: no *EQUATION has degree of freedom 3 of 8 as its first term; correct the line\n");
  EXPECT_NE(errors("*EQUATION\n2\n5, 1, 1., 6, 1, -1.\n").find("equations hold from the start; move it before the first *STEP"),
            std::string::npos);
  EXPECT_NE(errors_of(brick + equations + "*EQUATION, REMOVE ALL\n").find("REMOVE takes equations out of a step; move it into one"),
            std::string::npos);
}

TEST(DeckForms, ExplicitStepsKeepTheirEquations) {
  const auto deck = brick + equations + "*STEP\n*DYNAMIC, EXPLICIT\n, 1.\n*EQUATION, REMOVE\n7, 3\n*END STEP\n";
  EXPECT_NE(errors_of(deck).find("is explicit and goes without it, which implicit steps alone can"), std::string::npos)
      << errors_of(deck);
}

TEST(DeckForms, AMeanRotationHasAnAxisAndNodesAroundIt) {
  const auto deck = [](const std::string& axis, const std::string& line) {
    return brick + "*NODE\n20, " + axis + "\n30, 0.5, 0.5, 1.\n*MPC\nMEANROT, " + line + "\n*STEP\n*STATIC\n*END STEP\n";
  };
  const auto model = read(deck("0., 0., 2.", "5, 5, 5, 6, 6, 6, 7, 7, 7, 8, 8, 8, 20")).model;
  const auto& rotation = std::get<MeanRotation>(model.constraints.front().kind);
  EXPECT_EQ(rotation.nodes, (std::vector<std::int32_t>{4, 5, 6, 7}));
  EXPECT_EQ(rotation.axis, (Point{0.0, 0.0, 1.0}));
  EXPECT_NE(errors_of(deck("0., 0., 2.", "5, 5, 6, 6, 7, 7, 20")).find("MEANROT is followed by a, a, a, b, b, b ... c"),
            std::string::npos);
  EXPECT_NE(errors_of(deck("0., 0., 0.", "5, 5, 5, 6, 6, 6, 20")).find("which are the axis, are zero; give a direction"),
            std::string::npos);
  EXPECT_NE(errors_of(deck("0., 0., 1.", "5, 5, 5, 7, 7, 7, 30, 30, 30, 20")).find("node 30 lies on the axis"), std::string::npos);
}

TEST(DeckForms, ADistributionGivesElementsTheirDirections) {
  const std::string nodes = "*NODE, NSET=N\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n",
                    upper =
                        "5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n"
                        "9, 0, 0, 2\n10, 1, 0, 2\n11, 1, 1, 2\n12, 0, 1, 2\n13, 0, 0, 3\n14, 1, 0, 3\n15, 1, 1, 3\n16, 0, 1, 3\n";
  const std::string mesh = nodes + upper +
                           "*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 5, 6, 7, 8, 9, 10, 11, 12\n"
                           "3, 9, 10, 11, 12, 13, 14, 15, 16\n*ELSET, ELSET=LAST\n3\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n";
  const std::string section = "*ORIENTATION, NAME=O\nD\n*SOLID SECTION, ELSET=E, MATERIAL=M, ORIENTATION=O\n";
  const auto deck = [&](const std::string& lines) { return mesh + "*DISTRIBUTION, NAME=D\n" + lines + section; };
  const auto model = read(deck(", 1., 0., 0., 0., 1., 0.\nLAST, 0., 1., 0., -1., 0., 0.\n1, 0., 0., 1., 1., 0., 0.\n")).model;
  const auto first_axis = [&](int element) {
    return model.orientations[0].of_element[element].second[0];
  };
  EXPECT_EQ(first_axis(0), (Point{0.0, 0.0, 1.0}));
  EXPECT_EQ(first_axis(1), (Point{1.0, 0.0, 0.0}));
  EXPECT_EQ(first_axis(2), (Point{0.0, 1.0, 0.0}));
  EXPECT_NE(errors_of(deck("1, 0., 0., 1., 1., 0., 0.\n")).find("gives element 2 no directions"), std::string::npos);
  EXPECT_NE(errors_of(deck(", 1., 0., 0., 2., 0., 0.\n")).find("points a and b define no axes"), std::string::npos);
}

TEST(DeckForms, TablesAreAskedForAtTimePoints) {
  const auto deck = [](const std::string& print) {
    return brick + "*TIME POINTS, NAME=T\n0.25, 0.5\n*STEP\n*STATIC\n" + print + "*END STEP\n";
  };
  const auto model = read(deck("*NODE PRINT, NSET=ALLN, TIMEPOINTS=T\nU\n*EL PRINT, ELSET=ALL, TOTALS=ONLY\nENER, COORD\n")).model;
  EXPECT_EQ(model.steps[0].print_outputs[0].time_points, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(model.steps[0].print_outputs[1].variables, (std::vector<std::string>{"ENER", "COORD"}));
  EXPECT_NE(errors_of(deck("*NODE PRINT, NSET=ALLN, TIME POINTS=S\nU\n")).find("time points S are not defined"), std::string::npos);
  EXPECT_NE(
      errors_of(deck("*NODE PRINT, NSET=ALLN, TIME POINTS=T, FREQUENCY=2\nU\n")).find("give one of FREQUENCY and TIME POINTS"),
      std::string::npos);
}

TEST(DeckForms, GeneratedIdsWithoutNodesAreKeptForTables) {
  const auto model = read(brick + "*NODE\n12, 0., 0., 3.\n*NSET, NSET=S, GENERATE\n7, 20\n*STEP\n*STATIC\n*END STEP\n").model;
  const auto set = std::ranges::find(model.node_sets, "S", &NodeSet::name);
  EXPECT_EQ(set->nodes, (std::vector<std::int32_t>{6, 7, 8}));
  EXPECT_EQ(set->absent, (std::vector<std::int64_t>{9, 10, 11})) << "ids beyond the last node are not";
  EXPECT_EQ(set->deck_order, (std::vector<std::int32_t>{6, 7, -1, -2, -3, 8}));
}

TEST(DeckForms, DampingOfAllModesAndIncrementsThatGrow) {
  const auto deck = [](const std::string& step) {
    return brick + "*STEP\n*FREQUENCY, SOLVER=ARPACK\n3\n*END STEP\n*STEP\n" + step + "*END STEP\n";
  };
  const auto model = read(deck("*MODAL DYNAMIC, DIRECT=NO, DELTMX=0.5\n1e-3, 1.\n*MODAL DAMPING, RAYLEIGH\n, , 7., 0.1\n")).model;
  const auto& procedure = std::get<ModalDynamicProcedure>(model.steps[1].procedure);
  EXPECT_EQ(procedure.largest_load_change, 0.5);
  EXPECT_EQ(procedure.damping.front().first, 1);
  EXPECT_EQ(procedure.damping.front().last, std::numeric_limits<std::int32_t>::max());
  EXPECT_NE(errors_of(deck("*MODAL DYNAMIC, DIRECT=NO\n1e-3, 1.\n")).find("belong together; give both, or none"),
            std::string::npos);
  EXPECT_NE(errors_of(deck("*MODAL DYNAMIC, DIRECT=NO, DELTMX=0.\n1e-3, 1.\n")).find("DELTMX must be positive"), std::string::npos);
}

TEST(DeckForms, HarmonicLoadsHaveTwoPartsAndAnAmplitudeOverTheFrequency) {
  const std::string before = brick + "*AMPLITUDE, NAME=A\n0., 1., 10., 3.\n*STEP\n*FREQUENCY\n3\n*END STEP\n*STEP\n";
  const auto model = read(before + "*STEADY STATE DYNAMICS\n1., 20.\n30.\n*MODAL DAMPING, STRUCTURAL\n1, 3, 0.04\n*CLOAD\n7, 1, 2.\n"
                          "*CLOAD, LOAD CASE=2, AMPLITUDE=A\n7, 1, 5.\n*DLOAD, REAL\nALL, P1, 3.\n*DLOAD, IMAGINARY\nALL, P1, 4.\nALL, GRAV, 9., 0., 0., 1.\n"
                          "*BASE MOTION, DOF=4, TYPE=VELOCITY, SCALE=0.5, AMPLITUDE=A, IMAGINARY\n1., 2., 3.\n*END STEP\n").model;
  const auto& step = model.steps[1];
  const auto& procedure = std::get<SteadyStateProcedure>(step.procedure);
  EXPECT_TRUE(procedure.logarithmic);
  ASSERT_EQ(procedure.ranges.size(), 2u);
  EXPECT_EQ(procedure.ranges[0].points, 20);
  EXPECT_EQ(procedure.ranges[0].bias, 3.0);
  EXPECT_EQ(procedure.ranges[1].upper, 30.0) << "one frequency alone";
  EXPECT_EQ(procedure.damping[0].structural, 0.04);
  ASSERT_EQ(step.concentrated_loads.size(), 2u);
  EXPECT_FALSE(step.concentrated_loads[0].imaginary);
  EXPECT_TRUE(step.concentrated_loads[1].imaginary);
  EXPECT_EQ(step.concentrated_loads[1].amplitude, 0);
  ASSERT_EQ(step.surface_loads.size(), 2u);
  EXPECT_NE(step.surface_loads[0].imaginary, step.surface_loads[1].imaginary);
  EXPECT_TRUE(step.body_loads[0].imaginary);
  const auto& motion = procedure.base_motions.at(0);
  EXPECT_EQ(motion.dof, 3);
  EXPECT_EQ(motion.centre, (std::array<double, 3>{1.0, 2.0, 3.0}));
  EXPECT_TRUE(motion.imaginary);
  EXPECT_TRUE(step.history_outputs.empty());
  const auto& shown = step.field_outputs.at(0).element_variables;
  EXPECT_EQ(std::ranges::count(shown, "S"), 1);
  EXPECT_EQ(std::ranges::count(shown, "MISES"), 0) << "it has no real and imaginary part";
  const auto again = read(write_deck(model)).model;
  EXPECT_EQ(write_deck(again), write_deck(model));
  EXPECT_TRUE(std::get<SteadyStateProcedure>(again.steps[1].procedure).base_motions.at(0).imaginary);
  EXPECT_EQ(again.steps[1].surface_loads.size(), 2u);
}

}  // namespace
}  // namespace balocco
