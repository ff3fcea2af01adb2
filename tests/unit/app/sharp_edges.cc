#include <snug/accuracy/sharp_edges.h>

#include <gtest/gtest.h>

#include "solved_scene.h"

using namespace snug;
using namespace snug::test;

namespace {
/// A block of width 1, pressed more on its right.
const std::string eccentric_punch = R"(
set Dimension = 2
subsection Body punch
  set Box corner = 0, 1
  set Box cells = 8, 8
  set Young's modulus = 1000
  set Supports = top: x
  set Pressure = top: 0.2 + x
end
)";

/// On another block that is wider.
const std::string punch_on_block = eccentric_punch + R"(
set Bodies = punch, base
subsection Body base
  set Box corner = -1, 0
  set Box size = 3, 1
  set Box cells = 24, 8
  set Young's modulus = 1000
  set Supports = bottom: xy
end
subsection Contact
  set Pairs = punch.bottom: base.top
  set Slave = first
end
)";

const std::string punch_on_plane = eccentric_punch + R"(
set Bodies = punch
set Obstacles = floor
subsection Obstacle floor
  set Point = 0, 1
  set Normal = 0, 1
end
subsection Contact
  set Pairs = punch.bottom: floor
end
)";

std::vector<std::string> edges_of(const SolvedScene<2> &scene)
{
  std::vector<std::string> result;
  for (const auto &edge : accuracy::sharp_edges(scene.solver, scene.state))
    result.push_back(edge.text);
  return result;
}

std::vector<std::string> edges(const std::vector<std::string> &sets = {})
{
  return edges_of(SolvedScene<2>(punch_on_block, sets));
}

const std::vector<std::string> of_punch = {
  "the pressure of 'punch.bottom: base.top' at a sharp "
  "edge of punch.bottom is unbounded under mesh refinement"};
} // namespace

/// The pressure beside a right-angled punch on a plane is unbounded.
TEST(SharpEdges, APunchHasThem)
{
  EXPECT_EQ(edges(), of_punch);
}

TEST(SharpEdges, OfAMasterAsWell)
{
  const auto found = edges({"Contact/Pairs=base.top: punch.bottom"});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found.front().find("edge of punch.bottom"), std::string::npos) << found.front();
}

/// The left sides are on a plane of symmetry, where the pressure of a round punch is largest; a
/// base that ends there has an edge.
TEST(SharpEdges, NotOnAPlaneOfSymmetry)
{
  std::vector<std::string> round = {"Body base/Supports=bottom: xy, left: x",
                                    "Body punch/Supports=left: x",
                                    "Body punch/Pressure=top: 1 + x",
                                    "Body base/Box corner=0, 0",
                                    "Body base/Box size=2, 1",
                                    "Body punch/Curved faces=bottom: -(x^2)/2"};
  EXPECT_TRUE(edges(round).empty());
  round.front()    = "Body base/Supports=bottom: xy";
  const auto found = edges(round);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found.front().find("edge of base.top"), std::string::npos) << found.front();
}

/// A plane obstacle is a plane of symmetry, across which a right angle is a straight surface: the
/// pressure is linear, and far above its mean at the edge.
TEST(SharpEdges, NotOfARightAngleOnAnObstacle)
{
  const SolvedScene<2> scene(punch_on_plane);
  const double         mean = scene.state.contact_force.norm(); // the width is 1
  EXPECT_GT(scene.state.max_pressure, 1.5 * mean);
  EXPECT_TRUE(edges_of(scene).empty());
}

/// Bodies that end together are as one.
TEST(SharpEdges, NotWhereBothEnd)
{
  EXPECT_TRUE(
    edges({"Body base/Box corner=0, 0", "Body base/Box size=1, 1", "Body base/Box cells=8, 8"})
      .empty());
}
