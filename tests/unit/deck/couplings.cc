#include "squares.h"

#include <sstream>

namespace snug {
namespace {
/// Return a reference node, the number 99, and a coupling of the surface @p surface.
std::string coupling(const std::string &position,
                     const std::string &surface,
                     const std::string &lines = "*DISTRIBUTING\n")
{
  return "*NODE, NSET=Ref\n99, " + position +
         "\n*COUPLING, CONSTRAINT NAME=C, REF NODE=REF, SURFACE=" + surface + "\n" + lines;
}

TEST(Couplings, LoadsOfAReferenceNodeAreAForceAndAMomentAboutTheCentroid)
{
  // The centroid of the face is (0.5, 3).
  const auto text        = squares(coupling("2., 4.", "Top"),
                                   "*CLOAD\n99, 1, 1.\n99, 1, 2.\nRef, 2, -4.\n99, 6, 5.\n13, 1, 7.\n");
  const auto translation = deck::translate(text, "deck.inp");
  EXPECT_TRUE(translation.lacking.empty());
  const auto loads = scene_of(translation, text).bodies[1].loads;
  EXPECT_EQ(loads.force, (VectorMap{{"top", {3., -4.}}}));
  EXPECT_EQ(loads.moment, (VectorMap{{"top", {5. + 1.5 * -4. - 1. * 3.}}}));
  EXPECT_EQ(loads.point_forces.size(), 1u);
  // A force at the centroid has no moment, whatever the round-off of the centroid is.
  const auto central = squares(coupling("1., 1.", "over"), "*CLOAD\n99, 2, -.3\n");
  const auto at      = scene_of(deck::translate(central, "deck.inp"), central).bodies[0].loads;
  EXPECT_EQ(at.force, (VectorMap{{"over", {0., -.3}}}));
  EXPECT_TRUE(at.moment.empty());
}

TEST(Couplings, LoadsOfReferenceNodesFollowTheSteps)
{
  const auto text  = squares("*AMPLITUDE, NAME=up\n0., 0., 2., 1.\n" + coupling("0.5, 3.", "top"),
                             "*CLOAD, AMPLITUDE=up\n99, 2, 8.\n*END STEP\n"
                              "*STEP\n*STATIC\n*CLOAD\n99, 1, 3.\n*END STEP\n"
                              "*STEP\n*STATIC\n*CLOAD, OP=NEW\n99, 6, 2.\n");
  const auto cases = scene_of(deck::translate(text, "deck.inp"), text).load_cases;
  ASSERT_EQ(cases.size(), 3u);
  EXPECT_EQ(cases[0].loads.force, (VectorMap{{"lid.top", {0., 4.}}}));
  EXPECT_EQ(cases[1].loads.force, (VectorMap{{"lid.top", {3., 4.}}}));
  EXPECT_TRUE(cases[1].loads.moment.empty());
  EXPECT_TRUE(cases[2].loads.force.empty());
  EXPECT_EQ(cases[2].loads.moment, (VectorMap{{"lid.top", {2.}}}));
}

TEST(Couplings, AxialForcesOfBodiesOfRevolutionHaveNoMoment)
{
  const std::string low  = "*SURFACE, NAME=low\nbase, S1\n";
  auto              text = squares(low + coupling("0., -3.", "low"), "*CLOAD\n99, 2, 6.\n");
  for (auto at = text.find("CPE4"); at != std::string::npos; at = text.find("CPE4"))
    text.replace(at, 4, "CAX4");
  const auto loads = scene_of(deck::translate(text, "deck.inp"), text).bodies[0].loads;
  EXPECT_EQ(loads.force, (VectorMap{{"low", {0., 6.}}}));
  EXPECT_TRUE(loads.moment.empty());
  text.replace(text.find("99, 2, 6."), 9, "99, 1, 6.");
  EXPECT_TRUE(lists(deck::translate(text, "d"), "*CLOAD of component 1, which"));
}

/// Return a deck of a cube from (0, 0, 0) to (1, 1, 1) with the keywords before its step.
std::string cube(const std::string &keywords, const std::string &loads)
{
  return "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n"
         "7, 1, 1, 1\n8, 0, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=all\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
         "*NSET, NSET=top\n5, 6, 7, 8\n*SURFACE, NAME=two\nall, S2\nall, S4\n"
         "*MATERIAL, NAME=m\n*ELASTIC\n1., 0.\n*SOLID SECTION, ELSET=all, MATERIAL=m\n" +
         keywords + "*STEP\n*STATIC\n" + loads + "*END STEP\n";
}

TEST(Couplings, MomentsInSpaceAreAboutTheCentroidOfAllFaces)
{
  // The faces z = 1 and x = 1 have the centroid (0.75, 0.5, 0.75).
  const auto text =
    cube(coupling("2., -1., 5.", "two"),
         "*CLOAD\n99, 1, 1.\n99, 2, 2.\n99, 3, 3.\n99, 4, 4.\n99, 5, -5.\n99, 6, 6.\n");
  const auto loads = scene_of(deck::translate(text, "deck.inp"), text).bodies[0].loads;
  EXPECT_EQ(loads.force, (VectorMap{{"two", {1., 2., 3.}}}));
  ASSERT_EQ(loads.moment.count("two"), 1u);
  // (1.25, -1.5, 4.25) x (1, 2, 3) = (-13, 0.5, 4)
  const std::vector<double> expected = {4. - 13., -5. + .5, 6. + 4.};
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(loads.moment.at("two")[d], expected[d], 1e-11);
}

TEST(Couplings, DistributionsWithoutACounterpartAreLeftOut)
{
  const auto lacks = [](const std::string &keywords, const std::string &loads,
                        const std::string &words) {
    return lists(deck::translate(squares(keywords, loads), "deck.inp"), words);
  };
  const auto top  = coupling("2., 4.", "top");
  const auto held = squares(top, "*BOUNDARY\n99, 2, 2, .1\n");
  const auto line = 1 + std::count(held.begin(), held.begin() + held.find("*DISTR"), '\n');
  EXPECT_TRUE(lists(deck::translate(held, "deck.inp"),
                    "*DISTRIBUTING with a reference node that *BOUNDARY holds (line " +
                      std::to_string(line) + ")"));
  EXPECT_TRUE(
    lacks(top + "*COUPLING, CONSTRAINT NAME=D, REF NODE=99, SURFACE=under\n*DISTRIBUTING\n", "",
          "*DISTRIBUTING with the reference node of several couplings"));
  EXPECT_TRUE(lacks(coupling("2., 4.", "top", "*DISTRIBUTING\n1, 2\n"), "*CLOAD\n99, 6, 1.\n",
                    "*CLOAD of component 6, which its reference node does not have"));
  EXPECT_TRUE(lacks(top, "*CLOAD\n99, 3, 1.\n", "*CLOAD of component 3, which"));
  EXPECT_TRUE(lacks("*COUPLING, CONSTRAINT NAME=C, REF NODE=13, SURFACE=top\n*DISTRIBUTING\n",
                    "*CLOAD\n13, 1, 1.\n", "*DISTRIBUTING with a reference node on a body"));
  EXPECT_TRUE(lacks("*TRANSFORM, NSET=Ref\n1., 1., 0., -1., 1., 0.\n" + top, "*CLOAD\n99, 1, 1.\n",
                    "*DISTRIBUTING with a reference node on a body or with *TRANSFORM"));
  EXPECT_TRUE(lacks(coupling("2., 4.", "top", "*DISTRIBUTING, CYCLIC SYMMETRY\n"), "",
                    "*DISTRIBUTING: the option CYCLICSYMMETRY"));
  EXPECT_TRUE(lacks(coupling("2., 4.", "top", "*DISTRIBUTING, WEIGHTING METHOD=LINEAR\n"), "",
                    "*DISTRIBUTING with weights by distance"));
  EXPECT_TRUE(lacks("*SURFACE, NAME=low\nbase, S1\n*BOUNDARY\n\"lower left\", 1\n" +
                      coupling("2., 4.", "low"),
                    "", "*DISTRIBUTING over several boundaries"));
  // The third component does not exist in the plane.
  EXPECT_FALSE(lacks(top, "*BOUNDARY\n99, 3, 5\n", "*BOUNDARY holds"));
}

/// Return the entries of a subsection of the parameter file of a deck, without comments.
std::string subsection(const std::string &deck, const std::string &name)
{
  const auto         text  = deck::translate(deck, "deck.inp").text;
  const auto         begin = text.find("subsection " + name + "\n");
  std::istringstream lines(begin == std::string::npos ? "" : text.substr(begin));
  std::string        result, line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line != "end")
    if (line.find('#') == std::string::npos)
      result += line.substr(line.find("set ") + 4) + "\n";
  return result;
}

TEST(ReferencePoints, KinematicCouplingsAreRigidFaces)
{
  // Both surfaces follow one node. A load case has the entries of its step.
  const std::string both =
    coupling("2., 4.", "top", "*KINEMATIC\n1, 2\n6\n") +
    "*COUPLING, CONSTRAINT NAME=D, REF NODE=99, SURFACE=over\n*KINEMATIC\n*BOUNDARY\n99, 1\n";
  const std::string loads = "*CLOAD\n99, 2, -4.\n99, 6, 2.\n*BOUNDARY\n99, 6, 6, 0.\n";
  const auto        one   = squares(both, loads);
  EXPECT_TRUE(deck::translate(one, "d").lacking.empty());
  EXPECT_NE(deck::translate(one, "d").text.find("set Reference points = point-1\n"),
            std::string::npos);
  EXPECT_EQ(
    subsection(one, "Reference point point-1"),
    "Point = 2, 4\nFaces = lid.top, base.over\nSupports = x, rz\nForce = 0, -4\nMoment = 2\n");
  const auto two = squares(both, loads + "*END STEP\n*STEP, NAME=turn\n*STATIC\n*BOUNDARY\n"
                                         "99, 6, 6, .01\n*CLOAD, OP=NEW\n99, 2, 3.\n");
  EXPECT_EQ(subsection(two, "Reference point point-1"),
            "Point = 2, 4\nFaces = lid.top, base.over\nSupports = x\n");
  EXPECT_EQ(subsection(two, "Load case step-1"),
            "Displacement = point-1: rz = 0\nForce = point-1: 0 -4\nMoment = point-1: 2\n");
  EXPECT_EQ(subsection(two, "Load case turn"),
            "Displacement = point-1: rz = 0.01\nForce = point-1: 0 3\n");
  // A support of one step only is a displacement of 0. Components that the plane does not have are
  // left out.
  EXPECT_TRUE(lists(deck::translate(squares(both, "*CLOAD\n99, 3, 1.\n"), "d"),
                    "*CLOAD of component 3, which"));
  const auto held = squares(both, "*END STEP\n*STEP\n*STATIC\n*BOUNDARY\n99, 2\n");
  EXPECT_EQ(subsection(held, "Reference point point-1"),
            "Point = 2, 4\nFaces = lid.top, base.over\nSupports = x\n");
  EXPECT_EQ(subsection(held, "Load case step-1"), "");
  EXPECT_EQ(subsection(held, "Load case step-2"), "Displacement = point-1: y = 0\n");
  EXPECT_TRUE(lists(deck::translate(squares(coupling("2., 4.", "top", "*KINEMATIC\n2\n"), ""), "d"),
                    "*KINEMATIC of some components only"));
}

TEST(ReferencePoints, RigidBodiesOfNodesTurnByTheirNodeOfRotations)
{
  const auto text =
    cube("*NODE\n98, .5, .5, 3.\n99, .5, .5, 3.\n"
         "*RIGID BODY, NSET=top, REF NODE=98, ROT NODE=99\n*BOUNDARY\n99, 3\n98, 2\n",
         "*CLOAD\n98, 3, -6.\n99, 1, 2.\n99, 2, 5.\n*BOUNDARY\n98, 1, 1, .1\n");
  EXPECT_TRUE(deck::translate(text, "d").lacking.empty());
  EXPECT_EQ(subsection(text, "Reference point point-1"),
            "Point = 0.5, 0.5, 3\nFaces = all.top\nDisplacement = x = 0.1\nSupports = y, rz\n"
            "Force = 0, 0, -6\nMoment = 2, 5, 0\n");
  // With a ROT NODE, rotations are no components of the REF NODE, as in CalculiX.
  const auto ignored = cube("*NODE\n98, .5, .5, 3.\n99, .5, .5, 3.\n"
                            "*RIGID BODY, NSET=top, REF NODE=98, ROT NODE=99\n",
                            "*CLOAD\n98, 5, 1.\n");
  EXPECT_TRUE(lists(deck::translate(ignored, "d"), "*CLOAD of component 5"));
}

TEST(ReferencePoints, WholeBodiesFollowWithAllTheirBoundaries)
{
  const std::string node = "*NODE\n99, 5., 5.\n";
  for (const std::string set : {"ELSET=lid", "NSET=square", "PIN NSET=square"})
    {
      const auto text = squares(node + "*NSET, NSET=square\n11, 12, 13, 14\n*RIGID BODY, " + set +
                                  ", REF NODE=99\n*BOUNDARY\n99, ENCASTRE\n",
                                "*DSLOAD\nunder, P, 1.\n");
      EXPECT_TRUE(deck::translate(text, "d").lacking.empty()) << set;
      EXPECT_EQ(subsection(text, "Reference point point-1"),
                "Point = 5, 5\nFaces = lid." +
                  std::string(set == "ELSET=lid" ? "free, lid.under"
                                                 : "square, lid.square and under") +
                  "\nSupports = x, y, rz\n")
        << set;
    }
  // A body without 'Boundary sets' has the boundaries of the surfaces.
  EXPECT_EQ(subsection(squares(node + "*RIGID BODY, ELSET=lid, REF NODE=99\n", ""),
                       "Reference point point-1"),
            "Point = 5, 5\nFaces = lid.free, lid.top, lid.under\n");
  const auto lacks = [&](const std::string &lines, const std::string &words) {
    return lists(deck::translate(squares(node + lines, ""), "d"), "*RIGID BODY " + words);
  };
  EXPECT_TRUE(lacks("*RIGID BODY, ELSET=left, REF NODE=99\n",
                    "of elements that are not those of whole bodies"));
  EXPECT_TRUE(lacks("*NSET, NSET=three\n1, 2, 6\n*RIGID BODY, NSET=three, REF NODE=99\n",
                    "of nodes that are not those of whole faces"));
  EXPECT_TRUE(lacks("*RIGID BODY, NSET=bottom, REF NODE=1\n", "with a reference node on a body"));
}

TEST(ReferencePoints, RigidFacesAreNoSlaveSides)
{
  const auto pair = [](const std::string &sides) {
    const auto text = squares("*NODE\n99, 5., 5.\n*RIGID BODY, ELSET=lid, REF NODE=99\n"
                              "*SURFACE INTERACTION, NAME=I\n*CONTACT PAIR, INTERACTION=I\n" +
                                sides,
                              "");
    return deck::translate(text, "d").text;
  };
  EXPECT_EQ(pair("under, over\n").find("set Slave = first"), std::string::npos);
  EXPECT_NE(pair("over, under\n").find("set Slave = first"), std::string::npos);
}

TEST(ReferencePoints, ObstaclesThatMoveFollowAPoint)
{
  const std::string ground =
    "*NODE\n101, -1., -1.\n102, 5., -1.\n199, 0., -5.\n*ELEMENT, TYPE=R2D2, ELSET=ground\n"
    "101, 101, 102\n*SURFACE, NAME=floor\nground, SPOS\n*SURFACE, NAME=low\nbase, S1\n"
    "*RIGID BODY, ELSET=ground, REF NODE=199\n*SURFACE INTERACTION, NAME=I\n"
    "*CONTACT PAIR, INTERACTION=I\nlow, floor\n";
  const auto point = [&](const std::string &loads) {
    const auto text = squares(ground, loads);
    EXPECT_TRUE(deck::translate(text, "d").lacking.empty()) << loads;
    return subsection(text, "Reference point point-1");
  };
  const std::string begin = "Point = 0, -5\nObstacles = rigid-1\n";
  EXPECT_EQ(point("*BOUNDARY\n199, 1\n199, 6\n*CLOAD\n199, 2, 8.\n"),
            begin + "Supports = x, rz\nForce = 0, 8\n");
  EXPECT_EQ(point("*BOUNDARY\n199, 1, 2\n199, 6, 6, .1\n"),
            begin + "Supports = x, y\nDisplacement = rz = 0.1\n");
  EXPECT_EQ(point("*BOUNDARY\n199, PINNED\n"), begin + "Supports = x, y\n");
  EXPECT_EQ(point("*BOUNDARY\n199, ENCASTRE\n*CLOAD\n199, 1, 3.\n"),
            begin + "Supports = x, y, rz\nForce = 3, 0\n");
  // An obstacle that is held in all components has a displacement, unless it changes with the
  // steps.
  EXPECT_EQ(point("*BOUNDARY\n199, 1, 6\n199, 2, 2, .3\n"), "");
  EXPECT_EQ(point("*BOUNDARY\n199, 1, 6\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY\n199, 2, 2, .3\n"),
            begin + "Supports = x, rz\n");
}

TEST(ReferencePoints, WrongKeywordsAreErrorsWithTheirLine)
{
  const std::string nodes = "*NODE\n98, 5., 5.\n99, 5., 5.\n*NSET, NSET=pair\n98, 99\n";
  const std::string of    = "*COUPLING, CONSTRAINT NAME=C, REF NODE=99, SURFACE=top\n";
  const std::string rigid = "*RIGID BODY, NSET=bottom";
  // The line is that after the nodes, plus a number.
  const std::vector<std::tuple<std::string, unsigned int, std::string>> wrong = {
    {"*COUPLING, SURFACE=top\n*KINEMATIC\n", 0, "*COUPLING must have one REF NODE"},
    {"*COUPLING, REF NODE=pair, SURFACE=top\n*KINEMATIC\n", 0, "*COUPLING must have one REF NODE"},
    {"*COUPLING, REF NODE=77, SURFACE=top\n*KINEMATIC\n", 0,
     "*COUPLING has the node 77, which does not exist"},
    {"*COUPLING, REF NODE=tool, SURFACE=top\n*KINEMATIC\n", 0,
     "*COUPLING refers to 'tool', which is neither a set nor a number"},
    {"*COUPLING, REF NODE=99\n*KINEMATIC\n", 0, "*COUPLING must have a SURFACE"},
    {"*COUPLING, REF NODE=99, SURFACE=tip\n*KINEMATIC\n", 0, "there is no surface 'tip'"},
    {of, 0, "*COUPLING must be followed by *KINEMATIC or *DISTRIBUTING"},
    {of + "1, 2\n*KINEMATIC\n", 1, "'1' follows *COUPLING, which has no data lines"},
    {"*KINEMATIC\n1, 2\n", 0, "*KINEMATIC must follow *COUPLING"},
    {"*DISTRIBUTING\n1, 2\n", 0, "*DISTRIBUTING must follow *COUPLING"},
    {of + "*DISTRIBUTING\n0, 2\n", 2,
     "the first and the last component of *DISTRIBUTING must be numbers from 1 to 6"},
    {of + "*DISTRIBUTING\n1, 7\n", 2, "the first and the last component of *DISTRIBUTING must be"},
    {of + "*KINEMATIC\n3, 1\n", 2, "the first and the last component of *KINEMATIC must be"},
    {of + "*KINEMATIC\nx, 1\n", 2, "'x' is not an integer >= 0"},
    {of + "*KINEMATIC\n1, 2, 6\n", 2, "*KINEMATIC has 3 words instead of at most 2"},
    {rigid + "\n", 0, "*RIGID BODY must have one REF NODE"},
    {rigid + ", REF NODE=99, ROT NODE=pair\n", 0, "*RIGID BODY must have one ROT NODE"},
    {rigid + ", REF NODE=99, ROT NODE=99\n", 0,
     "the ROT NODE of *RIGID BODY must not be its REF NODE"},
    {"*RIGID BODY, REF NODE=99\n", 0,
     "*RIGID BODY must have an NSET, an ELSET or an ANALYTICAL SURFACE"},
    {"*RIGID BODY, REF NODE=99, NSET=tip\n", 0, "there is no node set 'tip'"},
    {"*RIGID BODY, REF NODE=99, ELSET=tip\n", 0, "*RIGID BODY refers to 'tip', which is neither"},
    {rigid + ", REF NODE=99\n1, 2\n", 1, "'1' follows *RIGID BODY, which has no data lines"}};
  const auto start = squares("|", "");
  const auto first = 1 + std::count(start.begin(), start.begin() + start.find('|'), '\n') +
                     std::count(nodes.begin(), nodes.end(), '\n');
  for (const auto &[keywords, line, message] : wrong)
    try
      {
        deck::translate(squares(nodes + keywords, ""), "deck.inp");
        ADD_FAILURE() << keywords;
      }
    catch (const InputError &error)
      {
        const std::string text = error.what();
        EXPECT_EQ(text.find("line " + std::to_string(first + line) + ": "), 0u) << text;
        EXPECT_NE(text.find(message), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      }
}
} // namespace
} // namespace snug
