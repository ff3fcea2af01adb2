#include <snug/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solved_scene.h"

using namespace snug;
using namespace snug::test;

namespace
{
  const std::vector<std::string> exact = {"Solver/Relative tolerance=1e-10"};

  std::vector<std::string>
  with(std::vector<std::string> sets)
  {
    sets.insert(sets.end(), exact.begin(), exact.end());
    return sets;
  }

  /// Two blocks; the upper one is free along z and, without rollers, in all
  /// but that contact holds it.
  std::string
  two_blocks(bool rollers)
  {
    return std::string(R"(
set Dimension = 3
set Bodies = upper, lower
subsection Body upper
  set Box corner = 0, 0, 1
  set Box cells = 4, 4, 4
  set Young's modulus = 1000
  set Pressure = top: 1
)") + (rollers ? "set Supports = left: x, front: y\n" : "") +
           R"(
end
subsection Body lower
  set Box cells = 4, 4, 4
  set Young's modulus = 1000
  set Supports = bottom: xyz
end
subsection Contact
  set Pairs = upper.bottom: lower.top
end
)";
  }

  void
  expect_certified_balance(const SolvedScene<3> &solved)
  {
    EXPECT_LE(solved.state.certificate.worst(), 1e-10);
    EXPECT_NEAR(solved.state.contact_force[2], 1., 1e-9);
  }

  /// Blocks of width 1 in 2D, one on the other, each with its weight; the
  /// lowest stands on an obstacle.
  std::string
  stack(unsigned int n)
  {
    std::string bodies, sections, pairs = "b0.bottom: floor";
    for (unsigned int b = 0; b < n; ++b)
      {
        const std::string name = "b" + std::to_string(b);
        bodies += (b == 0 ? "" : ", ") + name;
        sections += "subsection Body " + name + "\nset Box corner = 0, " +
                    std::to_string(b) +
                    "\nset Box cells = " + std::to_string(3 + b % 2) +
                    ", 3\nset Young's modulus = 1000\nset Body force = 0, -" +
                    std::to_string(b + 1) + "\nend\n";
        if (b > 0)
          pairs += ", b" + std::to_string(b) + ".bottom: b" +
                   std::to_string(b - 1) + ".top";
      }
    return "set Dimension = 2\nset Bodies = " + bodies +
           "\nset Obstacles = floor\n" + sections +
           "subsection Contact\nset Slave = first\nset Pairs = " + pairs +
           "\nend\n";
  }

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

  Motion<3>
  some_rotation()
  {
    Motion<3>            motion;
    dealii::Tensor<2, 3> a = motion.Q, b = motion.Q;
    a[0][0] = a[1][1] = std::cos(0.7);
    a[1][0]           = std::sin(0.7);
    a[0][1]           = -a[1][0];
    b[1][1] = b[2][2] = std::cos(-1.1);
    b[2][1]           = std::sin(-1.1);
    b[1][2]           = -b[2][1];
    motion.Q          = a * b;
    motion.shift      = dealii::Point<3>(3., -2., 5.);
    return motion;
  }

  std::string
  error_of_solving(const std::string &text)
  {
    try
      {
        SolvedScene<2> solved(text);
      }
    catch (const SolveError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(FloatingBlock, ClosesFlatAndWedgeGaps)
{
  for (const std::string gap : {"0.01", "0.01 + 0.02 * x"})
    expect_certified_balance(
      SolvedScene<3>(two_blocks(true), with({"Contact/Gap=" + gap})));
}

TEST(FloatingBlock, TurnsUntilAWedgeIsClosed)
{
  // Only contact holds the block; it turns by 0.02, and no more than where the
  // blocks meet without a gap.
  const SolvedScene<3> flat(two_blocks(false), exact);
  const SolvedScene<3> wedge(two_blocks(false),
                             with({"Contact/Gap=0.01 + 0.02 * x"}));
  expect_certified_balance(flat);
  expect_certified_balance(wedge);
  EXPECT_NEAR(wedge.state.strain_energy,
              flat.state.strain_energy,
              1e-8 * flat.state.strain_energy);
  // the load sinks by the mean gap
  EXPECT_NEAR(wedge.state.compliance - flat.state.compliance, 0.02, 1e-9);
  EXPECT_NEAR(wedge.state.assumptions.rotation -
                flat.state.assumptions.rotation,
              0.02,
              2e-3);
}

TEST(Stack, CarriesTheWeightOfAllThatLiesAbove)
{
  const SolvedScene<2> solved(stack(4), exact);
  EXPECT_LE(solved.state.certificate.worst(), 1e-10);
  const double above[] = {1. + 2. + 3. + 4., 2. + 3. + 4., 3. + 4., 4.};
  for (unsigned int p = 0; p < 4; ++p)
    {
      EXPECT_NEAR(solved.force(p)[1], above[p], 1e-9 * above[p]);
      EXPECT_NEAR(solved.force(p)[0], 0., 1e-9 * above[p]);
    }
}

TEST(Stack, BodiesThatNothingHoldsAreNamed)
{
  const std::string three = stack(3);
  // the middle one is pulled up, and lifts the one on top of it
  EXPECT_NE(error_of_solving(three + "subsection Body b1\nset Body force = 0, "
                                     "10\nend\n")
              .find("escapes: translation (0 1)"),
            std::string::npos);
  // a stack that hangs from nothing: its lowest pair is missing
  auto              loose = three;
  const std::string floor = "b0.bottom: floor, ";
  loose.erase(loose.find(floor), floor.size());
  EXPECT_NE(error_of_solving(loose).find("escapes: translation (0 -1)"),
            std::string::npos);
  // one that lies beside the stack without touching it
  auto              beside = three;
  const std::string upper  = ", b2.bottom: b1.top";
  beside.erase(beside.find(upper), upper.size());
  EXPECT_NE(error_of_solving(beside).find("body b2 "), std::string::npos);
}

TEST(FiveBodies, BalanceAllLoads)
{
  // two pillars with other meshes and materials carry a beam, on which a
  // block lies that a wall holds to the right
  const SolvedScene<2> solved(R"(
set Dimension = 2
set Bodies = ground, left, right, beam, load
set Obstacles = wall
subsection Body ground
  set Box size = 5, 1
  set Box cells = 15, 3
  set Young's modulus = 2000
  set Supports = bottom: xy
end
subsection Body left
  set Box corner = 0.5, 1
  set Box cells = 5, 4
  set Young's modulus = 1000
end
subsection Body right
  set Box corner = 3.5, 1
  set Box cells = 4, 4
  set Young's modulus = 500
end
subsection Body beam
  set Box corner = 0.5, 2
  set Box size = 4, 0.5
  set Box cells = 14, 3
  set Young's modulus = 3000
end
subsection Body load
  set Box corner = 1.5, 2.5
  set Box cells = 4, 4
  set Young's modulus = 1000
  set Traction = top: 0.5 -3
end
subsection Obstacle wall
  set Point = 2.5, 0
  set Normal = -1, 0
end
subsection Contact
  set Pairs = left.bottom: ground.top, right.bottom: ground.top, beam.bottom: left.top, beam.bottom: right.top, load.bottom: beam.top, load.right: wall
end
)",
                              exact);
  EXPECT_LE(solved.state.certificate.worst(), 1e-10);
  const auto up = [&](unsigned int p) {
    // forces act on slaves, which are the upper or the lower bodies
    return std::abs(solved.force(p)[1]);
  };
  EXPECT_NEAR(up(4), 3., 1e-8);
  EXPECT_NEAR(up(2) + up(3), 3., 1e-8);
  EXPECT_NEAR(up(0), up(2), 1e-8);
  EXPECT_NEAR(up(1), up(3), 1e-8);
  EXPECT_GT(up(0), up(1));
  EXPECT_NEAR(solved.force(5)[0], -0.5, 1e-9);
}

TEST(Obstacles, EqualStiffBodies)
{
  // The block's nodes are slaves of both; those of the meshed ball lie
  // opposite, so that its faces are exact but for terms of fourth order.
  const std::string    punch = R"(
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
  const SolvedScene<3> obstacle(punch, {"Solver/Relative tolerance=1e-8"});
  const SolvedScene<3> body(stiff, {"Solver/Relative tolerance=1e-8"});
  EXPECT_GT(body.state.active_contacts, 8u);
  EXPECT_EQ(obstacle.state.active_contacts, body.state.active_contacts);
  EXPECT_NEAR(obstacle.state.contact_force.norm(),
              body.state.contact_force.norm(),
              1e-3 * body.state.contact_force.norm());
  EXPECT_NEAR(obstacle.state.max_pressure,
              body.state.max_pressure,
              1e-3 * body.state.max_pressure);
}

TEST(Obstacles, DoNotDependOnPlaceAndUnits)
{
  const std::vector<std::string> sharp = {"Solver/Relative tolerance=1e-12"};
  const SolvedScene<3>           there(corner_scene, sharp);
  const SolvedScene<3>           here(corner_scene, sharp, some_rotation());
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
      EXPECT_NEAR(point.pressure,
                  in_millimetres.state.contact[i].pressure,
                  1e-9 * p);
    }
  EXPECT_NEAR(there.state.energy,
              here.state.energy,
              1e-9 * std::abs(there.state.energy));
  for (unsigned int pair = 0; pair < 4; ++pair)
    EXPECT_NEAR(
      (some_rotation().turned(there.force(pair)) - here.force(pair)).norm(),
      0.,
      1e-9 * there.force(pair).norm());
}

