#include <snug/state/validity_checks.h>

#include <gtest/gtest.h>

#include <cmath>

#include "solved_scene.h"

using namespace snug;
using namespace snug::test;

namespace {
/// A block pressed into the corner of three planes and, from above, by a
/// ball that comes down; nothing else holds it.
const std::string corner_scene = R"(
set Dimension = 3
set Bodies = block
set Obstacles = floor, wall, side, ball
subsection Body block
  set Box cells = 3, 3, 3
  set Young's modulus = 1000
  set Pressure = right: 2, back: 3
end
subsection Obstacle wall
  set Normal = 1, 0, 0
end
subsection Obstacle side
  set Normal = 0, 1, 0
end
subsection Obstacle ball
  set Shape = sphere
  set Point = 0.55, 0.6, 2.5
  set Radius = 1.5
  set Displacement = 0, 0, -0.01
end
subsection Contact
  set Pairs = block.bottom: floor, block.left: wall, block.front: side, block.top: ball
end
)";

/// A quarter of a block under a ball that comes down by 0.004.
const std::string punched_block = R"(
set Dimension = 3
set Bodies = block
set Obstacles = ball
subsection Body block
  set Box size = 0.5, 0.5, 0.5
  set Box cells = 8, 8, 6
  set Box grading = 4, 4, 0.25
  set Young's modulus = 1000
  set Supports = bottom: z, left: x, front: y
end
subsection Obstacle ball
  set Shape = sphere
  set Point = 0, 0, 8.5
  set Radius = 8
  set Displacement = 0, 0, -0.004
end
subsection Contact
  set Pairs = block.top: ball
end
)";
} // namespace

TEST(Obstacles, EqualStiffBodies)
{
  // The block's nodes are slaves of both; those of the meshed ball lie
  // opposite, so that its faces are exact but for terms of fourth order.
  const std::string    stiff = R"(
set Dimension = 3
set Bodies = ball, block
subsection Body ball
  set Box corner = 0, 0, 0.5
  set Box size = 0.5, 0.5, 0.5
  set Box cells = 8, 8, 2
  set Box grading = 4, 4, 1
  set Curved faces = bottom: -(x^2 + y^2) / (8 + sqrt(64 - x^2 - y^2))
  set Young's modulus = 1e9
  set Supports = top: xyz
end
subsection Body block
  set Box size = 0.5, 0.5, 0.5
  set Box cells = 8, 8, 6
  set Box grading = 4, 4, 0.25
  set Young's modulus = 1000
  set Supports = bottom: z, left: x, front: y
end
subsection Contact
  set Slave = first
  set Pairs = block.top: ball.bottom
  set Gap = -0.004
end
)";
  const SolvedScene<3> obstacle(punched_block, {"Solver/Relative tolerance=1e-8"});
  const SolvedScene<3> body(stiff, {"Solver/Relative tolerance=1e-8"});
  EXPECT_GT(body.state.active_contacts, 8u);
  EXPECT_EQ(obstacle.state.active_contacts, body.state.active_contacts);
  EXPECT_NEAR(obstacle.state.contact_force.norm(), body.state.contact_force.norm(),
              1e-3 * body.state.contact_force.norm());
  EXPECT_NEAR(obstacle.state.max_pressure, body.state.max_pressure, 1e-3 * body.state.max_pressure);
}

TEST(Obstacles, TouchBarelyOrNotAtAll)
{
  const auto moved = [](const std::string &distance) {
    return SolvedScene<3>(punched_block, {"Obstacle ball/Displacement=0, 0, " + distance});
  };
  for (const std::string distance : {"0", "0.01"})
    {
      const auto solved = moved(distance);
      EXPECT_EQ(solved.state.contact_force.norm(), 0.);
      EXPECT_EQ(solved.state.certificate.worst(), 0.);
    }
  // one node alone carries forces, in proportion, at gaps elsewhere up to 0.03
  const auto light = moved("-1e-9"), heavy = moved("-1e-6");
  EXPECT_EQ(heavy.state.active_contacts, 1u);
  EXPECT_GT(heavy.state.contact_force.norm(), 0.);
  EXPECT_NEAR(1e3 * light.state.contact_force.norm(), heavy.state.contact_force.norm(),
              1e-5 * heavy.state.contact_force.norm());
}

TEST(Obstacles, DoNotDependOnPlaceAndUnits)
{
  const std::vector<std::string> sharp = {"Solver/Relative tolerance=1e-12"};
  const SolvedScene<3>           there(corner_scene, sharp);
  const SolvedScene<3>           here(corner_scene, sharp, some_motion());
  Motion<3>                      larger;
  larger.factor = 1000.;
  const SolvedScene<3> in_millimetres(corner_scene, sharp, larger);
  ASSERT_EQ(there.state.contact.size(), here.state.contact.size());
  ASSERT_EQ(there.state.contact.size(), in_millimetres.state.contact.size());
  const double p = there.state.max_pressure;
  for (unsigned int i = 0; i < there.state.contact.size(); ++i)
    {
      const auto &point = there.state.contact[i];
      EXPECT_NEAR(point.pressure, here.state.contact[i].pressure, 1e-9 * p);
      EXPECT_NEAR(point.pressure, in_millimetres.state.contact[i].pressure, 1e-9 * p);
    }
  EXPECT_NEAR(there.state.energy, here.state.energy, 1e-9 * std::abs(there.state.energy));
  for (unsigned int pair = 0; pair < 4; ++pair)
    EXPECT_NEAR((some_motion().turned(there.force(pair)) - here.force(pair)).norm(), 0.,
                1e-9 * there.force(pair).norm());
}

TEST(Obstacles, PowersOfTwoTakeTheSameIterations)
{
  Motion<3> larger;
  larger.factor = 32.;
  const SolvedScene<3> small(corner_scene, exact);
  const SolvedScene<3> large(corner_scene, exact, larger);
  EXPECT_EQ(small.state.f_mults, large.state.f_mults);
  EXPECT_EQ(small.state.dual.outer_iterations, large.state.dual.outer_iterations);
  for (unsigned int i = 0; i < small.state.contact.size(); ++i)
    EXPECT_EQ(small.state.contact[i].pressure, large.state.contact[i].pressure);
}

TEST(Obstacles, MoveIntoBodiesWithoutAWord)
{
  const auto overlap_of = [](const std::vector<std::string> &sets) {
    const SolvedScene<3> solved(punched_block, sets);
    const auto          &contact = solved.solver.contact(0);
    EXPECT_GT(solved.state.active_contacts, 0u);
    EXPECT_EQ(state::overlap_warnings(contact.pairs(), contact.paired_gaps()).empty(),
              contact.paired_gaps()[0].overlap < state::large_overlap);
    return contact.paired_gaps()[0].overlap;
  };
  EXPECT_LT(overlap_of({"Obstacle ball/Displacement=0, 0, -0.02"}), 1e-12);
  // where the ball is placed counts
  EXPECT_GT(overlap_of({"Obstacle ball/Point=0, 0, 8.48"}), 0.1);
}
