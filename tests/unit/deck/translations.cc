#include "squares.h"

namespace snug {
namespace {
TEST(Translations, BodiesAreConnectedCellsWithTheMaterialsOfTheirSections)
{
  const auto text        = squares("", "");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[0].name, "base");
  EXPECT_EQ(scene.bodies[1].name, "lid");
  EXPECT_EQ(scene.model, mesh::Idealization::Kind::plane_strain);
  EXPECT_EQ(scene.thickness, 3.);
  EXPECT_EQ(scene.bodies[0].materials,
            (std::map<std::string, std::string>{{"left", "steel"}, {"right", "rubber"}}));
  EXPECT_EQ(scene.bodies[1].materials, (std::map<std::string, std::string>{{"", "steel"}}));
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[1].material.youngs_modulus, 2.1e5);
  EXPECT_EQ(scene.materials[1].material.density, 7.8e-9);
  EXPECT_TRUE(translation.lacking.empty());
  EXPECT_TRUE(translation.replaced.empty());
}

TEST(Translations, SupportsOfOverlappingSetsAddUp)
{
  const auto text        = squares("*BOUNDARY\nbottom, 2\n\"lower left\", 1, 2\ncorner, 1, 2\n",
                                   "*BOUNDARY\nbottom,2,2,.5\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  // The last value of a component counts.
  EXPECT_EQ(scene.bodies[0].supports,
            (std::map<std::string, std::string>{{"bottom and lower left", "x"}}));
  EXPECT_EQ(scene.bodies[0].loads.displacements,
            (std::vector<std::pair<std::string, std::string>>{
              {"bottom", "y = 0.5"}, {"bottom and lower left", "y = 0.5"}}));
  EXPECT_TRUE(replaces(translation, "point supports for nodes of *BOUNDARY"));
  EXPECT_EQ(scene.bodies[0].point_supports,
            (Pairs{{"bottom and lower left", "x at 0 0"}, {"bottom and lower left", "y at 0 0"}}));
  EXPECT_TRUE(translation.lacking.empty());
}

TEST(Translations, ForcesOfANodeAddUpAtABoundaryOfTheNode)
{
  const auto text        = squares("*BOUNDARY\nbottom, 2\n",
                                   "*DSLOAD\ntop, P, 4\n*CLOAD\n13, 2, 7.\n13, 1, -2.\nBottom, 1, .5\n"
                                          "13, 2, 1.5\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  EXPECT_TRUE(translation.lacking.empty());
  // Node 13 is at the end of the faces of a surface and of a face of no set.
  EXPECT_EQ(scene.bodies[1].loads.point_forces, (Pairs{{"free", "-2 8.5 at 0 3"}}));
  EXPECT_EQ(scene.bodies[0].loads.point_forces, (Pairs{{"bottom", "0.5 0 at 0 0"},
                                                       {"bottom", "0.5 0 at 1 0"},
                                                       {"bottom", "0.5 0 at 2 0"}}));
}

TEST(Translations, ForcesOfABodyWithoutBoundarySetsAreAtTheGroupsOfItsFaces)
{
  const auto text  = squares("", "*CLOAD\n12, 2, 1.\n14, 2, 1.\n");
  const auto scene = scene_of(deck::translate(text, "deck.inp"), text);
  EXPECT_TRUE(scene.bodies[1].mesh.boundary_sets.empty());
  EXPECT_EQ(scene.bodies[1].loads.point_forces,
            (Pairs{{"under", "0 1 at 1 2"}, {"free", "0 1 at 1 3"}}));
}

TEST(Translations, ForcesWithoutAPlaceAreLeftOut)
{
  const auto text =
    squares("*NODE\n99, 5., 5.\n", "*CLOAD\n99, 1, 7.\n13, 3, 7.\n13, 0, 1.\nbottom, 2, 1.\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  EXPECT_TRUE(lists(translation, "*CLOAD of nodes on no boundary of a body (line "));
  EXPECT_TRUE(lists(translation, "*CLOAD of component 3 (line "));
  EXPECT_TRUE(lists(translation, "*CLOAD of component 0 (line "));
  EXPECT_EQ(scene.bodies[0].loads.point_forces.size(), 3u);
  // A force along the radius belongs to a ring.
  auto revolved = text;
  for (auto at = revolved.find("CPE4"); at != std::string::npos; at = revolved.find("CPE4"))
    revolved.replace(at, 4, "CAX4");
  revolved.replace(revolved.find("99, 1, 7."), 9, "bottom, 1, 7.");
  const auto axial = deck::translate(revolved, "deck.inp");
  EXPECT_TRUE(lists(axial, "*CLOAD along the radius of an axisymmetric model (line "));
  EXPECT_EQ(scene_of(axial, revolved).bodies[0].loads.point_forces,
            scene.bodies[0].loads.point_forces);
}

/// Two rows of @p n squares of elements of eight nodes and of @p last, one element, with @p loads
/// in a step.
std::string strip(const unsigned int n, const std::string &last, const std::string &loads = "")
{
  std::string nodes = "*NODE\n", cells = "*ELEMENT, TYPE=CPS8, ELSET=all\n";
  const auto  node = [](const unsigned int i, const unsigned int j) {
    return std::to_string(1 + i + 1000 * j);
  };
  for (unsigned int j = 0; j < 3; ++j)
    for (unsigned int i = 0; i <= 2 * n + 2; ++i)
      nodes += node(i, j) + ", " + std::to_string(0.5 * i) + ", " + std::to_string(0.5 * j) + '\n';
  for (unsigned int c = 0; c <= n; ++c)
    {
      const unsigned int i = 2 * c;
      const std::string  corners =
        node(i, 0) + ", " + node(i + 2, 0) + ", " + node(i + 2, 2) + ", " + node(i, 2);
      const std::string middles =
        ", " + node(i + 1, 0) + ", " + node(i + 2, 1) + ", " + node(i + 1, 2) + ", " + node(i, 1);
      if (c == n)
        cells += "*ELEMENT, TYPE=" + last + ", ELSET=all\n";
      cells +=
        std::to_string(c + 1) + ", " + corners + (c < n || last == "CPS8" ? middles : "") + '\n';
    }
  return nodes + cells + "*NSET, NSET=top, GENERATE\n2001, " + node(2 * n + 2, 2) +
         "\n*MATERIAL, NAME=m\n*ELASTIC\n1., 0.\n*SOLID SECTION, ELSET=all, MATERIAL=m\n1.\n"
         "*STEP\n*STATIC\n" +
         loads + "*END STEP\n";
}

TEST(Translations, CellsOfSecondOrderHaveDegree2)
{
  const auto text        = strip(2, "CPS8", "*CLOAD\n2002, 2, 1.\n1002, 2, 1.\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  EXPECT_EQ(scene.degree, 2u);
  // Node 2002 is in the middle of an edge of the boundary. Node 1002 belongs to no element.
  EXPECT_EQ(scene.bodies[0].loads.point_forces, (Pairs{{"free", "0 1 at 0.5 1"}}));
  EXPECT_TRUE(lists(translation, "*CLOAD of nodes on no boundary of a body"));
}

TEST(Translations, TheDegreeIsThatOfTheRichestElements)
{
  for (const std::string type : {"CPS4", "CPS4R", "CPS4I"})
    {
      const auto mixed       = strip(2, type);
      const auto translation = deck::translate(mixed, "deck.inp");
      EXPECT_EQ(scene_of(translation, mixed).degree, 2u);
      EXPECT_TRUE(replaces(translation, "elements of degree 2 instead of " + type));
    }
  for (const auto &[type, degree] :
       std::map<std::string, unsigned int>{{"CPS4", 1}, {"CPS4R", 2}, {"CPS4I", 2}})
    {
      auto text = squares("", "");
      for (auto at = text.find("CPE4"); at != std::string::npos; at = text.find("CPE4"))
        text.replace(at, 4, type);
      EXPECT_EQ(scene_of(deck::translate(text, "deck.inp"), text).degree, degree) << type;
    }
}

TEST(Translations, ForcesOfManyNodesArePointForces)
{
  const auto text = strip(9, "CPS8", "*CLOAD\ntop, 2, 1.\n2001, 1, 1.\n"); // of 21 nodes
  EXPECT_EQ(scene_of(deck::translate(text, "deck.inp"), text).bodies[0].loads.point_forces.size(),
            21u);
}

TEST(Translations, SpringsToTheGroundArePointSprings)
{
  const auto text        = squares("*ELEMENT, TYPE=SPRING1, ELSET=S\n91, 13\n92, 14\n"
                                          "*SPRING, ELSET=S\n2\n50.\n*ELEMENT, TYPE=MASS, ELSET=M\n93, 11\n"
                                          "*MASS, ELSET=M\n1.\n",
                                   "");
  const auto translation = deck::translate(text, "deck.inp");
  EXPECT_TRUE(translation.lacking.empty());
  EXPECT_EQ(scene_of(translation, text).bodies[1].point_springs,
            (Pairs{{"free", "0 50 at 0 3"}, {"free", "0 50 at 1 3"}}));
}

TEST(Translations, WrongForcesAreErrorsWithTheirLine)
{
  const std::vector<std::pair<std::string, std::string>> wrong = {
    {"13, 2", "a node or set, a component and a force are expected"},
    {"77, 2, 1.", "*CLOAD has the node 77, which does not exist"},
    {"edge, 2, 1.", "*CLOAD refers to 'edge', which is neither a set nor a number"},
    {"13, y, 1.", "'y'"},
    {"13, -2, 1.", "'-2'"},
    {"13, 2, much", "'much' is not a number"}};
  for (const auto &[line, message] : wrong)
    {
      const auto        text = squares("", "*CLOAD\n13, 2, 1.\n" + line + "\n");
      const std::string place =
        "line " + std::to_string(
                    1 + std::count(text.begin(), text.begin() + text.find(line + "\n*END"), '\n'));
      try
        {
          deck::translate(text, "deck.inp");
          ADD_FAILURE() << line;
        }
      catch (const InputError &error)
        {
          EXPECT_EQ(std::string(error.what()).find(place + ": "), 0u) << error.what();
          EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
        }
    }
}

TEST(Translations, LongListsOfLinesAreShortened)
{
  EXPECT_EQ(deck::list_of_lines({3}), "line 3");
  EXPECT_EQ(deck::list_of_lines({3, 5, 8}), "lines 3, 5 and 8");
  EXPECT_EQ(deck::list_of_lines({1, 2, 3, 4, 5, 6, 7, 8, 9}), "lines 1, 2, 3, ..., 9 (9 lines)");
}

TEST(Translations, CellsNeedAMaterial)
{
  auto       text  = squares("", "");
  const auto place = text.find("*SOLID SECTION, ELSET=lid");
  text.erase(place, text.find("*STEP") - place);
  EXPECT_THROW(deck::translate(text, "deck.inp"), InputError);
}
} // namespace
} // namespace snug
