// Decks as users and their pre-processors write them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deck_support.hpp"
#include "deck_writer.hpp"
#include "materials/elastic_by_temperature.hpp"

namespace balocco {
namespace {

using test::brick;
using test::errors_of;
using test::read;
using test::static_step;

std::string warnings_of(const std::string& deck) {
  std::string all;
  for (const auto& message : read(deck).warnings) all += message + "\n";
  return all;
}

int count_lines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(UsersDecks, AByteOrderMarkIsSkippedAndUtf16Named) {
  EXPECT_EQ(read("\xEF\xBB\xBF" + brick + static_step).model.heading, "unit brick");
  EXPECT_NE(errors_of(std::string("\xFF\xFE*\0H\0", 6)).find("UTF-16"), std::string::npos);
}

TEST(UsersDecks, LinesMayEndWithReturnsAlone) {
  std::string deck = brick + static_step;
  std::ranges::replace(deck, '\n', '\r');
  EXPECT_EQ(read(deck).model.nodes.size(), 8);
}

TEST(UsersDecks, ACommaBeforeDataIsASlipOfThePen) {
  // No parameter is a number or begins with an asterisk, so these are data and the next keyword.
  const auto model = read(brick + "*NSET, NSET=LEFT,\n1, 4\n*NSET, NSET=RIGHT, GENERATE,\n2, 3,\n*STEP,\n*STATIC,\n.5, 1.\n*END STEP,").model;
  EXPECT_EQ(model.node_sets[1].nodes.size(), 2u);
  EXPECT_EQ(std::get<StaticProcedure>(model.steps[0].procedure).initial_increment, 0.5);
  // A name may be a parameter: refused once, with the comma.
  const auto errors = errors_of(brick + "*STEP\n*STATIC\n*BOUNDARY,\nALLN, 1, 3\n*END STEP\n");
  EXPECT_EQ(errors,
            "job.inp:23: error: *BOUNDARY: a comma ends the line above, which makes this line, beginning with 'ALLN', part of the "
            "keyword; remove the comma if it is a data line\n");
}

TEST(UsersDecks, ParametersGoOnOverLines) {
  const auto model = read(brick + "*SURFACE INTERACTION,\n** of rubber\n  NAME=DRY\n*STEP, NAME=A,\nNLGEOM,\nINC=7\n*STATIC\n*END STEP\n").model;
  EXPECT_EQ(model.interactions[0].name, "DRY");
  EXPECT_EQ(std::get<StaticProcedure>(model.steps[0].procedure).maximum_increments, 7);
  const auto errors = errors_of(replaced(brick, "ELSET=ALL, MATERIAL=STEEL", "ELSET=ALL,\nMATERAIL=STEEL") + static_step);
  EXPECT_NE(errors.find("parameter MATERAIL is unknown or not supported; did you mean MATERIAL?"), std::string::npos) << errors;
}

TEST(UsersDecks, NamesAndChoicesMayBeAbbreviated) {
  const auto model = read(replaced(brick, "*ELASTIC", "*ELASTIC, TYPE=ISO") + "*AMPLITUDE, NAME=A, DEF=SMOOTH\n0., 0., 1., 1.\n" +
                          "*STEP\n*STATIC\n*CLOAD, AMP=A\n7, 1, 2.\n*END STEP\n")
                         .model;
  EXPECT_EQ(model.amplitudes[0].kind, Amplitude::Kind::smooth_step);
  EXPECT_EQ(model.steps[0].concentrated_loads[0].amplitude, 0);
  EXPECT_NE(errors_of(replaced(brick, "*ELASTIC", "*ELASTIC, TYPE=IS") + static_step), "") << "two letters say too little";
  EXPECT_NE(errors_of(brick + "*STEP\n*STATIC\n*OUTPUT, FIELD, TIME=1.\n*END STEP\n"), "") << "three parameters begin with TIME";
}

TEST(UsersDecks, WhatTellsAnotherCodeHowToComputeIsLeftOutWithANote) {
  const std::string warnings =
      warnings_of(brick + "*PREPRINT, ECHO=NO\n*STEP, EXTRAPOLATION=PARABOLIC\n*STATIC, SOLVER=PARDISO\n*PRINT, RESIDUAL=YES\n*OUTPUT, FREQUENCY=1\n*END STEP\n");
  EXPECT_NE(warnings.find("*STATIC: parameter SOLVER has no counterpart here"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("EXTRAPOLATION"), std::string::npos) << warnings;
  EXPECT_NE(errors_of(brick + "*STEP\n*STATIC, RIKS\n*END STEP\n"), "") << "this one changes the results";
}

TEST(UsersDecks, ShearStiffnessIsOfTheSectionBeforeIt) {
  const std::string parts =
      "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n*ELEMENT, TYPE=S4R, ELSET=SHEET\n1, 1, 2, 3, 4\n"
      "*ELEMENT, TYPE=B31, ELSET=LINE\n2, 1, 2\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n";
  const auto model = read(parts + "*SHELL SECTION, ELSET=SHEET, MATERIAL=M\n1.\n*TRANSVERSE SHEAR STIFFNESS\n4., 5., 1.\n" +
                          "*BEAM SECTION, ELSET=LINE, MATERIAL=M, SECTION=RECT\n1., 2.\n0., 1., 0.\n*TRANSVERSE SHEAR STIFFNESS\n6., 7.\n" + static_step)
                         .model;
  EXPECT_EQ(model.sections[0].shell.transverse_shear[2], 1.0);
  EXPECT_EQ(model.sections[1].beam.shear_stiffness->at(0), 7.0);
}

TEST(UsersDecks, YieldStressesOfSeveralTemperaturesAreRefusedAsSuch) {
  const auto errors = errors_of(replaced(brick, "*DENSITY", "*PLASTIC\n300., 0., 20.\n400., 0.2, 20.\n200., 0., 300.\n*DENSITY") + static_step);
  EXPECT_NE(errors.find("tables of temperature"), std::string::npos) << errors;
  EXPECT_EQ(errors_of(replaced(brick, "*DENSITY", "*PLASTIC\n300., 0., 20.\n400., 0.2, 20.\n*DENSITY") + static_step), "");
}

TEST(UsersDecks, ElasticConstantsOfSeveralTemperaturesAndTiesByContact) {
  const auto full = replaced(brick, "C3D8R", "C3D8");
  const auto material = [&](const std::string& from, const std::string& to) { return read(replaced(full, from, to) + static_step).model.materials[0]; };
  const auto parameters = material("*ELASTIC\n210000., 0.3", "*ELASTIC\n2., 0.3, 20.\n1., 0.2, 300.").parameters;
  EXPECT_EQ(parameters, (std::vector<double>{2.0, 0.3, 20.0, 1.0, 0.2, 300.0}));
  EXPECT_EQ(ElasticTable(parameters).at(10.0).mu, IsotropicElastic::from_young(2.0, 0.3).mu);
  EXPECT_DOUBLE_EQ(ElasticTable(parameters).at(160.0).lambda, IsotropicElastic::from_young(1.5, 0.25).lambda);
  EXPECT_EQ(ElasticTable(parameters).at(400.0).lambda, IsotropicElastic::from_young(1.0, 0.2).lambda);
  EXPECT_EQ(material("*ELASTIC\n210000., 0.3", "*ELASTIC\n2., 0.3, 20.\n2., 0.3, 300.").parameters.size(), 2u);
  const auto deck = replaced(full, "*ELASTIC\n210000., 0.3", "*ELASTIC\n2., 0.3, 20.\n1., 0.2, 300.");
  const auto tied = "*SURFACE INTERACTION, NAME=GLUE\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n1e6\n";
  const auto again = read(write_deck(read(deck + tied + static_step).model)).model;
  EXPECT_EQ(again.materials[0].parameters, parameters);
  EXPECT_EQ(again.interactions[0].behavior.slope, 1e6);
  EXPECT_TRUE(std::isinf(again.interactions[0].behavior.tension));
  EXPECT_EQ(material("7.8E-9", "2., 20.\n2., 300.").density, 2.0);
  EXPECT_NE(errors_of(replaced(brick, "7.8E-9", "2., 20.\n3., 300.") + static_step).find("tables of temperature"), std::string::npos);
  const auto falling = errors_of(replaced(brick, "*ELASTIC\n210000., 0.3", "*ELASTIC\n2., 0.3, 20.\n1., 0.2, 10.") + static_step);
  EXPECT_NE(falling.find("list them rising"), std::string::npos) << falling;
}

TEST(UsersDecks, MotionsBeforeTheFirstStepAreOfTheFirstStep) {
  const auto steps = read(brick + "*BOUNDARY\n1, 1, 1, 0.5\n" + static_step + "*STEP, NAME=B\n*STATIC\n*END STEP\n").model.steps;
  const auto of = [](const Step& step) {
    return *std::ranges::find_if(step.boundary, [](const auto& condition) { return condition.magnitude != 0.0; });
  };
  EXPECT_EQ(of(steps[0]).magnitude, 0.5);
  EXPECT_FALSE(of(steps[0]).propagated);
  EXPECT_TRUE(of(steps[1]).propagated);
}

TEST(UsersDecks, WhatNeedsFlowsOfHeatIsLeftOutWithANote) {
  const auto result = read(replaced(brick, "*DENSITY", "*EXPANSION, ZERO=20.\n1.2E-5\n*CONDUCTIVITY\n50.\n*DENSITY") +
                           "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15\n" + static_step);
  EXPECT_EQ(result.warnings.size(), 2u);
  EXPECT_EQ(result.model.materials[0].expansion->reference, 20.0);
  EXPECT_EQ(result.model.materials[0].density, 7.8e-9);
}

TEST(UsersDecks, CheckpointsMayBeAskedForBeforeTheSteps) {
  const auto steps = read(brick + "*RESTART, WRITE, FREQUENCY=5\n" + static_step + "*STEP, NAME=B\n*STATIC\n*RESTART, WRITE, FREQUENCY=0\n*END STEP\n").model.steps;
  EXPECT_EQ(steps[0].checkpoint_frequency, 5);
  EXPECT_FALSE(steps[1].checkpoint_frequency);
}

TEST(UsersDecks, FilesOfWindows) {
  EXPECT_EQ(read("*INCLUDE, INPUT=mesh\\brick.inc\n" + static_step, {{"mesh/brick.inc", brick}}).model.nodes.size(), 8);
}

TEST(UsersDecks, OutputRequestsOfOtherCodes) {
  const auto steps = read(brick + "*STEP\n*STATIC\n*OUTPUT, FREQUENCY=3\n*END STEP\n*STEP\n*DYNAMIC, EXPLICIT\n, 2.\n"
                          "*OUTPUT, FIELD, NAME=U, , NUMBER INTERVAL=4\n*NODE OUTPUT\nU,\n*OUTPUT, HISTORY, NAME=E, NUMBER INTERVAL=10\n"
                          "*ENERGY OUTPUT\nALLKE,\nALLIE,\n*END STEP\n")
                         .model.steps;
  EXPECT_EQ(steps[0].field_outputs[0].frequency, 3);
  EXPECT_EQ(steps[0].field_outputs[0].node_variables.size(), 4u);
  EXPECT_EQ(steps[1].field_outputs[0].number_interval, 4);
  EXPECT_DOUBLE_EQ(*steps[1].history_outputs[0].time_interval, 0.2);
}

const std::string part =
    "*PART, NAME=Pad\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n"
    "*ELEMENT, TYPE=C3D8R\n5, 1, 2, 3, 4, 5, 6, 7, 8\n*ELSET, ELSET=ALL\n5\n*SOLID SECTION, ELSET=ALL, MATERIAL=M\n,\n*END PART\n";
const std::string material = "*MATERIAL, NAME=M, DESCRIPTION=\"soft, of the shelf\"\n*ELASTIC\n1., 0.3\n";

TEST(UsersDecks, InstancesHaveSetsAndKnowTheirIds) {
  const auto model = read(part + "*PART, NAME=Ball\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=Pad, NSET=FIRST, ELSET=E1\n*END INSTANCE\n"
                          "*INSTANCE, NAME=P-2, PART=Pad\n10., 0., 0.\n10., 0., 0., 10., 0., 1., 90.\n*END INSTANCE\n"
                          "*INSTANCE, NAME=Ball-1, PART=Ball\n0., 0.2, 0.\n*NODE\n1, 0., 4., 0.\n*NSET, NSET=REF, INTERNAL\n1,\n"
                          "*SURFACE, TYPE=REVOLUTION, NAME=SKIN\nSTART, 4., 4.\nCIRCL, 0., 0., 0., 4.\n*RIGID BODY, REF NODE=REF, ANALYTICAL SURFACE=SKIN\n*END INSTANCE\n"
                          "*NODE\n1, 5., 5., 5.\n*NSET, NSET=TOP, INSTANCE=P-2\n5, 6, 7, 8\n*NSET, NSET=CORNERS\nP-1.7, P-2.7\n*END ASSEMBLY\n" +
                          material + "*STEP\n*STATIC\n*END STEP\n")
                         .model;
  ASSERT_EQ(model.instances.size(), 4u) << "the assembly is the first";
  const auto set = [&](const std::string& name) {
    return *std::ranges::find(model.node_sets, name, &NodeSet::name);
  };
  EXPECT_EQ(set("FIRST").nodes.size(), 8u);
  EXPECT_EQ(model.node_name(set("TOP").nodes[0]), "P-2.5");
  EXPECT_EQ(model.node_name(set("CORNERS").nodes[1]), "P-2.7");
  EXPECT_EQ(model.node_name(model.nodes.size() - 1), "1") << "of the assembly";
  EXPECT_EQ(model.element_name({0, 1}), "P-2.5");
  EXPECT_NEAR(model.nodes.coordinates[set("CORNERS").nodes[1]][1], 1.0, 1e-12);
}

TEST(UsersDecks, NoGuessIsBetterThanAWrongOne) {
  for (const std::string keyword : {"*ELASTICITY OF ROCK", "*PLASTER", "*PERMEABILITY", "*MASS SCALING"})
    EXPECT_EQ(errors_of(brick + keyword + "\n" + static_step).find("did you mean"), std::string::npos) << keyword;
  EXPECT_EQ(errors_of(replaced(brick, "C3D8R", "C3D10")).find("did you mean"), std::string::npos);
  EXPECT_EQ(errors_of(replaced(brick, "C3D8R", "C3D4")).find("did you mean"), std::string::npos);
  EXPECT_NE(errors_of(replaced(brick, "C3D8R", "C3DR8")).find("did you mean C3D8"), std::string::npos);
  EXPECT_NE(errors_of(replaced(brick, "*ELASTIC", "*ELATSIC")).find("did you mean *ELASTIC?"), std::string::npos);
}

TEST(UsersDecks, AllThatIsUndefinedIsTold) {
  const std::string errors = errors_of(brick + "*ELSET, ELSET=E2\n1, 9, 10\n*NSET, NSET=N2\n1, 77, 99\n*NSET, NSET=N3\nNOSUCH\n"
                                       "*STEP\n*STATIC\n*BOUNDARY\nGHOST, 1, 3\nN2, 1\n*END STEP\n");
  for (const std::string missing : {"element 9 ", "element 10 ", "node 77 ", "node 99 ", "node set NOSUCH ", "node set GHOST "})
    EXPECT_NE(errors.find(missing), std::string::npos) << missing << "\n" << errors;
  EXPECT_EQ(count_lines(errors), 6) << errors;
}

TEST(UsersDecks, LeftoversOfAMesherAreNamed) {
  const std::string line = "*ELEMENT, TYPE=T3D2, ELSET=Line1\n101, 1, 2\n102, 2, 3\n";
  const std::string mixed = errors_of(replaced(brick, "*MATERIAL", line + "*ELSET, ELSET=ALL\nLine1\n*MATERIAL") + static_step);
  EXPECT_NE(mixed.find("element 101 (job.inp:15) of type T3D2 is a line and cannot have this section, while element 1 is of type "
                       "C3D8R; take the 2 elements of type T3D2 out of set ALL"),
            std::string::npos)
      << mixed;
  EXPECT_NE(errors_of(brick + line + static_step).find("delete it if a mesher left it there"), std::string::npos);
  const std::string faces = errors_of(brick + "*ELEMENT, TYPE=CPS4, ELSET=Surface1\n201, 1, 2, 3, 4\n" + static_step);
  EXPECT_NE(faces.find("CPS4 (element 201 of set SURFACE1) is unknown or not supported"), std::string::npos) << faces;
  EXPECT_NE(faces.find("plane faces that a mesher wrote"), std::string::npos) << faces;
}

TEST(UsersDecks, ALonelyNodeIsToldAndItsLoadRefused) {
  const std::string lonely = brick + "*NODE\n99, 5., 5., 5.\n";
  EXPECT_NE(warnings_of(lonely + static_step).find("*NODE: node 99 belongs to no element and no rigid body"), std::string::npos);
  const std::string errors = errors_of(lonely + "*STEP\n*STATIC\n*CLOAD\n99, 1, 2.\n*END STEP\n");
  EXPECT_NE(errors.find("job.inp:25: error: *CLOAD: node 99 belongs to no element"), std::string::npos) << errors;
}

TEST(UsersDecks, AFoldedBrickIsRefusedThoughItHasAVolume) {
  for (const std::string type : {"C3D8", "C3D8R"}) {
    const auto deck = replaced(replaced(brick, "C3D8R", type), "1, 1, 2, 3, 4, 5, 6, 7, 8", "1, 1, 2, 3, 4, 5, 6, 8, 7");
    EXPECT_NE(errors_of(deck + static_step).find("job.inp:13: error: *ELEMENT: element 1 is folded"), std::string::npos) << type;
  }
}

TEST(UsersDecks, FrictionTablesOfOneLineHold) {
  const auto model = read(brick + "*SURFACE INTERACTION, NAME=I\n*FRICTION\n0.2, 0.0, 0.0, 0.0\n" + static_step).model;
  EXPECT_EQ(model.interactions[0].friction, 0.2);
}

/// The centroid lies at 12.21304...: what the message tells is accepted, and so are four digits.
TEST(UsersDecks, TheHeightOfACentroidMayBeRounded) {
  const auto deck = [](const std::string& height) {
    return "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n*ELEMENT, TYPE=B31, ELSET=A\n1, 1, 2\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n"
           "*BEAM SECTION, SECTION=I, ELSET=A, MATERIAL=M\n" + height + ", 20., 8., 12., 1., 2., 1.5\n0., 1., 0.\n" + static_step;
  };
  EXPECT_NE(errors_of(deck("12.")).find("l = 12.213;"), std::string::npos);
  for (const std::string height : {"12.213", "12.21", "12.2130434783"}) EXPECT_EQ(errors_of(deck(height)), "") << height;
}

TEST(UsersDecks, ThermalSofteningIsToldToHaveNoEffect) {
  const auto deck = [](const std::string& more) { return replaced(brick, "*DENSITY", "*PLASTIC, HARDENING=JOHNSON COOK\n300., 400., 0.3" + more + "\n*DENSITY") + static_step; };
  for (const std::string more : {"", ", 0.", ", 0., 0., 0."}) EXPECT_EQ(warnings_of(deck(more)), "") << more;
  for (const std::string more : {", 1.03", ", 1.03, 1793., 293."}) {
    EXPECT_NE(warnings_of(deck(more)).find("the factor of thermal softening, with m, is 1"), std::string::npos) << more;
    EXPECT_EQ(read(deck(more)).model.materials[0].options[0].rows[0], (std::vector<double>{300., 400., 0.3}));
  }
  EXPECT_NE(errors_of(deck(", 1., 2., 3., 4.")), "");
}

TEST(UsersDecks, ControlsOfDeletionAndDistortionAreNoReasonToRefuse) {
  EXPECT_EQ(warnings_of(brick + "*SECTION CONTROLS, NAME=C, ELEMENT DELETION=YES\n" + static_step), "");
  EXPECT_NE(warnings_of(brick + "*SECTION CONTROLS, NAME=C, DISTORTION CONTROL=YES, LENGTH RATIO=0.1\n" + static_step).find("DISTORTION CONTROL"), std::string::npos);
}

}  // namespace
}  // namespace balocco
