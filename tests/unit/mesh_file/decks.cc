#include <snug/mesh_file/deck_sets.h>

#include "files.h"

using namespace snug;
using namespace snug::test;

namespace {
/// A part of a unit square, and instances of it.
std::string deck(const std::string &assembly)
{
  return "*Part, name=Square\n*Node\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n"
         "*Element, type=CPE4, elset=all\n1, 1, 2, 3, 4\n*Nset, nset=Set-1\n1, 2\n"
         "*Surface, name=Side\n1, S2\n*End Part\n*Assembly, name=A\n" +
         assembly + "*End Assembly\n";
}

const std::string two = "*Instance, name=a, part=square\n*End Instance\n"
                        "*Instance, name=b, part=Square\n0, 5, 0\n*End Instance\n";

geometry::BodyMeshParameters part(const std::string &region, const std::vector<std::string> &sets)
{
  auto body          = file_body();
  body.regions       = {region};
  body.boundary_sets = sets;
  return body;
}
} // namespace

TEST(Decks, InstancesAreMovedAndThenRotated)
{
  const auto file = mesh_file::read_deck(deck("*Instance, name=a, part=Square\n1., 0., 0.\n"
                                              "1., 0., 0., 1., 0., 2., 90.\n*End Instance\n"))
                      .mesh;
  ASSERT_EQ(file.points.size(), 4u);
  // (x + 1, y) turned by a right angle about (1, 0) is (1 - y, x).
  const double expected[4][2] = {{1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(file.points[i][d], d < 2 ? expected[i][d] : 0., 1e-15);
}

TEST(Decks, SetsOfSeveralInstancesHaveTheNameOfTheInstance)
{
  const auto text = deck(two + "*Nset, nset=Set-1, instance=b\n3, 4\n");
  const auto mesh =
    mesh_file::import_mesh(text, part("b", {"b.Set-1", "Set-1", "b.Side"}), 2)->flat;
  EXPECT_EQ(std::set<std::string>(mesh->boundary_names.begin(), mesh->boundary_names.end()),
            (std::set<std::string>{"b.Set-1", "Set-1", "b.Side", "free"}));
  EXPECT_EQ(mesh->blocks.size(), 1u);
  for (const auto &vertex : mesh->vertices)
    EXPECT_GE(vertex[1], 5.);
  const auto other = failure_reason(text, part("a", {"b.Side"}), 2);
  EXPECT_NE(other.find("'b.Side' has no face of the body"), std::string::npos) << other;
  const auto unknown = failure_reason(text, part("a", {"Top"}), 2);
  EXPECT_NE(unknown.find(
              "'Top' is not a set of faces or nodes of the file; the sets are Set-1, a."),
            std::string::npos)
    << unknown;
}

TEST(Decks, FacesOfSeveralSetsAreABoundaryOfTheirOwn)
{
  const std::string sets =
    "*Nset, nset=Low, instance=a\n1, 2, 3\n*Nset, nset=Bottom, instance=a\n1, 2\n";
  auto body = part("a", {"Low", "Bottom"});
  auto mesh = mesh_file::import_mesh(deck(two + sets), body, 2)->flat;
  EXPECT_EQ(std::set<std::string>(mesh->boundary_names.begin(), mesh->boundary_names.end()),
            (std::set<std::string>{"Low and Bottom", "Low", "free"}));
  body.boundary_numbers = {{"Low", "L"}};
  mesh                  = mesh_file::import_mesh(deck(two + sets), body, 2)->flat;
  EXPECT_EQ(std::set<std::string>(mesh->boundary_names.begin(), mesh->boundary_names.end()),
            (std::set<std::string>{"L and Bottom", "L", "free"}));
}

TEST(Decks, NodesWithoutAFaceAreCounted)
{
  const auto mesh =
    mesh_file::import_mesh(replaced(contents("block.inp"), "*ELSET,ELSET=block",
                                    "*NSET, NSET=some\n1, 9, 10, 3, 6\n*ELSET,ELSET=block"),
                           part("block", {"some"}), 3);
  ASSERT_EQ(mesh->notes.size(), 1u);
  EXPECT_EQ(mesh->notes[0],
            "1 node of the set 'some' without a face whose nodes are all in the set");
}

TEST(Decks, ConnectedCellsWithoutASetAreABody)
{
  auto text =
    replaced(contents("bar.inp"), "*ELEMENT, TYPE=CPE4\n",
             "11, 5, 0\n12, 6, 0\n13, 6, 1\n14, 5, 1\n*ELEMENT, TYPE=CPE4\n11, 11, 12, 13, 14\n");
  const auto mesh = mesh_file::import_mesh(text, part("body-1", {}), 2)->flat;
  EXPECT_EQ(mesh->blocks.size(), 1u);
  EXPECT_EQ(mesh_file::import_mesh(text, part("all", {}), 2)->flat->blocks.size(), 3u);
}

TEST(Decks, KeywordLinesContinueAndNamesMayBeQuoted)
{
  const auto text = replaced(contents("bar.inp"), "*SURFACE, NAME=left\n",
                             "*SURFACE,\n  type=ELEMENT,\n NAME=\"left, lower\"\n");
  const auto file = mesh_file::read_deck(text).mesh;
  EXPECT_TRUE(std::any_of(file.elements.begin(), file.elements.end(), [](const auto &element) {
    return element.groups == std::vector<std::string>{"left, lower"};
  }));
}
