#include "squares.h"

namespace snug {
namespace {
TEST(DeckKeywords, StepsWithFrictionAreLoadSteps)
{
  const auto text = squares(
    "*SURFACE INTERACTION, NAME=rough\n*FRICTION\n.2\n*CONTACT PAIR, INTERACTION=Rough\nunder, "
    "over\n",
    "*DSLOAD\ntop, P, 4\ntop, TRVEC, 10., 3., 4.\n*DLOAD\n3, P3, 1.5\n, GRAV, 9810., 0., -1.\n"
    "*END STEP\n*STEP, NAME=push\n*STATIC\n*DSLOAD\ntop, P, 9\n*CLOAD\n13, 2, 7.\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  ASSERT_EQ(scene.load_cases.size(), 2u);
  const auto &first = scene.load_cases[0], &second = scene.load_cases[1];
  EXPECT_EQ(first.name, "step-1");
  EXPECT_EQ(second.name, "push");
  EXPECT_FALSE(first.load_step);
  EXPECT_TRUE(second.load_step);
  EXPECT_EQ(first.loads.pressure, (std::map<std::string, std::string>{{"lid.top", "5.5"}}));
  // The second *DSLOAD replaces the pressures of the same faces, and the other loads continue.
  EXPECT_EQ(second.loads.pressure, (std::map<std::string, std::string>{{"lid.top", "9"}}));
  EXPECT_EQ(second.loads.traction, (std::map<std::string, std::string>{{"lid.top", "6 8"}}));
  EXPECT_EQ(second.gravity, (std::vector<double>{0., -9810.}));
  EXPECT_TRUE(first.loads.point_forces.empty());
  EXPECT_EQ(second.loads.point_forces, (Pairs{{"lid.free", "0 7 at 0 3"}}));
  ASSERT_EQ(scene.contact.pairs.size(), 1u);
  EXPECT_EQ(scene.contact.pairs[0].slave, "lid.under");
  EXPECT_EQ(scene.contact.pairs[0].master, "base.over");
  EXPECT_EQ(scene.contact.pairs[0].parameters.friction, contact::Friction::Coulomb);
  EXPECT_EQ(scene.contact.pairs[0].parameters.friction_coefficient, "0.2");
  EXPECT_TRUE(translation.lacking.empty());
}

TEST(DeckKeywords, LoadsOfEarlierStepsEndWithOpNew)
{
  const auto text =
    squares("*BOUNDARY\nbottom, 1, 2\n",
            "*DSLOAD\ntop, P, 4\n*CLOAD\n13, 1, 3.\n*BOUNDARY\n\"lower left\", 1, 1, .1\n"
            "*END STEP\n*STEP\n*STATIC\n*DSLOAD, OP=NEW\ntop, TRVEC, 1., 1., 0.\n"
            "*CLOAD\n13, 1, 5.\n*BOUNDARY\n\"lower left\", 1, 1, .3\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  ASSERT_EQ(scene.load_cases.size(), 2u);
  const auto &first = scene.load_cases[0].loads, &second = scene.load_cases[1].loads;
  EXPECT_FALSE(scene.load_cases[1].load_step);
  EXPECT_EQ(first.pressure.size(), 1u);
  EXPECT_TRUE(second.pressure.empty());
  EXPECT_EQ(second.traction, (std::map<std::string, std::string>{{"lid.top", "1 0"}}));
  EXPECT_EQ(second.point_forces, (Pairs{{"lid.free", "5 0 at 0 3"}}));
  EXPECT_EQ(first.displacements, (Pairs{{"base.bottom and lower left", "x = 0.1"}}));
  EXPECT_EQ(second.displacements, (Pairs{{"base.bottom and lower left", "x = 0.3"}}));
  EXPECT_EQ(scene.bodies[0].supports.at("bottom and lower left"), "y");
  // A support that holds in one of the steps only has no counterpart.
  const auto released = squares("", "*BOUNDARY\nbottom, 1\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, "
                                    "OP=NEW\nbottom, 2\n");
  EXPECT_TRUE(lists(deck::translate(released, "deck.inp"), "*BOUNDARY that holds in some steps"));
}

TEST(DeckKeywords, AmplitudesCountAtTheEndsOfTheSteps)
{
  const auto text        = squares("*AMPLITUDE, NAME=up\n0., 0., 2., 1., 4., .5\n",
                                   "*STATIC\n.1, 3.\n*DSLOAD, AMPLITUDE=Up\ntop, P, 4\n");
  const auto translation = deck::translate(text, "deck.inp");
  EXPECT_EQ(scene_of(translation, text).bodies[1].loads.pressure,
            (std::map<std::string, std::string>{{"top", "3"}}));
  EXPECT_THROW(deck::translate(squares("", "*DSLOAD, AMPLITUDE=none\ntop, P, 4\n"), "deck.inp"),
               InputError);
}

TEST(DeckKeywords, TemperaturesCauseStrainsAboveTheInitialOnes)
{
  const std::string heat = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nall, 20.\n";
  auto              text = squares("*NSET, NSET=all\n1, 2, 3, 4, 5, 6, 11, 12, 13, 14\n" + heat,
                                   "*TEMPERATURE\nall, 120.\n");
  text.insert(text.find("*MATERIAL, NAME=rubber"), "*EXPANSION, ZERO=20.\n1.2e-5\n");
  const auto scene = scene_of(deck::translate(text, "deck.inp"), text);
  EXPECT_EQ(scene.bodies[0].temperature, "100");
  EXPECT_EQ(scene.bodies[1].temperature, "100");
  EXPECT_EQ(scene.materials[1].material.expansion, 1.2e-5);
  text.replace(text.find("all, 120."), 9, "1, 120.");
  const auto uneven = deck::translate(text, "deck.inp");
  EXPECT_TRUE(lists(uneven, "*TEMPERATURE that varies within the body 'base'"));
}

TEST(DeckKeywords, ComponentsOfTransformsAreAxesOrNormals)
{
  // The local x is the global y, the local y the negative global x.
  const auto text  = squares("*TRANSFORM, NSET=bottom\n0., 1., 0., -1., 0., 0.\n",
                             "*BOUNDARY\nbottom, 1\n*CLOAD\n2, 2, 5.\n");
  const auto scene = scene_of(deck::translate(text, "deck.inp"), text);
  EXPECT_EQ(scene.bodies[0].supports, (std::map<std::string, std::string>{{"bottom", "y"}}));
  EXPECT_EQ(scene.bodies[0].loads.point_forces, (Pairs{{"bottom", "-5 0 at 1 0"}}));
  // The radius from (1, 1) is the normal of no face of the bottom.
  const auto round =
    squares("*TRANSFORM, NSET=bottom, TYPE=C\n1., 1., 0., 1., 1., 1.\n", "*BOUNDARY\nbottom, 1\n");
  EXPECT_TRUE(lists(deck::translate(round, "deck.inp"), "*BOUNDARY along axes of *TRANSFORM"));
}

TEST(DeckKeywords, CylindersHaveOneAxisPerBody)
{
  // A cube beside the axis z: its bottom about z, its top about another axis.
  const auto cube = [](const std::string &low_axis, const std::string &high_axis) {
    return "*NODE\n1, 1, 0, 0\n2, 2, 0, 0\n3, 2, 1, 0\n4, 1, 1, 0\n5, 1, 0, 1\n6, 2, 0, 1\n"
           "7, 2, 1, 1\n8, 1, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=cube\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
           "*NSET, NSET=low\n1, 2, 3, 4\n*NSET, NSET=high\n5, 6, 7, 8\n*MATERIAL, NAME=m\n"
           "*ELASTIC\n1000., .3\n*SOLID SECTION, ELSET=cube, MATERIAL=m\n"
           "*TRANSFORM, NSET=low, TYPE=C\n" +
           low_axis + "\n*TRANSFORM, NSET=high, TYPE=C\n" + high_axis +
           "\n*STEP\n*STATIC\n*BOUNDARY\nlow, 2, 3\nhigh, 1, 1, .1\n*END STEP\n";
  };
  const auto text  = cube("0., 0., 5., 0., 0., 7.", "0., 0., 5., 0., 0., 7.");
  const auto scene = scene_of(deck::translate(text, "deck.inp"), text);
  const auto body  = scene.bodies.at(0);
  EXPECT_EQ(body.supports, (std::map<std::string, std::string>{{"low", "z tangential"}}));
  EXPECT_EQ(body.loads.displacements, (Pairs{{"high", "radial = 0.1"}}));
  EXPECT_EQ(body.axis, (std::vector<double>{0., 0., 2.}));
  EXPECT_EQ(body.axis_point, (std::vector<double>{0., 0., 5.}));
  const std::string lacking = "*BOUNDARY along axes of *TRANSFORM";
  EXPECT_TRUE(
    lists(deck::translate(cube("0., 0., 5., 0., 0., 7.", "0., 9., 5., 0., 9., 7."), "deck.inp"),
          lacking));
  // Node 1 is on this axis.
  const std::string edge = "1., 0., 0., 1., 0., 1.";
  EXPECT_TRUE(lists(deck::translate(cube(edge, edge), "deck.inp"), lacking));
}

TEST(DeckKeywords, GapsOfAdjustAndClearanceAreThoseOfThePair)
{
  const std::string pair = "*SURFACE INTERACTION, NAME=I\n*CONTACT PAIR, INTERACTION=I";
  const auto        gap  = [](const std::string &text) {
    const auto translation = deck::translate(text, "deck.inp");
    EXPECT_TRUE(translation.lacking.empty());
    return std::stod(scene_of(translation, text).contact.pairs.at(0).parameters.gap);
  };
  // The lid is 1 above the base.
  EXPECT_EQ(gap(squares(pair + "\nunder, over\n", "")), 0.);
  EXPECT_EQ(gap(squares(pair + ", ADJUST=.5\nunder, over\n", "")), 0.);
  EXPECT_EQ(gap(squares(pair + ", ADJUST=1.5\nunder, over\n", "")), -1.);
  EXPECT_EQ(gap(squares(pair + "\nunder, over\n*CLEARANCE, SLAVE=under, MASTER=over, VALUE=.25\n",
                        "")),
            -.75);
}

/// Return the parameters of the only pair of a deck, all of whose parts are translated.
contact::PairParameters pair_of(const std::string &text)
{
  const auto translation = deck::translate(text, "deck.inp");
  EXPECT_TRUE(translation.lacking.empty()) << translation.lacking.front().text;
  const auto pairs = scene_of(translation, text).contact.pairs;
  EXPECT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs.at(0).slave, "lid.under");
  EXPECT_EQ(pairs.at(0).master, "base.over");
  EXPECT_EQ(pairs.at(0).parameters.slave, contact::Slave::first);
  EXPECT_EQ(pairs.at(0).parameters.friction, contact::Friction::none);
  return pairs.at(0).parameters;
}

TEST(DeckKeywords, TiesAndTiedContactsAreTiedPairs)
{
  // The lid is 1 above the base, whose two master faces have edges of the length 1.
  const std::string near = "*TIE, NAME=t, POSITION TOLERANCE=1.5";
  const auto        tied = pair_of(squares(near + ", ADJUST=NO\nunder, over\n", ""));
  EXPECT_EQ(tied.law, contact::Law::tied);
  EXPECT_EQ(tied.search_distance, 1.5);
  EXPECT_EQ(pair_of(squares("*TIE, NAME=t\nunder, over\n", "")).search_distance, 0.05);
  // Nodes stay where they are, also if ADJUST moves them, which is its default.
  const auto moves = [&](const std::string &lines) {
    return replaces(deck::translate(squares(lines, ""), "deck.inp"), "a tie across gaps up to 1 ");
  };
  EXPECT_TRUE(moves(near + "\nunder, over\n"));
  EXPECT_TRUE(moves(near + ", ADJUST=YES\nunder, over\n"));
  EXPECT_FALSE(moves(near + ", ADJUST=NO\nunder, over\n"));
  EXPECT_FALSE(moves("*TIE, NAME=t\nunder, over\n"));
  // A contact that is tied has no friction, so that the second step is no load step.
  const std::string law  = "*SURFACE INTERACTION, NAME=I\n*FRICTION\n.3, 1.e5\n";
  const std::string pair = "*CONTACT PAIR, INTERACTION=I";
  for (const auto &lines : {law + "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n1.e6\n" + pair,
                            law + pair + ", TIED", law + pair + ", TYPE=TIED"})
    {
      const auto text  = squares(lines + "\nunder, over\n", "*END STEP\n*STEP\n*STATIC\n");
      const auto found = pair_of(text);
      EXPECT_EQ(found.law, contact::Law::tied) << lines;
      EXPECT_EQ(found.search_distance, 0.) << lines;
      EXPECT_FALSE(scene_of(deck::translate(text, "d"), text).load_cases.at(1).load_step);
    }
}

TEST(DeckKeywords, TheSlaveSideOfATieMayBeNodes)
{
  const auto text = squares("*NSET, NSET=low\n11, 12\n*SURFACE, TYPE=NODE, NAME=nodes\nlow,\n"
                            "*TIE, NAME=t, POSITION TOLERANCE=2., ADJUST=NO\nnodes, over\n",
                            "");
  const auto translation = deck::translate(text, "deck.inp");
  EXPECT_TRUE(translation.lacking.empty());
  const auto pairs = scene_of(translation, text).contact.pairs;
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].slave, "lid.nodes");
  EXPECT_EQ(pairs[0].parameters.law, contact::Law::tied);
}

TEST(DeckKeywords, TiesWithoutAPairAreLeftOut)
{
  const auto lacks = [](const std::string &lines, const std::string &words) {
    return lists(deck::translate(squares(lines, "*BOUNDARY\n199, 1, 6\n"), "deck.inp"), words);
  };
  EXPECT_TRUE(lacks("*NODE\n199, 0., -5.\n*SURFACE, NAME=low\nbase, S1\n*TIE, NAME=t\nlow, over\n",
                    "*TIE of a body with itself"));
  EXPECT_TRUE(lacks("*NODE\n199, 0., -5.\n*TIE, NAME=t, CYCLIC SYMMETRY\nunder, over\n",
                    "*TIE: the option CYCLICSYMMETRY"));
  EXPECT_TRUE(lacks("*NODE\n199, 0., -5.\n*SURFACE, TYPE=SEGMENTS, NAME=tool\nSTART, 9., -2.\n"
                    "LINE, -7., -2.\n*RIGID BODY, ANALYTICAL SURFACE=tool, REF NODE=199\n"
                    "*SURFACE, NAME=low\nbase, S1\n*TIE, NAME=t\nlow, tool\n",
                    "*TIE that ties a rigid body"));
  EXPECT_TRUE(lacks("*NODE\n199, 0., -5.\n*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n"
                    "*SURFACE INTERACTION, NAME=I\n"
                    "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n"
                    "*CONTACT PROPERTY ASSIGNMENT\n, , I\n",
                    "of an interaction that is TIED"));
}

TEST(DeckKeywords, GeneralContactPairsBodiesWithinReach)
{
  const auto text        = squares("*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n"
                                          "*SURFACE INTERACTION, NAME=I\n*FRICTION\n.3\n"
                                          "*CONTACT PROPERTY ASSIGNMENT\n, , I\n",
                                   "*DSLOAD\ntop, P, 4\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  ASSERT_EQ(scene.contact.pairs.size(), 1u);
  EXPECT_EQ(scene.contact.pairs[0].parameters.friction_coefficient, "0.3");
  EXPECT_EQ(scene.contact.pairs[0].parameters.search_distance, 1.);
  // Only the faces that face the other body take part.
  EXPECT_EQ(scene.contact.pairs[0].slave, "base.base to lid");
  EXPECT_EQ(scene.contact.pairs[0].master, "lid.lid to base");
  EXPECT_TRUE(replaces(translation, "the pair 'base to lid' with gaps from 1 for general contact"));
  EXPECT_TRUE(translation.lacking.empty());
}

TEST(DeckKeywords, RigidSurfacesAreObstacles)
{
  const std::string ground =
    "*NODE\n101, -1., -1.\n102, 1., -1.\n103, 5., -1.\n199, 0., -5.\n"
    "*ELEMENT, TYPE=R2D2, ELSET=ground\n101, 101, 102\n102, 102, 103\n"
    "*SURFACE, NAME=floor\nground, SPOS\n*SURFACE, NAME=low\nbase, S1\n"
    "*RIGID BODY, ELSET=ground, REF NODE=199\n*SURFACE INTERACTION, NAME=I\n*FRICTION\n.1\n"
    "*CONTACT PAIR, INTERACTION=I\nlow, floor\n";
  const auto text        = squares(ground, "*BOUNDARY\n199, 1, 6\n199, 2, 2, .3\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  EXPECT_TRUE(translation.lacking.empty());
  ASSERT_EQ(scene.obstacles.size(), 1u);
  EXPECT_EQ(scene.contact.pairs.at(0).slave, "base.low");
  EXPECT_EQ(scene.contact.pairs[0].master, "rigid-1");
  EXPECT_NE(translation.text.find("set Normal = 0 1"), std::string::npos) << translation.text;
  EXPECT_NE(translation.text.find("set Displacement = 0 0.3"), std::string::npos);
  // A set of the reference node and of nodes of cells holds both.
  const auto both = squares(ground + "*NSET, NSET=both\n1, 2, 3, 199\n", "*BOUNDARY\nboth, 1, 6\n");
  const auto held = deck::translate(both, "deck.inp");
  EXPECT_TRUE(held.lacking.empty());
  EXPECT_EQ(scene_of(held, both).bodies[0].supports,
            (std::map<std::string, std::string>{{"low", "xy"}}));
}

TEST(DeckKeywords, AnalyticalSurfacesAreLinesOrCircles)
{
  const auto deck_with = [](const std::string &segments) {
    return squares("*NODE\n199, 0., -5.\n*SURFACE, NAME=low\nbase, S1\n"
                   "*SURFACE, TYPE=SEGMENTS, NAME=tool\n" +
                     segments +
                     "*RIGID BODY, ANALYTICAL SURFACE=tool, REF NODE=199\n"
                     "*SURFACE INTERACTION, NAME=I\n*CONTACT PAIR, INTERACTION=I\nlow, tool\n",
                   "*BOUNDARY\n199, 1, 6\n");
  };
  const auto round = deck::translate(deck_with("START, 2., -3.\nCIRCL, 0., -3., 1., -3.\n"), "d");
  EXPECT_NE(round.text.find("set Shape = cylinder"), std::string::npos) << round.text;
  EXPECT_NE(round.text.find("set Radius = 1\n"), std::string::npos);
  EXPECT_NE(round.text.find("set Point = 1 -3"), std::string::npos);
  const auto hollow = deck::translate(deck_with("START, 9., 0.\nCIRCL, -7., 0., 1., 0.\n"), "d");
  EXPECT_NE(hollow.text.find("set Shape = hollow cylinder"), std::string::npos) << hollow.text;
  const auto line = deck::translate(deck_with("START, 9., -2.\nLINE, -7., -2.\n"), "d");
  EXPECT_NE(line.text.find("set Normal = 0 1"), std::string::npos) << line.text;
  const auto corner = deck_with("START, 9., -2.\nLINE, -7., -2.\nLINE, -7., 9.\n");
  EXPECT_TRUE(lists(deck::translate(corner, "d"), "no plane, cylinder or sphere"));
}

TEST(DeckKeywords, OutputIsNotNeededAndPartsOfTheModelAreListed)
{
  const auto translation = deck::translate(
    squares("*MODEL CHANGE, TYPE=ELEMENT\nlid\n*EQUATION\n2\n1,1,1.,2,1,-1.\n",
            "*NODE FILE\nU\n*EL PRINT\nS\n*DLOAD\nlid, CENTRIF, 1., 0., 0., 0., 0., 0., 1.\n"),
    "deck.inp");
  EXPECT_EQ(translation.not_needed.rfind("*NODE FILE (line ", 0), 0u);
  ASSERT_EQ(translation.lacking.size(), 3u);
  EXPECT_EQ(translation.lacking[0].kind, "model change");
  EXPECT_EQ(translation.lacking[1].kind, "equation");
  EXPECT_EQ(translation.lacking[2].kind, "dload");
}

TEST(DeckKeywords, PressuresOfAnElementInTwoLinesAreAdded)
{
  const auto text  = squares("", "*DLOAD\n3, P3, 1.5\nlid, P3, 1.5\n3, P1, 1.5\n");
  const auto scene = scene_of(deck::translate(text, "deck.inp"), text);
  EXPECT_EQ(scene.bodies[1].loads.pressure.size(), 2u);
  double sum = 0.;
  for (const auto &[boundary, pressure] : scene.bodies[1].loads.pressure)
    sum += std::stod(pressure);
  EXPECT_EQ(sum, 4.5);
}

TEST(DeckKeywords, LaterPressuresReplaceThoseOfTheSameFaces)
{
  const auto text  = squares("", "*DLOAD\n3, P3, 1.5\n*END STEP\n*STEP\n*STATIC\n"
                                  "*DSLOAD\ntop, P, 4.\n");
  const auto scene = scene_of(deck::translate(text, "deck.inp"), text);
  ASSERT_EQ(scene.load_cases.size(), 2u);
  ASSERT_EQ(scene.load_cases[1].loads.pressure.size(), 1u);
  EXPECT_EQ(scene.load_cases[1].loads.pressure.begin()->second, "4");
}

TEST(DeckKeywords, WrongStructureIsAnError)
{
  const std::vector<std::pair<std::string, std::string>> wrong = {
    {"*STEP\n", "within a step"},
    {"*END STEP\n*DSLOAD\ntop, P, 4\n", "must stand in a step"},
    {"*END STEP\n*END STEP\n", "without *STEP"},
    {"*END STEP\n1, 2\n", "which has no data lines"},
    {"*END STEP\n*MATERIAL, NAME=steel\n", "occurs twice"},
    {"*END STEP\n*CONTACT PAIR\nunder, over\n", "has no INTERACTION"},
    {"*END STEP\n*SURFACE INTERACTION, NAME=J\n*FRICTION\n", "must have a coefficient"},
    {"*END STEP\n*SURFACE INTERACTION, NAME=J\n1.,\n.2,\n", "a further line"},
    {"*CLOAD\n13, 2, 7,5\n", "a decimal number has a point"},
    {"*DSLOAD\ntop, P, 4,0\n", "a decimal number has a point"},
    {"*END STEP\n*STEP\n*STATIC\n", "*STEP without *END STEP"},
    {"*END STEP\n*NSET\n1, 2\n", "*NSET has no name"},
    {"*END STEP\n*SOLID SECTION, ELSET=lid\n3.\n", "has no MATERIAL"},
    {"*END STEP\n*SURFACE INTERACTION, NAME=J\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n.3\n",
     "which has no data lines"},
    {"*END STEP\n*AMPLITUDE, NAME=a, SHIFTX=2.\n0., 1.\n", "SHIFTX = 2. is not supported"},
    {"*END STEP\n*STEP\n*END STEP\n*AMPLITUDE, NAME=a, TIME=TOTAL TIME\n0., 1.\n", "TOTAL TIME"},
    {"*END STEP\n*SOLID SECTION, ELSET=lid, MATERIAL=steel\n4.\n", "different thicknesses"},
    {"*END STEP\n*ELEMENT, TYPE=CPS4\n9, 1, 2, 5, 4\n", "plane strain and of plane stress"},
    {"*END STEP\n*TIE, NAME=t\nunder, ower\n", "line 52: there is no surface 'ower'"},
    {"*END STEP\n*TIE, NAME=t\nunder,\n", "line 52: *TIE must have a slave and a master surface"},
    {"*END STEP\n*TIE, NAME=t, POSITION TOLERANCE=near\nunder, over\n", "'near' is not a number"},
    {"*END STEP\n*CONTACT PAIR, INTERACTION=none\nunder, over\n", "no *SURFACE INTERACTION"}};
  for (const auto &[loads, message] : wrong)
    try
      {
        auto text = squares("", loads);
        if (message == "*STEP without *END STEP")
          text.erase(text.rfind("*END STEP"));
        deck::translate(text, "deck.inp");
        ADD_FAILURE() << loads;
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
      }
}

} // namespace
} // namespace snug
