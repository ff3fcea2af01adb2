#include <snug/app/mesh_checks.h>
#include <snug/base/errors.h>
#include <snug/state/validity_checks.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solved_scene.h"

using namespace snug;
using namespace snug::test;

namespace {
/// Two blocks; the upper one is free along z and, without rollers, in all
/// but that contact holds it.
std::string two_blocks(bool rollers)
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

void expect_certified_balance(const SolvedScene<3> &solved)
{
  EXPECT_LE(solved.state.certificate.worst(), 1e-10);
  EXPECT_NEAR(solved.state.contact_force[2], 1., 1e-9);
}

/// Blocks of width 1 in 2D, one on the other, each with its weight; the
/// lowest stands on an obstacle.
std::string stack(unsigned int n)
{
  std::string bodies, sections, pairs = "b0.bottom: floor";
  for (unsigned int b = 0; b < n; ++b)
    {
      const std::string name = "b" + std::to_string(b);
      bodies += (b == 0 ? "" : ", ") + name;
      sections += "subsection Body " + name + "\nset Box corner = 0, " + std::to_string(b) +
                  "\nset Box cells = " + std::to_string(3 + b % 2) +
                  ", 3\nset Young's modulus = 1000\nset Body force = 0, -" + std::to_string(b + 1) +
                  "\nend\n";
      if (b > 0)
        pairs += ", b" + std::to_string(b) + ".bottom: b" + std::to_string(b - 1) + ".top";
    }
  return "set Dimension = 2\nset Bodies = " + bodies + "\nset Obstacles = floor\n" + sections +
         "subsection Contact\nset Slave = first\nset Pairs = " + pairs + "\nend\n";
}
} // namespace

TEST(FloatingBlock, ClosesFlatAndWedgeGaps)
{
  for (const std::string gap : {"0.01", "0.01 + 0.02 * x"})
    expect_certified_balance(SolvedScene<3>(two_blocks(true), with({"Contact/Gap=" + gap})));
}

TEST(FloatingBlock, TurnsUntilAWedgeIsClosed)
{
  // Only contact holds the block; it turns by 0.02, and no more than where the
  // blocks meet without a gap.
  const SolvedScene<3> flat(two_blocks(false), exact);
  const SolvedScene<3> wedge(two_blocks(false), with({"Contact/Gap=0.01 + 0.02 * x"}));
  expect_certified_balance(flat);
  expect_certified_balance(wedge);
  EXPECT_NEAR(wedge.state.strain_energy, flat.state.strain_energy, 1e-8 * flat.state.strain_energy);
  // the load sinks by the mean gap
  EXPECT_NEAR(wedge.state.compliance - flat.state.compliance, 0.02, 1e-9);
  EXPECT_NEAR(wedge.state.validity.rotation - flat.state.validity.rotation, 0.02, 2e-3);
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
              .find("is not held against its load along translation (0 1)"),
            std::string::npos);
  // a stack that hangs from nothing: its lowest pair is missing
  auto              loose = three;
  const std::string floor = "b0.bottom: floor, ";
  loose.erase(loose.find(floor), floor.size());
  EXPECT_NE(error_of_solving(loose).find("is not held against its load along translation (0 -1)"),
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

TEST(Stack, DoesNotDependOnTheOrderOfBodies)
{
  auto       text = stack(3);
  const auto a    = SolvedScene<2>(text, with({"Bodies=b0, b1, b2"}));
  const auto b    = SolvedScene<2>(text, with({"Bodies=b2, b0, b1"}));
  EXPECT_NEAR(a.state.energy, b.state.energy, 1e-9 * std::abs(a.state.energy));
  for (unsigned int p = 0; p < 3; ++p)
    EXPECT_NEAR((a.force(p) - b.force(p)).norm(), 0., 1e-9);
}

TEST(Warnings, OfStrainAndSlipOfABlockPressedOnAPlane)
{
  // plane strain: e_xx = nu (1 + nu) p / E, e_yy = -(1 - nu^2) p / E; the node
  // at the right end slides by e_xx, faces are 1/4
  const SolvedScene<2> solved(R"(
set Dimension = 2
set Bodies = block
set Obstacles = floor
subsection Body block
  set Box cells = 4, 4
  set Young's modulus = 10
  set Poisson's ratio = 0.3
  set Supports = left: x
  set Pressure = top: 4
end
subsection Contact
  set Pairs = block.bottom: floor
end
)",
                              exact);
  const auto          &validity = solved.state.validity;
  const double         e_xx = 0.3 * 1.3 * 0.4, e_yy = -0.91 * 0.4;
  EXPECT_NEAR(validity.strain, std::hypot(e_xx, e_yy), 1e-8);
  EXPECT_NEAR(validity.rotation, 0., 1e-8);
  EXPECT_NEAR(validity.slip, 4. * e_xx, 1e-8);
  EXPECT_EQ(validity.drift, 0.);
  const auto lines = state::warnings(validity);
  ASSERT_EQ(validity.geometric.size(), 1u);
  EXPECT_NEAR(validity.geometric[0].of_force(), 1.5 * e_yy, 1e-8); // no stress across
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].text.find(
              "large displacements would change the stiffness of body block by about "
              "-55 %"),
            0u)
    << lines[0].text;
  EXPECT_EQ(lines[1].text.find("strains are up to 0.4"), 0u) << lines[1].text;
  EXPECT_EQ(lines[2].text.find("nodes in contact slip by up to 0.62 of a face"), 0u)
    << lines[2].text;
}

