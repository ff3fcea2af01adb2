#include <snug/base/errors.h>
#include <snug/deck/left_out.h>
#include <snug/deck/translation.h>
#include <snug/scene/read_scene.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace snug {
namespace {
/// Two squares of different materials in one element set, a third square without contact to them,
/// and a step. @p keywords stand before the step, @p loads in the step.
std::string squares(const std::string &keywords, const std::string &loads)
{
  return "*NODE\n1, 0, 0\n2, 1, 0\n3, 2, 0\n4, 0, 1\n5, 1, 1\n6, 2, 1\n"
         "11, 0, 2\n12, 1, 2\n13, 0, 3\n14, 1, 3\n"
         "*ELEMENT, TYPE=CPE4, ELSET=left\n1, 1, 2, 5, 4\n"
         "*ELEMENT, TYPE=CPE4, ELSET=right\n2, 2, 3, 6, 5\n"
         "*ELEMENT, TYPE=CPE4, ELSET=lid\n3, 11, 12, 14, 13\n"
         "*ELSET, ELSET=base\nleft, right\n"
         "*NSET, NSET=bottom\n1, 2, 3\n*NSET, NSET=corner\n1\n*NSET, NSET=\"lower left\"\n1, 2\n"
         "*SURFACE, NAME=top\nlid, S3\n*SURFACE, NAME=under\nlid, S1\n*SURFACE, NAME=over\nbase, "
         "S3\n"
         "*MATERIAL, NAME=steel\n*ELASTIC\n2.1e5, 0.3\n*DENSITY\n7.8e-9\n"
         "*MATERIAL, NAME=rubber\n*ELASTIC\n10, 0.45\n"
         "*SOLID SECTION, ELSET=left, MATERIAL=STEEL\n3.\n"
         "*SOLID SECTION, ELSET=right, MATERIAL=rubber\n3.\n"
         "*SOLID SECTION, ELSET=lid, MATERIAL=steel\n3.\n" +
         keywords + "*STEP\n*STATIC\n" + loads + "*END STEP\n";
}

scene::Scene scene_of(const deck::Translation &translation, const std::string &deck)
{
  return scene::read_scene(
    {"deck.inp", translation.text, {}, "", [&](const std::string &) { return deck; }});
}

bool lists(const deck::Translation &translation, const std::string &text)
{
  return std::any_of(translation.left_out.begin(), translation.left_out.end(),
                     [&](const std::string &line) { return line.find(text) != std::string::npos; });
}

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
  EXPECT_TRUE(translation.left_out.empty());
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
  EXPECT_TRUE(lists(translation, "*BOUNDARY of nodes or sets without a face"));
  EXPECT_EQ(translation.left_out.size(), 1u);
}

TEST(Translations, LoadsAndContactsAreThoseOfTheFirstStep)
{
  const auto text = squares(
    "*SURFACE INTERACTION, NAME=rough\n*FRICTION\n.2\n*CONTACT PAIR, INTERACTION=Rough\nunder, "
    "over\n",
    "*DSLOAD\ntop, P, 4\ntop, TRVEC, 10., 3., 4.\n*DLOAD\n3, P3, 1.5\n, GRAV, 9810., 0., -1.\n"
    "*END STEP\n*STEP\n*DSLOAD\ntop, P, 9\n*CLOAD\n13, 2, 7.\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  EXPECT_EQ(scene.bodies[1].loads.pressure, (std::map<std::string, std::string>{{"top", "5.5"}}));
  EXPECT_EQ(scene.bodies[1].loads.traction, (std::map<std::string, std::string>{{"top", "6 8"}}));
  EXPECT_EQ(scene.gravity, (std::vector<double>{0., -9810.}));
  ASSERT_EQ(scene.contact.pairs.size(), 1u);
  EXPECT_EQ(scene.contact.pairs[0].slave, "lid.under");
  EXPECT_EQ(scene.contact.pairs[0].master, "base.over");
  EXPECT_EQ(scene.contact.pairs[0].parameters.friction, contact::Friction::Coulomb);
  EXPECT_EQ(scene.contact.pairs[0].parameters.friction_coefficient, "0.2");
  EXPECT_TRUE(scene.bodies[1].loads.point_forces.empty());
  EXPECT_TRUE(lists(translation, "*CLOAD of a step after the first"));
  EXPECT_TRUE(lists(translation, "*DSLOAD of a step after the first"));
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

TEST(Translations, ForcesOfANodeAddUpAtABoundaryOfTheNode)
{
  const auto text        = squares("*BOUNDARY\nbottom, 2\n",
                                   "*DSLOAD\ntop, P, 4\n*CLOAD\n13, 2, 7.\n13, 1, -2.\nBottom, 1, .5\n"
                                          "13, 2, 1.5\n");
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  EXPECT_TRUE(translation.left_out.empty());
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

/// Two rows of @p n squares of elements of eight nodes and of @p last, one element.
std::string strip(const unsigned int n, const std::string &last)
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
         "*STEP\n*STATIC\n";
}

TEST(Translations, CellsOfSecondOrderHaveDegree2)
{
  const auto text        = strip(2, "CPS8") + "*CLOAD\n2002, 2, 1.\n1002, 2, 1.\n";
  const auto translation = deck::translate(text, "deck.inp");
  const auto scene       = scene_of(translation, text);
  EXPECT_EQ(scene.degree, 2u);
  // Node 2002 is in the middle of an edge of the boundary. Node 1002 belongs to no element.
  EXPECT_EQ(scene.bodies[0].loads.point_forces, (Pairs{{"free", "0 1 at 0.5 1"}}));
  EXPECT_TRUE(lists(translation, "*CLOAD of nodes on no boundary of a body"));
  const auto mixed = strip(2, "CPS4");
  EXPECT_EQ(scene_of(deck::translate(mixed, "deck.inp"), mixed).degree, 1u);
}

TEST(Translations, ForcesOfManyNodesAreLeftOut)
{
  const auto many = strip(9, "CPS8") + "*CLOAD\ntop, 2, 1.\n2001, 1, 1.\n"; // of 21 nodes
  const auto left = deck::translate(many, "deck.inp");
  EXPECT_TRUE(lists(left, "*CLOAD of more than 20 nodes; use *DSLOAD (lines "));
  EXPECT_TRUE(scene_of(left, many).bodies[0].loads.point_forces.empty());
  const auto text = strip(8, "CPS8") + "*CLOAD\ntop, 2, 1.\n";
  EXPECT_EQ(scene_of(deck::translate(text, "deck.inp"), text).bodies[0].loads.point_forces.size(),
            19u);
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
