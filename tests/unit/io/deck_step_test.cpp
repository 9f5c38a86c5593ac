// How loads, conditions, contact and output pass from step to step.
#include <gtest/gtest.h>

#include "deck_support.hpp"
#include "deck_writer.hpp"
#include "model/check.hpp"

namespace balocco {
namespace {

using test::brick;
using test::errors_of;
using test::read;

std::vector<Step> steps_of(const std::string& deck) {
  return read(brick + deck).model.steps;
}

TEST(DeckStep, ConditionsPropagateUnlessNew) {
  const auto steps = steps_of(
      "*BOUNDARY\n1, PINNED\n*STEP\n*STATIC\n*BOUNDARY\n2, 1, , 0.5\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY\n2, 1, , "
      "0.7\n"
      "*END STEP\n*STEP\n*STATIC\n*BOUNDARY, OP=NEW, TYPE=VELOCITY\n3, 2, 2, 1.\n*BOUNDARY, FIXED\n4, 1\n*END STEP\n");
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[0].boundary.size(), 4u);
  ASSERT_EQ(steps[1].boundary.size(), 4u);
  EXPECT_TRUE(steps[1].boundary[0].propagated);
  EXPECT_FALSE(steps[1].boundary[3].propagated);
  EXPECT_EQ(steps[1].boundary[3].magnitude, 0.7);
  ASSERT_EQ(steps[2].boundary.size(), 2u);
  EXPECT_EQ(steps[2].boundary[0].kind, BoundaryCondition::Kind::velocity);
  EXPECT_TRUE(steps[2].boundary[1].fixed);
}

TEST(DeckStep, NamedConditionsOnReferenceNodesHoldRotationsToo) {
  const auto model = read(brick +
                          "*NODE\n100\n*NSET, NSET=R\n1, 2\n*RIGID BODY, REF NODE=100, TIE NSET=R\n"
                          "*STEP\n*STATIC\n*BOUNDARY\n100, ENCASTRE\n3, ZSYMM\n*END STEP\n")
                         .model;
  EXPECT_EQ(model.steps[0].boundary.size(), 7u);  // six, and u3 of node 3, which has no rotations
}

TEST(DeckStep, LoadsStartWhereTheyStood) {
  const auto steps = steps_of(
      "*AMPLITUDE, NAME=HALF\n0., 0., 1., 0.5\n*STEP\n*STATIC\n*CLOAD, AMPLITUDE=HALF\n7, 3, 8.\n7, 3, 2.\n8, 3, "
      "1.\n*END STEP\n"
      "*STEP\n*STATIC\n*CLOAD, OP=NEW\n7, 3, 3.\n*END STEP\n*STEP\n*STATIC\n*END STEP\n");
  EXPECT_EQ(steps[0].concentrated_loads[0].magnitude, 10.0);  // two lines of one step add up
  ASSERT_EQ(steps[1].concentrated_loads.size(), 2u);
  EXPECT_EQ(steps[1].concentrated_loads[0].previous, 5.0);
  EXPECT_EQ(steps[1].concentrated_loads[0].magnitude, 3.0);
  EXPECT_EQ(steps[1].concentrated_loads[1].previous, 0.5);  // taken away: it goes from 0.5 to zero over the step
  EXPECT_EQ(steps[1].concentrated_loads[1].magnitude, 0.0);
  ASSERT_EQ(steps[2].concentrated_loads.size(), 1u);
  EXPECT_EQ(steps[2].concentrated_loads[0].previous, 3.0);
}

TEST(DeckStep, CurvesOverStepTimeLeaveWhatTheyReached) {
  const std::string amplitudes =
      "*AMPLITUDE, NAME=HALF\n0., 1., 1., 0.5\n*AMPLITUDE, NAME=DONE\n0., 1., 1., 0.\n*AMPLITUDE, NAME=ALL, TIME=TOTAL TIME\n0., 1., 4., 0.\n";
  const auto steps = steps_of(amplitudes +
                              "*STEP\n*STATIC\n*CLOAD, AMPLITUDE=HALF\n7, 3, 8.\n*CLOAD, AMPLITUDE=DONE\n7, 1, 8.\n*CLOAD, AMPLITUDE=ALL\n8, 3, 4.\n"
                              "*DLOAD, AMPLITUDE=HALF\nALL, P2, 4.\nALL, GRAV, 9., 0., 0., -1.\n*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=HALF\n1, 1, 1, 3.\n"
                              "*BOUNDARY, AMPLITUDE=HALF\n1, 2, 2, 3.\n*END STEP\n*STEP\n*STATIC\n*END STEP\n*STEP\n*STATIC\n*END STEP\n");
  for (const auto& step : {steps[1], steps[2]}) {
    ASSERT_EQ(step.concentrated_loads.size(), 2u);  // what came to nothing is gone
    EXPECT_EQ(step.concentrated_loads[0].magnitude, 4.0);
    EXPECT_EQ(step.concentrated_loads[0].previous, 4.0);
    EXPECT_EQ(step.concentrated_loads[0].amplitude, -1);
    EXPECT_EQ(step.concentrated_loads[1].magnitude, 4.0);
    EXPECT_EQ(step.concentrated_loads[1].amplitude, 2);
    EXPECT_EQ(step.surface_loads[0].magnitude, 2.0);
    EXPECT_EQ(step.body_loads[0].magnitude, 4.5);
    EXPECT_EQ(step.body_loads[0].amplitude, -1);
    EXPECT_EQ(step.boundary[0].magnitude, 1.5);
    EXPECT_EQ(step.boundary[0].amplitude, -1);
    EXPECT_TRUE(step.boundary[1].propagated);  // a displacement stays where it is
  }
  EXPECT_EQ(steps[2].concentrated_loads[1].previous, 2.0);
}

TEST(DeckStep, LoadsOfAStaticStepMayActAtOnce) {
  const auto model = read(brick +
                          "*STEP, AMPLITUDE=STEP\n*STATIC\n*CLOAD\n7, 3, 8.\n*BOUNDARY\n1, 1, 1, 0.5\n2, 1\n*END STEP\n*STEP\n*STATIC\n*END STEP\n")
                         .model;
  ASSERT_EQ(model.amplitudes.size(), 1u);
  EXPECT_EQ(model.amplitudes[0].value(0.0), 1.0);
  EXPECT_EQ(model.amplitudes[0].value(7.0), 1.0);
  EXPECT_EQ(model.steps[0].concentrated_loads[0].amplitude, 0);
  EXPECT_EQ(model.steps[0].boundary[0].amplitude, 0);
  EXPECT_EQ(model.steps[0].boundary[1].amplitude, -1);  // it does not move
  EXPECT_EQ(model.steps[1].concentrated_loads[0].amplitude, -1);
  EXPECT_EQ(model.steps[1].concentrated_loads[0].previous, 8.0);
}

TEST(DeckStep, ControlsOfIncrementsMaySayWhatHoldsAnyway) {
  const auto steps = steps_of(
      "*STEP\n*STATIC\n*CONTROLS, PARAMETERS=TIME INCREMENTATION\n4, 8, 9, 20, 10, 4, 12, 5, 6, 3\n0.25, 0.5, 0.75, 0.85, , , 1.5\n*END STEP\n");
  EXPECT_EQ(std::get<StaticProcedure>(steps[0].procedure).controls.maximum_iterations, 20);
}

TEST(DeckStep, PressureOnFacesAndGravity) {
  const auto model = read(brick + "*STEP\n*STATIC\n*DLOAD\nALL, P2, 4.\n, GRAV, 9.81, 0., 0., -2.\n*END STEP\n").model;
  const Step& step = model.steps[0];
  ASSERT_EQ(step.surface_loads.size(), 1u);
  EXPECT_EQ(model.surfaces[step.surface_loads[0].surface].faces[0].face, 1);
  ASSERT_EQ(step.body_loads.size(), 1u);
  EXPECT_EQ(step.body_loads[0].element_set, -1);
  EXPECT_EQ(step.body_loads[0].direction, (std::array<double, 3>{0, 0, -1}));
}

TEST(DeckStep, ForcesOnAllMatterOfASet) {
  const auto model = read(brick + "*STEP\n*STATIC\n*DLOAD\nALL, CENTRIF, 100., 1., 2., 3., 0., 0., 2.\nALL, BY, -4.\nALL, BY, 5.\n"
                                  "*END STEP\n*STEP\n*STATIC\n*DLOAD\nALL, BY, 6.\n*END STEP\n")
                         .model;
  const auto& loads = model.steps[0].body_loads;
  ASSERT_EQ(loads.size(), 2u);  // a line for the same set and direction takes the place of the first
  EXPECT_EQ(loads[0].kind, BodyLoad::Kind::centrifugal);
  EXPECT_EQ(loads[0].magnitude, 100.0);
  EXPECT_EQ(loads[0].point, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(loads[0].direction, (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(loads[1].kind, BodyLoad::Kind::volume_force);
  EXPECT_EQ(loads[1].magnitude, 5.0);
  EXPECT_EQ(loads[1].direction, (std::array<double, 3>{0, 1, 0}));
  EXPECT_EQ(model.steps[1].body_loads[1].previous, 5.0);
  EXPECT_EQ(model.steps[1].body_loads[1].magnitude, 6.0);
}

TEST(DeckStep, PressureOnAMembraneActsAlongItsNormal) {
  const auto model = read(
                         "*NODE\n1\n2, 1.\n3, 1., 1.\n4, 0., 1.\n*ELEMENT, TYPE=M3D4, ELSET=E\n1, 1, 2, 3, "
                         "4\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n"
                         "*MEMBRANE SECTION, ELSET=E, MATERIAL=M\n0.1\n*STEP\n*STATIC\n*DLOAD\nE, P, 1.\n*END STEP\n")
                         .model;
  EXPECT_EQ(model.surfaces[0].faces[0].face, 1);  // SNEG
}

const std::string contact =
    "*NODE\n100, 0., 0., -1.\n*SURFACE, NAME=BOTTOM\nALL, S1\n*SURFACE, TYPE=CYLINDER, NAME=ROAD\n0., 0., 0., 1., 0., "
    "0.\n0., 1., 0.\n"
    "START, -5., 0.\nLINE, 5., 0.\n*RIGID BODY, REF NODE=100, ANALYTICAL SURFACE=ROAD\n*SURFACE INTERACTION, "
    "NAME=I\n*FRICTION\n0.5\n"
    "*CONTACT PAIR, INTERACTION=I\nBOTTOM, ROAD\n";

TEST(DeckStep, ContactIsRemovedAndAddedAgain) {
  const auto steps = steps_of(
      contact +
      "*STEP\n*STATIC\n*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nBOTTOM, ROAD\n*END STEP\n*STEP\n*STATIC\n*END STEP\n"
      "*STEP\n*DYNAMIC, EXPLICIT\n, 1.\n*CONTACT PAIR, INTERACTION=I, MECHANICAL CONSTRAINT=PENALTY\nBOTTOM, "
      "ROAD\n*END STEP\n");
  EXPECT_TRUE(steps[0].active_contact_pairs.empty());
  EXPECT_TRUE(steps[1].active_contact_pairs.empty());
  EXPECT_EQ(steps[2].active_contact_pairs, std::vector<std::int32_t>{0});
}

TEST(DeckStep, NodesAreAttachedAndReleased) {
  const auto steps = steps_of(
      "*NODE\n100\n*NSET, NSET=BEAD\n1, 2\n*RIGID BODY, REF NODE=100\n*STEP\n*STATIC\n*BOUNDARY\nBEAD, 3, 3, 0.1\n*END "
      "STEP\n"
      "*STEP\n*STATIC\n*BOUNDARY, OP=NEW\n100, 1, 6\n*RIGID BODY, REF NODE=100, TIE NSET=BEAD\n*END STEP\n"
      "*STEP\n*STATIC\n*RIGID BODY, REF NODE=100, RELEASE NSET=BEAD\n*BOUNDARY\n1, 1\n*END STEP\n");
  ASSERT_EQ(steps[1].attachments.size(), 1u);
  EXPECT_TRUE(steps[1].attachments[0].tie);
  EXPECT_FALSE(steps[1].attachments[0].release);
  EXPECT_TRUE(steps[2].attachments[0].release);
}

TEST(DeckStep, ConditionLeftOnAnAttachedNodeIsRefused) {
  const std::string errors = errors_of(
      brick +
      "*NODE\n100\n*NSET, NSET=BEAD\n1, 2\n*RIGID BODY, REF NODE=100\n*STEP\n*STATIC\n*BOUNDARY\nBEAD, 3\n*END STEP\n"
      "*STEP\n*STATIC\n*RIGID BODY, REF NODE=100, TIE NSET=BEAD\n*END STEP\n");
  EXPECT_NE(errors.find("node 1 is carried by the rigid body"), std::string::npos) << errors;
}

TEST(DeckStep, DefaultsOfProceduresAndOutput) {
  const auto steps = steps_of(
      "*STEP\n*STATIC\n*END STEP\n*STEP\n*DYNAMIC, EXPLICIT\n, 2.\n*OUTPUT, FIELD, TIME INTERVAL=0.5\n*NODE OUTPUT\nU, "
      "RF\n"
      "*OUTPUT, HISTORY, FREQUENCY=0\n*END STEP\n");
  EXPECT_EQ(std::get<StaticProcedure>(steps[0].procedure).initial_increment, 1.0);
  EXPECT_DOUBLE_EQ(std::get<StaticProcedure>(steps[0].procedure).minimum_increment, 1e-5);
  EXPECT_EQ(steps[0].field_outputs[0].frequency, 1);
  EXPECT_EQ(steps[0].field_outputs[0].node_variables, (std::vector<std::string>{"U", "V", "A", "RF"}));
  EXPECT_EQ(steps[0].history_outputs[0].energies.size(), 11u);
  ASSERT_EQ(steps[1].field_outputs.size(), 1u);
  EXPECT_EQ(steps[1].field_outputs[0].node_variables, (std::vector<std::string>{"U", "RF"}));
  EXPECT_TRUE(steps[1].history_outputs.empty());
  EXPECT_FALSE(std::get<ExplicitProcedure>(steps[1].procedure).fixed_increment);
  EXPECT_EQ(std::get<ExplicitProcedure>(steps[1].procedure).linear_bulk_viscosity, 0.06);
}

TEST(DeckStep, WhatAbaqusWritesByDefaultRuns) {
  const auto result =
      read(brick +
           "*STEP, NAME=Step-1, NLGEOM=YES, INC=1000\n*STATIC\n0.1, 1., 1e-05, 1.\n*RESTART, WRITE, FREQUENCY=0\n"
           "*OUTPUT, FIELD\n*NODE OUTPUT\nCF, RF, U\n*ELEMENT OUTPUT, DIRECTIONS=YES\nLE, PE, PEEQ, PEMAG, S\n*CONTACT "
           "OUTPUT\n"
           "CDISP, CSTRESS\n*OUTPUT, HISTORY, VARIABLE=PRESELECT\n*END STEP\n");
  const auto& output = result.model.steps[0].field_outputs[0];
  EXPECT_EQ(output.node_variables, (std::vector<std::string>{"RF", "U"}));
  EXPECT_EQ(output.element_variables, (std::vector<std::string>{"LE", "S"}));
  EXPECT_EQ(result.warnings.size(), 4u);  // CF, PE, PEEQ, PEMAG
  EXPECT_FALSE(result.model.steps[0].checkpoint_frequency);
}

TEST(DeckStep, FieldOutputOfASetIsKeptApart) {
  const auto step = steps_of(
      "*STEP\n*STATIC\n*OUTPUT, FIELD, FREQUENCY=3, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*NODE OUTPUT, NSET=ALLN\nRF\n"
      "*ELEMENT OUTPUT, ELSET=ALL\nS\n*NODE OUTPUT, NSET=7\nV\n*NODE OUTPUT, NSET=ALLN\nV\n*END STEP\n")[0];
  const auto& outputs = step.field_outputs;
  ASSERT_EQ(outputs.size(), 3u);
  EXPECT_EQ(outputs[0].node_variables, (std::vector<std::string>{"U"}));
  EXPECT_EQ(outputs[0].node_set, -1);
  EXPECT_EQ(outputs[0].element_variables, (std::vector<std::string>{"S"}));
  EXPECT_GE(outputs[0].element_set, 0);
  EXPECT_EQ(outputs[1].node_variables, (std::vector<std::string>{"RF", "V"}));
  EXPECT_GE(outputs[1].node_set, 0);
  EXPECT_EQ(outputs[2].node_variables, (std::vector<std::string>{"V"}));
  EXPECT_NE(outputs[2].node_set, outputs[1].node_set);
  for (const auto& output : outputs) {
    EXPECT_EQ(output.frequency, 3);
    EXPECT_FALSE(output.single_precision);
  }
}

TEST(DeckStep, ComponentsStandForTheirVariables) {
  const auto step = steps_of("*STEP\n*STATIC\n*OUTPUT, HISTORY\n*ELEMENT OUTPUT, ELSET=ALL\nS11, LE12, MISES, S33\n*OUTPUT, FIELD\n"
                             "*ELEMENT OUTPUT\nS22\n*NODE OUTPUT\nU\n*END STEP\n")[0];
  EXPECT_EQ(step.history_outputs[0].elements[0].variables, (std::vector<std::string>{"S", "LE", "MISES"}));
  EXPECT_EQ(step.field_outputs[0].element_variables, (std::vector<std::string>{"S"}));
  const auto errors = errors_of(brick + "*STEP\n*STATIC\n*OUTPUT, FIELD\n*ELEMENT OUTPUT\nS44\n*END STEP\n");
  EXPECT_NE(errors.find("no element of the model has the variable S44"), std::string::npos) << errors;
}

TEST(DeckStep, PrintedComponentsStandForTheirVariables) {
  const auto step = steps_of("*STEP\n*STATIC\n*NODE PRINT, NSET=ALLN\nU1, RF3, U2, RF\n*EL PRINT, ELSET=ALL\nS11, S22\n*END STEP\n")[0];
  EXPECT_EQ(step.print_outputs[0].variables, (std::vector<std::string>{"U", "RF"}));
  EXPECT_EQ(step.print_outputs[1].variables, (std::vector<std::string>{"S"}));
  EXPECT_NE(errors_of(brick + "*STEP\n*STATIC\n*NODE PRINT, NSET=ALLN\nU4\n*END STEP\n"), "");
}

/// A general block of requests serves models without shells; where Abaqus would extrapolate to nodes, points are written.
TEST(DeckStep, RequestsThatCannotBeMetAreTold) {
  const auto result = read(brick + "*STEP\n*STATIC\n*OUTPUT, FIELD\n*ELEMENT OUTPUT, POSITION=AVERAGED AT NODES\nS, SM, SK, STH\n*END STEP\n");
  EXPECT_EQ(result.model.steps[0].field_outputs[0].integration_point_variables, (std::vector<std::string>{"S"}));
  EXPECT_EQ(result.warnings.size(), 4u);
}

TEST(DeckStep, CheckpointsThatSayNotWhenFollowTheProcedure) {
  const std::string explicit_step = "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-6\n";
  const auto steps = steps_of("*STEP\n*STATIC\n*RESTART, WRITE\n*END STEP\n" + explicit_step + "*END STEP\n" + explicit_step +
                              "*RESTART, WRITE, FREQUENCY=7\n*END STEP\n" + explicit_step + "*END STEP\n");
  EXPECT_EQ(steps[0].checkpoint_frequency, 1);
  EXPECT_FALSE(steps[0].checkpoint_number_interval);
  EXPECT_FALSE(steps[1].checkpoint_frequency);
  EXPECT_EQ(steps[1].checkpoint_number_interval, 1);
  for (const int step : {2, 3}) {
    EXPECT_EQ(steps[step].checkpoint_frequency, 7);
    EXPECT_FALSE(steps[step].checkpoint_number_interval);
  }
}

TEST(DeckStep, ExplicitStepsTellThatTheyAreNotLinear) {
  EXPECT_EQ(read(brick + "*STEP, NLGEOM=NO\n*DYNAMIC, EXPLICIT\n, 1e-6\n*END STEP\n").warnings.size(), 1u);
  EXPECT_TRUE(read(brick + "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-6\n*END STEP\n").warnings.empty());
}

/// CENT is CENTRIF times the density.
TEST(DeckStep, CentrifugalForcesByVolume) {
  const auto loads = steps_of("*STEP\n*STATIC\n*DLOAD\nALL, CENT, 7.8E-5, 0., 0., 0., 0., 0., 2.\n*END STEP\n")[0].body_loads;
  ASSERT_EQ(loads.size(), 1u);
  EXPECT_NEAR(loads[0].magnitude, 1e4, 1e-9);
  EXPECT_EQ(loads[0].kind, BodyLoad::Kind::centrifugal);
  EXPECT_EQ(loads[0].direction, (std::array<double, 3>{0.0, 0.0, 1.0}));
}

TEST(DeckStep, DissipationOfApplications) {
  const std::string step = "*STEP\n*DYNAMIC, APPLICATION=MODERATE DISSIPATION%s\n0.1, 1.\n*END STEP\n";
  const auto alpha = [&](const std::string& more) {
    auto text = step;
    text.replace(text.find("%s"), 2, more);
    return std::get<DynamicProcedure>(steps_of(text)[0].procedure).alpha;
  };
  EXPECT_NEAR(alpha(""), -0.41421, 1e-5);
  EXPECT_EQ(alpha(", ALPHA=-0.1"), -0.1);
}

TEST(DeckStep, DampingOfModesBothWaysOfSayingIt) {
  const std::string before = "*STEP\n*FREQUENCY\n1\n*END STEP\n*STEP\n*MODAL DYNAMIC\n0.1, 1.\n*MODAL DAMPING, ";
  const auto damping = [&](const std::string& said) {
    return std::get<ModalDynamicProcedure>(steps_of(before + said + "\n1, 2, 0.03\n*END STEP\n")[1].procedure).damping[0];
  };
  EXPECT_EQ(damping("VISCOUS=FRACTION OF CRITICAL DAMPING").fraction, 0.03);
  EXPECT_EQ(damping("MODAL=DIRECT").fraction, 0.03);
  EXPECT_EQ(damping("VISCOUS=RAYLEIGH").alpha, 0.03);
}

TEST(DeckStep, LinesTakeForcesByLength) {
  const std::string bar = "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 2., 0., 0.\n*ELEMENT, TYPE=B31, ELSET=A\n1, 1, 2\n*ELEMENT, TYPE=T3D2, ELSET=B\n2, 2, 3\n"
                          "*ELSET, ELSET=LINES\nA, B\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n*BEAM SECTION, SECTION=RECT, ELSET=A, MATERIAL=M\n2., 3.\n"
                          "*SOLID SECTION, ELSET=B, MATERIAL=M\n4.\n";
  const auto model = read(bar + "*STEP\n*STATIC\n*DLOAD\nLINES, PY, 12.\n*END STEP\n*STEP\n*STATIC\n*DLOAD\nLINES, PY, 24.\n*END STEP\n").model;
  for (int step = 0; step < 2; ++step) {
    const auto& loads = model.steps[step].body_loads;
    ASSERT_EQ(loads.size(), 2u);
    EXPECT_EQ(loads[0].magnitude, (1 + step) * 12.0 / 4.0);
    EXPECT_EQ(loads[1].magnitude, (1 + step) * 12.0 / 6.0);
    EXPECT_EQ(loads[0].direction, (std::array<double, 3>{0.0, 1.0, 0.0}));
  }
  const auto errors = errors_of(brick + "*STEP\n*STATIC\n*DLOAD\nALL, PX, 1.\n*END STEP\n");
  EXPECT_NE(errors.find("load beams or trusses"), std::string::npos) << errors;
}

TEST(DeckStep, AllIsMoreThanThePreselection) {
  const std::vector<std::string> of_a_brick{"S", "LE", "MISES", "PRESS", "SENER", "ELSE", "ELASE"};
  const auto steps = steps_of(
      "*STEP\n*STATIC\n*OUTPUT, FIELD\n*ELEMENT OUTPUT, VARIABLE=ALL\n*OUTPUT, HISTORY\n*NODE OUTPUT, NSET=ALLN, VARIABLE=ALL\n"
      "*ELEMENT OUTPUT, ELSET=ALL, VARIABLE=ALL\n*END STEP\n"
      "*STEP\n*STATIC\n*OUTPUT, FIELD, VARIABLE=ALL\n*ELEMENT OUTPUT\nS\n*END STEP\n");
  EXPECT_EQ(steps[0].field_outputs[0].element_variables, of_a_brick);
  EXPECT_EQ(steps[0].history_outputs[0].elements[0].variables, of_a_brick);
  EXPECT_EQ(steps[0].history_outputs[0].nodes[0].variables.size(), 8u);
  EXPECT_EQ(steps[1].field_outputs[0].element_variables, of_a_brick);
}

TEST(DeckStep, ContactFieldsOfOneOfTwoPairsAreRefused) {
  const std::string pairs =
      "*NODE\n100, 0., 0., 0.\n101, 0., 0., 0.\n*SURFACE, NAME=BOTTOM, TYPE=ELEMENT\nALL, S1\n"
      "*SURFACE, NAME=ROAD, TYPE=CYLINDER\n0., 0., 0., 1., 0., 0.\n0., 1., 0.\nSTART, -1., 0.\nLINE, 1., 0.\n"
      "*SURFACE, NAME=WALL, TYPE=CYLINDER\n0., 0., 0., 1., 0., 0.\n0., 1., 0.\nSTART, -1., -1.\nLINE, 1., -1.\n"
      "*RIGID BODY, ANALYTICAL SURFACE=ROAD, REF NODE=100\n*RIGID BODY, ANALYTICAL SURFACE=WALL, REF NODE=101\n"
      "*SURFACE INTERACTION, NAME=DRY\n*CONTACT PAIR, INTERACTION=DRY\nBOTTOM, ROAD\n";
  const std::string request = "*STEP\n*STATIC\n*OUTPUT, FIELD\n*CONTACT OUTPUT, MASTER=ROAD\nCPRESS\n*END STEP\n";
  EXPECT_EQ(errors_of(brick + pairs + request), "") << "the only pair is the whole model";
  const auto errors = errors_of(brick + pairs + "*CONTACT PAIR, INTERACTION=DRY\nBOTTOM, WALL\n" + request);
  EXPECT_NE(errors.find("*CONTACT OUTPUT: contact fields are sums over all contact pairs"), std::string::npos) << errors;
}

const std::string everything =
    "*AMPLITUDE, NAME=TABLE\n0., 0., 0.1, 1.\n*AMPLITUDE, NAME=WAVE, DEFINITION=PERIODIC, TIME=TOTAL TIME\n1, 6.28, "
    "0., 0.\n0., 1.\n"
    "*ORIENTATION, NAME=LOCAL\n0., 1., 0., -1., 0., 0.\n3, 20.\n*TRANSFORM, NSET=ALLN, TYPE=C\n0., 0., 0., 0., 0., 1.\n"
    "*MATERIAL, NAME=\"SOFT RUBBER\"\n*HYPERELASTIC, MOONEY-RIVLIN\n0.4, 0.1, 0.02\n*DENSITY\n1.1E-9\n*DAMPING, "
    "ALPHA=3., BETA=1E-5\n*VISCOELASTIC, TIME=PRONY\n0.3, 0., 0.1\n0.2, , 1.\n"
    "*MATERIAL, NAME=SHEET\n*ELASTIC\n210000., 0.3\n*PLASTIC\n300.\n400., 0.2\n*PLASTIC, RATE=100.\n350.\n500., 0.2\n"
    "*MATERIAL, NAME=CYCLIC\n*ELASTIC\n210000., 0.3\n*PLASTIC, HARDENING=COMBINED, DATA TYPE=PARAMETERS, NUMBER "
    "BACKSTRESSES=2\n300., 2000., 20., 500., 1.\n*CYCLIC HARDENING, PARAMETERS\n300., 50., 4.\n"
    "*MATERIAL, NAME=TREAD\n*HYPERELASTIC, OGDEN, N=2, MODULI=INSTANTANEOUS\n1., 2., -0.1, -2., 0.02\n"
    "*ELEMENT, TYPE=M3D4, ELSET=SKIN\n10, 5, 6, 7, 8\n*MEMBRANE SECTION, ELSET=SKIN, COMPOSITE, "
    "ORIENTATION=LOCAL\n0.5, , STEEL, 20.\n0.25, , STEEL, -20.\n"
    "*ELEMENT, TYPE=MASS, ELSET=HUB\n20, 100\n*MASS, ELSET=HUB\n3.5\n*INITIAL CONDITIONS, TYPE=ROTATING "
    "VELOCITY\nALLN, 0.5, 1., 0., 0.\n0., 0., 0., 0., 1., 0.\n"
    "*INITIAL CONDITIONS, TYPE=VELOCITY\nALLN, 2, 3.\n*TIME POINTS, NAME=WHEN\n0.1, 0.5, 1.\n";

const std::string everything_steps =
    "*STEP, NAME=ONE, NLGEOM\n*STATIC, STABILIZE=1E-4\n0.1, 1., 1E-6, 0.5\n*CONTROLS, PARAMETERS=TIME "
    "INCREMENTATION\n, , , 30\n"
    "*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nBOTTOM, ROAD\n*BOUNDARY, AMPLITUDE=TABLE\n7, 1, 2, 0.3\n*BOUNDARY\n100, "
    "1, 6\n*CLOAD\n8, 3, 2.\n*CLOAD, FOLLOWER\n100, 3, 2.\n*CLOAD\n100, 3, 1.\n*DSLOAD\nBOTTOM, P, 0.2\n"
    "*RESTART, WRITE, FREQUENCY=5\n*OUTPUT, FIELD, TIME POINTS=WHEN, PRECISION=DOUBLE\n*NODE OUTPUT, NSET=ALLN\nU\n*ELEMENT "
    "OUTPUT, ELSET=SKIN, POSITION=INTEGRATION POINTS\nS\n"
    "*END STEP\n*STEP, NAME=TWO\n*DYNAMIC, EXPLICIT, DIRECT USER CONTROL\n1E-7, 1E-5\n*BULK VISCOSITY\n0.1, 0.\n*MODEL "
    "CHANGE, TYPE=CONTACT PAIR, ADD\nBOTTOM, ROAD\n"
    "*BOUNDARY, OP=NEW\n100, 2, 6\n*BOUNDARY, OP=NEW, TYPE=VELOCITY\n100, 1, 1, 11.\n*CLOAD, OP=NEW\n*DLOAD\nALL, "
    "GRAV, 9810., 0., 0., -1.\nALL, BX, 3.\nALL, CENTRIF, 4., 1., 2., 3., 0., 1., 0.\n*OUTPUT, HISTORY, FREQUENCY=10\n"
    "*NODE OUTPUT, NSET=ALLN\nU3, RF\n*CONTACT OUTPUT\n*ENERGY OUTPUT\nALLKE, ETOTAL\n*END STEP\n";

TEST(DeckWriter, WhatIsWrittenReadsBackTheSame) {
  const Model model = read(brick + contact + everything + everything_steps).model;
  const std::string written = write_deck(model);
  const Model again = read(written).model;
  EXPECT_EQ(write_deck(again), written);
  EXPECT_EQ(again.nodes.id, model.nodes.id);
  EXPECT_EQ(again.nodes.coordinates, model.nodes.coordinates);
  ASSERT_EQ(again.elements.size(), model.elements.size());
  for (std::size_t t = 0; t < model.elements.size(); ++t) {
    EXPECT_EQ(again.elements[t].type, model.elements[t].type);
    EXPECT_EQ(again.elements[t].connectivity, model.elements[t].connectivity);
    EXPECT_EQ(again.elements[t].section, model.elements[t].section);
  }
  EXPECT_EQ(again.sections[1].plies[1].angle, model.sections[1].plies[1].angle);
  ASSERT_EQ(again.materials.size(), model.materials.size());
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    EXPECT_EQ(again.materials[m].parameters, model.materials[m].parameters);
    ASSERT_EQ(again.materials[m].options.size(), model.materials[m].options.size());
    for (std::size_t k = 0; k < model.materials[m].options.size(); ++k)
      EXPECT_EQ(again.materials[m].options[k].rows, model.materials[m].options[k].rows);
  }
  EXPECT_EQ(model.materials[2].options[1].settings[0], 100.0);
  EXPECT_EQ(model.materials[3].options[0].rows[0].size(), 5u);
  EXPECT_EQ(again.materials[4].law, "ogden-2");
  EXPECT_TRUE(again.materials[4].instantaneous);
  ASSERT_EQ(again.steps.size(), 2u);
  EXPECT_EQ(again.steps[0].boundary.size(), model.steps[0].boundary.size());
  EXPECT_EQ(again.steps[1].concentrated_loads[0].previous, 2.0);
  ASSERT_EQ(again.steps[0].concentrated_loads.size(), 3u);
  EXPECT_TRUE(again.steps[0].concentrated_loads[1].follower);
  EXPECT_FALSE(again.steps[0].concentrated_loads[2].follower);
  EXPECT_EQ(again.steps[1].active_contact_pairs, model.steps[1].active_contact_pairs);
  EXPECT_EQ(again.steps[0].field_outputs[0].time_points, model.steps[0].field_outputs[0].time_points);
  EXPECT_EQ(again.steps[1].history_outputs[0].nodes[0].variables, model.steps[1].history_outputs[0].nodes[0].variables);
  EXPECT_EQ(std::get<ExplicitProcedure>(again.steps[1].procedure).fixed_increment, 1e-7);
}

TEST(DeckStep, SettingsMayStandBeforeTheProcedureTheyBelongTo) {
  const auto [model, warnings] = read(brick +
                                      "*STEP, NLGEOM, INC=7\n*CONTROLS, PARAMETERS=LINE SEARCH\n4\n*STATIC\n*END STEP\n"
                                      "*STEP\n*BULK VISCOSITY\n0.1, 2.\n*DYNAMIC, EXPLICIT\n, 1.\n*END STEP\n"
                                      "*STEP\n*STATIC\n*END STEP\n");
  const auto& load = std::get<StaticProcedure>(model.steps[0].procedure);
  EXPECT_EQ(load.maximum_increments, 7);
  EXPECT_TRUE(load.nonlinear_geometry);
  EXPECT_TRUE(load.controls.line_search);
  EXPECT_EQ(std::get<ExplicitProcedure>(model.steps[1].procedure).linear_bulk_viscosity, 0.1);
  const auto& again = std::get<StaticProcedure>(model.steps[2].procedure);
  EXPECT_EQ(again.maximum_increments, 100);
  EXPECT_TRUE(again.nonlinear_geometry);
  EXPECT_TRUE(again.controls.line_search);

  const auto& written = std::get<StaticProcedure>(read(write_deck(model)).model.steps[2].procedure);
  EXPECT_TRUE(written.nonlinear_geometry);
  EXPECT_TRUE(written.controls.line_search);
}

TEST(DeckStep, BulkViscosityBelongsToExplicitSteps) {
  const auto errors = errors_of(brick + "*STEP\n*STATIC\n*BULK VISCOSITY\n0.1, 2.\n*END STEP\n");
  EXPECT_NE(errors.find("*BULK VISCOSITY: only *DYNAMIC, EXPLICIT has a bulk viscosity"), std::string::npos) << errors;
}

TEST(DeckStep, VariableMassScalingGoesOnUntilItIsReplaced) {
  const std::string dynamic = "*STEP\n*DYNAMIC, EXPLICIT\n, 1.\n";
  const Model model =
      read(brick + dynamic +
           "*FIXED MASS SCALING, FACTOR=2., DT=1E-6, TYPE=SET EQUAL DT, ELSET=ALL\n*FIXED MASS SCALING, DT=1E-7\n" +
           "*VARIABLE MASS SCALING, DT=2E-6, TYPE=UNIFORM, NUMBER INTERVAL=4\n*END STEP\n*STEP\n*STATIC\n*END STEP\n" + dynamic +
           "*END STEP\n" + dynamic + "*VARIABLE MASS SCALING\n*END STEP\n" + dynamic + "*FIXED MASS SCALING\n*END STEP\n")
          .model;
  const Model again = read(write_deck(model)).model;
  for (const auto* of : {&model, &again}) {
    const auto step = [&](std::size_t row) -> const ExplicitProcedure& {
      return std::get<ExplicitProcedure>(of->steps[row].procedure);
    };
    using Target = MassScaling::Target;
    ASSERT_EQ(step(0).fixed_mass_scaling.size(), 2u);
    EXPECT_EQ(step(0).fixed_mass_scaling[0].factor, 2.0);
    EXPECT_EQ(step(0).fixed_mass_scaling[0].target, Target::equal);
    EXPECT_GE(step(0).fixed_mass_scaling[0].element_set, 0);
    EXPECT_EQ(step(0).fixed_mass_scaling[1].target, Target::below_minimum);
    EXPECT_EQ(step(0).fixed_mass_scaling[1].increment, 1e-7);
    EXPECT_EQ(step(0).fixed_mass_scaling[1].element_set, -1);
    EXPECT_TRUE(step(2).fixed_mass_scaling.empty());
    for (const std::size_t row : {0u, 2u}) {
      ASSERT_EQ(step(row).variable_mass_scaling.size(), 1u);
      EXPECT_EQ(step(row).variable_mass_scaling[0].target, Target::uniform);
      EXPECT_EQ(step(row).variable_mass_scaling[0].number_interval, 4);
      EXPECT_FALSE(step(row).variable_mass_scaling[0].frequency);
    }
    EXPECT_TRUE(step(3).variable_mass_scaling.empty());
    EXPECT_TRUE(step(4).variable_mass_scaling.empty());
    EXPECT_EQ(step(4).fixed_mass_scaling.size(), 1u);
  }
}

TEST(ModelSummary, MassCentreAndInertiaOfABrick) {
  const std::string text = summarize(read(brick + "*STEP\n*DYNAMIC, EXPLICIT\n, 1E-3\n*END STEP\n").model, 2);
  EXPECT_NE(text.find("Mass 7.8e-09, centre of gravity (0.5, 0.5, 0.5)"), std::string::npos) << text;
  // Eight lumped masses m/8 at the corners: I = m/8 * 8 * (1/4 + 1/4) = m/2.
  EXPECT_NE(text.find("I11 3.9e-09"), std::string::npos) << text;
  EXPECT_NE(text.find("element 1 (C3D8R)"), std::string::npos) << text;
  EXPECT_NE(text.find("Bounding box (0, 0, 0) to (1, 1, 1)"), std::string::npos) << text;
}

TEST(ModelSummary, RunTimeCountsEachTypeWithItsOwnCost) {
  const std::string deck = brick +
                           "*ELEMENT, TYPE=C3D8, ELSET=FULL\n2, 1, 2, 3, 4, 5, 6, 7, 8\n*SOLID SECTION, ELSET=FULL, "
                           "MATERIAL=STEEL\n*STEP\n*DYNAMIC, EXPLICIT, DIRECT USER CONTROL\n1E-9, 1.\n*END STEP\n";
  const std::string text = summarize(read(deck).model, 2);
  // A thousand million increments of 50 + 290 ns on two ranks.
  EXPECT_NE(text.find("about 1e+09 increments, 170 s on 2 ranks"), std::string::npos) << text;
  EXPECT_NE(text.find("C3D8 290 ns, C3D8R 50 ns"), std::string::npos) << text;
}

}  // namespace
}  // namespace balocco