TEST(Warnings, OfDesignsThatLeaveTheirPairing)
{
  for (const std::string method : {"nodal", "mortar"})
    {
      SolvedScene<3> solved(two_blocks(true), {"Contact/Method=" + method});
      const auto    &contact = solved.solver.contact(0);
      const auto    &surface = solved.solver.surface();
      auto           x       = surface.gather(solved.positions);
      for (const double drift : contact.pairing_drifts(x, contact.rows(x)))
        EXPECT_NEAR(drift, 0., 1e-12) << method;
      for (const auto &place : contact.places())
        {
          x[place.slave][0] += 0.1;
          x[place.slave][2] += 0.3; // opens, but stays opposite
        }
      double largest = 0.;
      for (const double drift : contact.pairing_drifts(x, contact.rows(x)))
        largest = std::max(largest, drift);
      EXPECT_NEAR(largest, 0.4, 1e-12) << method;
    }
}

TEST(Warnings, OfOverlapUnlessItIsWanted)
{
  const SolvedScene<3> solved(two_blocks(true), {"Contact/Gap=-0.1"});
  const auto          &gaps  = solved.solver.contact(0).paired_gaps();
  const auto          &pairs = solved.solver.contact(0).pairs();
  EXPECT_NEAR(gaps[0].least, -0.1, 1e-13);
  EXPECT_NEAR(gaps[0].overlap, 0.4, 1e-12);
  const auto lines = state::overlap_warnings(pairs, gaps);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].text.find("is up to 0.1 (0.4 times the face size)"), std::string::npos)
    << lines[0].text;
  EXPECT_NO_THROW(state::check_overlaps(pairs, gaps));
  EXPECT_THROW(state::check_overlaps(pairs, {{-1., 0., 2.1}}), InputError);
  const SolvedScene<3> wanted(two_blocks(true), {"Contact/Gap=-0.1", "Contact/Interference=true"});
  const auto          &intended = wanted.solver.contact(0).paired_gaps();
  EXPECT_NEAR(intended[0].least, -0.1, 1e-13);
  EXPECT_EQ(intended[0].overlap, 0.);
  EXPECT_EQ(state::overlap_warnings(pairs, intended).size(), 0u);
}

TEST(Warnings, OfFacetsThatContactSees)
{
  state::ValidityChecks validity;
  validity.facet_height = 0.0049;
  validity.closed_gap   = 0.1;
  EXPECT_EQ(state::warnings(validity).size(), 0u);
  validity.facet_height = 0.0051;
  const auto lines      = state::warnings(validity);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].text.find("facet height 0.0051 of a contact surface is 5.1 %"),
            std::string::npos)
    << lines[0].text;
  EXPECT_NE(lines[0].text.find("gap or overlap that closes"), std::string::npos) << lines[0].text;
}

TEST(Warnings, OfRefineWhereThatCatchesNothing)
{
  const auto unrefined = [](const std::string &where) {
    const SolvedScene<3> solved(two_blocks(true),
                                {"Body lower/Refine where=" + where,
                                 "Body lower/Local refinements=2", "Body lower/Refinements=1"});
    return app::refinement_warnings(solved.scene, solved.mesh);
  };
  EXPECT_EQ(unrefined("0.1 - x").size(), 0u);
  // no centre of a cell is as near to the face
  const auto lines = unrefined("0.01 - x");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].find("'Refine where' of body lower"), 0u) << lines[0];
  EXPECT_NE(lines[0].find("none of its 512 cells"), std::string::npos) << lines[0];
}

TEST(Unloaded, NothingMoves)
{
  const SolvedScene<3> solved(two_blocks(true), {"Body upper/Pressure="});
  EXPECT_LT(solved.state.validity.displacement, state::least_motion);
  EXPECT_GT(SolvedScene<3>(two_blocks(true)).state.validity.displacement, 1e-4);
}

TEST(EdgeOfTheMaster, ForcesFadeAsItShrinks)
{
  // The outer node of the block stands on the end of its base, which shrinks by up to 5 % of a
  // face; a plate holds the block upright.
  const auto force_at_end = [](const double shrunk) {
    const SolvedScene<2> solved("set Dimension = 2\nset Bodies = up, lo\nsubsection Body up\n"
                                "set Box corner = 0, 1\nset Box cells = 4, 4\n"
                                "set Young's modulus = 1000\nset Supports = left: x, right: x\n"
                                "set Pressure = top: 1\nend\nsubsection Body lo\nset Box size = " +
                                  to_text(1. - shrunk) +
                                  ", 1\nset Box cells = 4, 4\nset Young's modulus = 1000\n"
                                  "set Supports = bottom: xy\nend\nsubsection Contact\n"
                                  "set Pairs = up.bottom: lo.top\nset Slave = first\n"
                                  "set Method = nodal\nend\n",
                                exact);
    const auto          &contact = solved.solver.contact(0);
    const auto           x       = solved.solver.surface().gather(solved.positions);
    double               sum = 0., at_end = 0.;
    for (unsigned int i = 0; i < contact.places().size(); ++i)
      {
        sum += solved.state.contact[i].force;
        if (x[contact.places()[i].slave][0] > 1. - 1e-9)
          at_end = solved.state.contact[i].force;
      }
    EXPECT_NEAR(sum, 1., 1e-9);
    return at_end;
  };
  const double first = force_at_end(0.);
  double       last  = first;
  EXPECT_GT(first, 0.05);
  EXPECT_NEAR(force_at_end(1e-6), first, 1e-4 * first);
  for (double shrunk = 5e-4; shrunk < 0.0125; shrunk *= 1.02)
    {
      const double now = force_at_end(shrunk);
      EXPECT_LE(now, last + 1e-9) << shrunk;
      EXPECT_GT(now, last - 0.15 * first) << shrunk;
      last = now;
    }
  EXPECT_EQ(last, 0.);
}
