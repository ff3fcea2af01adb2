#include <snug/cad/near_faces.h>
#include <snug/cad/translate.h>

#include <TopLoc_Location.hxx>
#include <gp_Trsf.hxx>

#include <gtest/gtest.h>

#include <cmath>

using namespace snug;

namespace {
/// Return a solid of pins.step, moved: 1 is a pin about z of radius 0.5 from z = 0 to 2, 2 the
/// block from (2, 0, 0) to (3, 1, 0.5).
cad::Part moved(const unsigned int solid, const gp_Vec &by)
{
  auto    part = cad::read_part(SNUG_MESHES "pins.step", solid, 3);
  gp_Trsf move;
  move.SetTranslation(by);
  part.shape.Move(TopLoc_Location(move));
  return part;
}

std::vector<cad::NearFaces> near_blocks(const gp_Vec &by)
{
  return cad::near_faces({moved(2, {0., 0., 0.}), moved(2, by)});
}
} // namespace

/// The limit is 1 % of the diagonal, 0.015.
TEST(Assembly, faces_of_blocks_are_near_over_their_common_area)
{
  for (const double gap : {0., 0.01, -0.01})
    {
      const auto found = near_blocks({0.5, 0., 0.5 + gap});
      ASSERT_EQ(found.size(), 1u);
      EXPECT_NEAR(found[0].gap, gap, 1e-12);
      EXPECT_NEAR(found[0].area, 0.5, 0.03);
      EXPECT_EQ(found[0].parts, (std::array<unsigned int, 2>{{0, 1}}));
    }
  EXPECT_TRUE(near_blocks({0.5, 0., 0.52}).empty());
}

TEST(Assembly, faces_with_a_common_edge_are_not_near)
{
  EXPECT_TRUE(near_blocks({1., 0., 0.5}).empty());
  EXPECT_EQ(near_blocks({1., 0., 0.}).size(), 1u); // not the sides in one plane
}

TEST(Assembly, a_cylinder_is_near_a_plane_along_a_line)
{
  const auto found = cad::near_faces({moved(1, {0., 0., 0.}), moved(2, {-1.495, -0.4137, 0.6})});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].gap, 0.005, 1e-3);
  EXPECT_LT(found[0].area, 0.15);
}

TEST(Assembly, solids_without_names_are_numbered)
{
  const auto text = cad::translate(SNUG_MESHES "pins.step");
  EXPECT_NE(text.find("set Bodies = solid-1, solid-2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("set Solid = 2\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("Contact"), std::string::npos) << text;
  EXPECT_NE(text.find("# Possible symmetry plane z = 0:\n#   Body solid-1: set Supports = foot: z"),
            std::string::npos)
    << text;
}
