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
    "*CLOAD\n13, 2, 7.\n14, 2, 7.\n*END STEP\n*STEP\n*DSLOAD\ntop, P, 9\n");
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
  EXPECT_TRUE(lists(translation, "*CLOAD (lines "));
  EXPECT_TRUE(lists(translation, "*DSLOAD of a step after the first"));
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
