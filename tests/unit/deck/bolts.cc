#include "squares.h"

#include <snug/deck/deck_bodies.h>

#include <sstream>

namespace snug {
namespace {
/// Return a column of 2 x 1 x 3 cells from (0, 0, 0) to (2, 3, 3) with numbers from 1 in the order
/// x, y, z, the node 99, and steps. @p keywords stand before the steps. The surface up has the
/// faces at z = 1 of the lower cells, down those of the cells above.
std::string column(const std::string &keywords, const std::string &steps = "*STEP\n*END STEP\n")
{
  std::ostringstream text;
  text << "*NODE\n99, 7, 7, 7\n98, 8, 8, 8\n";
  for (int n = 0; n < 24; ++n)
    text << n + 1 << ", " << n % 3 << ", " << 3 * (n / 3 % 2) << ", " << n / 6 << '\n';
  text << "*ELEMENT, TYPE=C3D8, ELSET=all\n";
  for (int e = 0; e < 6; ++e)
    {
      text << e + 1;
      for (const int shift : {0, 1, 4, 3, 6, 7, 10, 9})
        text << ", " << 1 + e % 2 + 6 * (e / 2) + shift;
      text << '\n';
    }
  text << "*NSET, NSET=back\n1, 4, 7, 10, 13, 16, 19, 22\n*NSET, NSET=bolt\n99\n"
          "*SURFACE, NAME=up\n1, S2\n2, S2\n*SURFACE, NAME=down\n3, S1\n4, S1\n"
          "*MATERIAL, NAME=m\n*ELASTIC\n1000., 0.\n*SOLID SECTION, ELSET=all, MATERIAL=m\n";
  return text.str() + keywords + steps;
}

std::string section(const std::string &surface = "up", const std::string &normal = "")
{
  return "*PRE-TENSION SECTION, SURFACE=" + surface + ", NODE=bolt\n" + normal;
}

TEST(Bolts, SectionCutsItsBodyInTwo)
{
  for (const std::string surface : {"up", "down"})
    {
      const auto       text = column(section(surface));
      const auto       deck = mesh_file::read_deck(text);
      deck::DeckBodies bodies(deck);
      ASSERT_EQ(bodies.all().size(), 2u);
      EXPECT_EQ(bodies.all()[0].elements, (std::vector<unsigned int>{0, 1}));
      EXPECT_EQ(bodies.all()[1].elements, (std::vector<unsigned int>{2, 3, 4, 5}));
      EXPECT_EQ(deck.mesh.points.size(), 26u + 6u);
      const unsigned int side = surface == "up" ? 0 : 1;
      for (const auto &[set, body] :
           {std::pair(surface, side), std::pair(surface + " opposite", 1 - side)})
        {
          EXPECT_TRUE(bodies.use(set));
          EXPECT_EQ(bodies.bodies_of(set), (std::vector<unsigned int>{body}));
          ASSERT_EQ(bodies.faces_of(set).size(), 2u);
          for (const auto &face : bodies.faces_of(set))
            for (const unsigned int node : face)
              EXPECT_EQ(bodies.position(node)[2], 1.);
        }
      // The other surface has no face left. Node sets are those of both bodies.
      EXPECT_FALSE(bodies.use(surface == "up" ? "down" : "up"));
      bodies.use("back");
      EXPECT_EQ(bodies.faces_on(0, "back").size(), 1u);
      EXPECT_EQ(bodies.faces_on(1, "back").size(), 2u);
    }
}

TEST(Bolts, SectionsCutOneAfterAnother)
{
  const auto text  = column(section() + "*SURFACE, NAME=next\n3, S2\n4, S2\n"
                                         "*PRE-TENSION SECTION, SURFACE=next, NODE=98\n",
                            "*STEP\n*STATIC\n*CLOAD\n99, 1, 4.\n98, 1, 5.\n*DLOAD\n1, P6, 1.\n"
                             "3, P6, 1.\n5, P6, 1.\n*BOUNDARY\n1, 1\n4, 1\n7, 1\n10, 1\n*END STEP\n");
  const auto scene = scene_of(deck::translate(text, "deck.inp"), text);
  ASSERT_EQ(scene.bodies.size(), 3u);
  ASSERT_EQ(scene.bolts.size(), 2u);
  EXPECT_EQ(scene.bolts[0].pair, "body-1.up: body-2.up opposite");
  EXPECT_EQ(scene.bolts[1].pair, "body-2.next: body-3.next opposite");
  EXPECT_EQ(scene.bolts[0].preload, 4.);
  EXPECT_EQ(scene.bolts[1].preload, 5.);
  for (const auto &body : scene.bodies)
    EXPECT_EQ(body.loads.pressure.size(), 1u);
}

TEST(Bolts, MiddleNodesAreCutAsWell)
{
  // Two squares beside each other with nodes in the middles of their edges.
  const std::string text =
    "*NODE\n1, 0, 0\n2, 1, 0\n3, 2, 0\n4, 0, 1\n5, 1, 1\n6, 2, 1\n7, .5, 0\n8, 1.5, 0\n9, .5, 1\n"
    "10, 1.5, 1\n11, 0, .5\n12, 1, .5\n13, 2, .5\n99, 5, 5\n"
    "*ELEMENT, TYPE=CPS8, ELSET=all\n1, 1, 2, 5, 4, 7, 12, 9, 11\n2, 2, 3, 6, 5, 8, 13, 10, 12\n"
    "*SURFACE, NAME=cut\n1, S2\n*PRE-TENSION SECTION, SURFACE=cut, NODE=99\n";
  const auto       deck = mesh_file::read_deck(text);
  deck::DeckBodies bodies(deck);
  ASSERT_EQ(bodies.all().size(), 2u);
  std::set<unsigned int> nodes;
  for (const std::string set : {"cut", "cut opposite"})
    for (const unsigned int node : bodies.nodes_of(bodies.faces_of(set).at(0)))
      {
        EXPECT_EQ(bodies.position(node)[0], 1.);
        nodes.insert(node);
      }
  EXPECT_EQ(nodes.size(), 6u);
  for (const auto &body : bodies.all())
    for (const auto &face : body.outer)
      EXPECT_EQ(bodies.nodes_of(face).size(), 3u);
}

TEST(Bolts, StepsTightenAndLock)
{
  const auto text =
    column(section(),
           "*STEP\n*STATIC\n*CLOAD\nbolt, 1, 7.\n*END STEP\n"
           "*STEP\n*STATIC\n*BOUNDARY, FIXED\n99, 1, 1\n*END STEP\n*STEP\n*STATIC\n*END STEP\n"
           "*STEP\n*STATIC\n*BOUNDARY\nbolt, 1, 1, 0.25\n*END STEP\n"
           "*STEP\n*STATIC\n*BOUNDARY, OP=NEW\n*CLOAD\n99, 1, 2.\n99, 1, 3.\n*END STEP\n"
           "*STEP\n*STATIC\n*CLOAD, OP=NEW\n*END STEP\n");
  const auto translation = deck::translate(text, "deck.inp");
  EXPECT_TRUE(translation.lacking.empty());
  EXPECT_TRUE(replaces(translation, "the preload 0 for a step without force"));
  const auto scene = scene_of(translation, text);
  ASSERT_EQ(scene.bolts.size(), 1u);
  EXPECT_FALSE(scene.bolts[0].preload || scene.bolts[0].shortening);
  ASSERT_EQ(scene.contact.pairs.size(), 1u);
  EXPECT_EQ(scene.contact.pairs[0].parameters.law, contact::Law::tied);
  using Values                                          = std::map<std::string, double>;
  const std::vector<std::pair<Values, Values>> expected = {
    {{{"bolt-1", 7.}}, {}}, {}, {}, {{}, {{"bolt-1", .25}}}, {{{"bolt-1", 5.}}, {}},
    {{{"bolt-1", 0.}}, {}}};
  ASSERT_EQ(scene.load_cases.size(), expected.size());
  for (std::size_t s = 0; s < expected.size(); ++s)
    {
      const auto &found = scene.load_cases[s];
      EXPECT_EQ(found.load_step, s > 0);
      EXPECT_EQ(Values(found.preloads.begin(), found.preloads.end()), expected[s].first);
      EXPECT_EQ(Values(found.shortenings.begin(), found.shortenings.end()), expected[s].second);
    }
}

TEST(Bolts, NormalOfTheSectionSignsTheForce)
{
  // The normal out of the faces of up is (0, 0, 1), that of down (0, 0, -1).
  for (const auto &[surface, normal, sign] :
       {std::tuple("up", "", 1.), std::tuple("down", "", 1.), std::tuple("up", "0, 0, 2.\n", 1.),
        std::tuple("down", "0, 0, 2.\n", -1.), std::tuple("up", ", , -1\n", -1.)})
    for (const std::string load : {"*CLOAD\n99, 1, 3.\n", "*BOUNDARY\n99, 1, 1, 3.\n"})
      {
        const auto text =
          column(section(surface, normal), "*STEP\n*STATIC\n" + load + "*END STEP\n");
        const auto bolt = scene_of(deck::translate(text, "deck.inp"), text).bolts.at(0);
        EXPECT_EQ(load[1] == 'C' ? bolt.preload : bolt.shortening, 3. * sign);
        EXPECT_FALSE(load[1] == 'C' ? bolt.shortening : bolt.preload);
      }
  auto text = squares("*NODE, NSET=bolt\n99, 5, 5\n*SURFACE, NAME=cut\nleft, S2\n" +
                        section("cut", "-1., 0.\n"),
                      "*CLOAD\n99, 1, 3.\n");
  EXPECT_EQ(scene_of(deck::translate(text, "deck.inp"), text).bolts.at(0).preload, -3.);
}

TEST(Bolts, GeneralContactAndForcesLeaveTheSectionAlone)
{
  const auto text  = column(section() + "*SURFACE, NAME=skin\nall\n*SURFACE INTERACTION, NAME=i\n"
                                         "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n",
                            "*STEP\n*STATIC\n*CLOAD\nback, 2, 1.\n*END STEP\n");
  const auto scene = scene_of(deck::translate(text, "deck.inp"), text);
  EXPECT_EQ(scene.contact.pairs.size(), 1u);
  std::size_t n_forces = 0;
  for (const auto &body : scene.bodies)
    for (const auto &force : body.loads.point_forces)
      n_forces += force.second.rfind("0 1 0 at ", 0) == 0;
  EXPECT_EQ(n_forces, 8u);
}

TEST(Bolts, WrongSectionsAreErrors)
{
  const std::string does_not_cut = " of *PRE-TENSION SECTION does not cut one body in two pieces";
  const std::string node         = "the NODE of *PRE-TENSION SECTION must belong to no element";
  const std::string open         = "*PRE-TENSION SECTION, ";
  for (const auto &[keywords, message] : std::vector<std::pair<std::string, std::string>>{
         {open + "SURFACE=up\n", "*PRE-TENSION SECTION must have one NODE"},
         {open + "SURFACE=up, NODE=back\n", "*PRE-TENSION SECTION must have one NODE"},
         {open + "SURFACE=up, NODE=97\n", "97"},
         {open + "SURFACE=up, NODE=1\n", node},
         {section() + section("side"), "there is no surface 'side' of faces"},
         {open + "NODE=99\n", "there is no surface '' of faces"},
         {"*SURFACE, NAME=s, TYPE=NODE\nback\n" + section("s"), "there is no surface 's' of faces"},
         {"*SURFACE, NAME=s\n1, S1\n2, S1\n" + section("s"), "'s'" + does_not_cut},
         {"*SURFACE, NAME=s\n1, S2\n" + section("s"), "'s'" + does_not_cut},
         {"*SURFACE, NAME=s\n1, S2\n2, S2\n3, S1\n" + section("s"), "'s'" + does_not_cut},
         {section() + section("up"), "'up'" + does_not_cut},
         {section() + "*SURFACE, NAME=s\n3, S2\n4, S2\n" + section("s"), node},
         {"*SURFACE, NAME=s\n1, S2\n2, S2\n5, S1\n6, S1\n" + section("s"), "'s'" + does_not_cut},
         {section("up", "0., 0., 1., 1.\n"), "4 words instead of at most 3"},
         {section("up", "0., 0., up\n"), "'up'"}})
    {
      const auto text = column(keywords);
      try
        {
          deck::translate(text, "deck.inp");
          ADD_FAILURE() << keywords;
        }
      catch (const InputError &error)
        {
          const std::string what = error.what();
          EXPECT_EQ(what.rfind("line ", 0), 0u) << what;
          EXPECT_NE(what.find(message), std::string::npos) << what;
          EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        }
    }
}

TEST(Bolts, OtherSectionsAreListed)
{
  const auto lacks = [](const std::string &keywords, const std::string &lines,
                        const std::string &what) {
    return lists(deck::translate(column(keywords, "*STEP\n*STATIC\n" + lines + "*END STEP\n"), "d"),
                 what);
  };
  EXPECT_TRUE(
    lacks("*PRE-TENSION SECTION, ELEMENT=1, NODE=99\n", "", "*PRE-TENSION SECTION of a beam"));
  EXPECT_TRUE(lacks(section("up", "0., 1., 1.\n"), "",
                    "*PRE-TENSION SECTION along a direction that is not the normal"));
  EXPECT_TRUE(lacks(section(), "*BOUNDARY, FIXED\nback, 1, 1\n",
                    "*BOUNDARY: the option FIXED of a node that is not a bolt's"));
  EXPECT_TRUE(lacks(section(), "*CLOAD\n99, 2, 1.\n", "*CLOAD of nodes on no boundary"));
  EXPECT_FALSE(lacks(section(), "*BOUNDARY, FIXED\n99, 1, 1\n", "*BOUNDARY"));
}
} // namespace
} // namespace snug