TEST(Obstacles, PowersOfTwoTakeTheSameIterations)
{
  Motion<3> larger;
  larger.factor = 1024.;
  const SolvedScene<3> small(corner_scene, exact);
  const SolvedScene<3> large(corner_scene, exact, larger);
  EXPECT_EQ(small.state.f_mults, large.state.f_mults);
  EXPECT_EQ(small.state.dual.outer_iterations,
            large.state.dual.outer_iterations);
  for (unsigned int i = 0; i < small.state.contact.size(); ++i)
    EXPECT_EQ(small.state.contact[i].pressure, large.state.contact[i].pressure);
}

TEST(Stack, DoesNotDependOnTheOrderOfBodies)
{
  auto       text = stack(3);
  const auto a    = SolvedScene<2>(text, with({"Bodies=b0, b1, b2"}));
  const auto b    = SolvedScene<2>(text, with({"Bodies=b2, b0, b1"}));
  EXPECT_NEAR(a.state.energy, b.state.energy, 1e-9 * std::abs(a.state.energy));
  for (unsigned int p = 0; p < 3; ++p)
    EXPECT_NEAR((a.force(p) - b.force(p)).norm(), 0., 1e-9);
}

TEST(Warnings, OfStepsBeyondSmallSlidingAndOfOverlap)
{
  SolvedScene<3> solved(two_blocks(true), {"Contact/Gap=-0.1"});
  EXPECT_NEAR(solved.solver.contact().overlaps()[0], 0.4, 1e-12);
}
