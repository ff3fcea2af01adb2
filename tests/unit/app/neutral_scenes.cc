#include <gtest/gtest.h>

#include "solved_scene.h"

using namespace snug;
using namespace snug::test;

namespace {
/// A block over another one; supports, loads and the gap are for tests to set.
std::string block_on_block(const std::string &of_upper, const std::string &of_contact = "")
{
  return R"(
set Dimension = 2
set Bodies = up, lo
subsection Body up
  set Box corner = 0.3, 1
  set Box size = 0.7, 0.3
  set Box cells = 7, 3
  set Young's modulus = 1000
  )" + of_upper +
         R"(
end
subsection Body lo
  set Box cells = 8, 4
  set Young's modulus = 1000
  set Supports = bottom: xy
end
subsection Contact
  set Pairs = up.bottom: lo.top
  )" + of_contact +
         R"(
end
)";
}

const std::string squeezed = "set Pressure = left: 1.7, right: 1.7";

std::vector<std::string> subdomains(unsigned int n)
{
  return with({"Decomposition/Subdomains=" + std::to_string(n)});
}

/// A pin in the hole of a plate, both full rings on the same circle.
std::string pin_in_plate(const std::string &load)
{
  return R"(
set Dimension = 2
set Bodies = pin, plate
subsection Body pin
  set Mesh = ring
  set Inner radius = 3
  set Radius = 10
  set Cells = 48, 4
  set Young's modulus = 210000
  )" + load +
         R"(
end
subsection Body plate
  set Mesh = ring
  set Inner radius = 10.02
  set Radius = 30
  set Cells = 48, 6
  set Young's modulus = 210000
  set Supports = outer: xy
end
subsection Contact
  set Pairs = pin.outer: plate.inner
  set Method = nodal
end
)";
}
} // namespace

TEST(SelfBalancedLoads, AreHeldWhateverTheSubdomains)
{
  // Plane strain, uniform stress: p^2 (1 - nu^2) / 2E per area. The block grows downwards by
  // nu (1 + nu) p / E of its height and rises by that much.
  for (const unsigned int n : {1, 2, 3, 5, 8, 13, 30})
    {
      const SolvedScene<2> solved(block_on_block(squeezed), subdomains(n));
      EXPECT_NEAR(solved.state.energy, -0.5 * 1.7 * 1.7 * 0.91 / 1000. * 0.21, 1e-12) << n;
      EXPECT_LE(solved.state.certificate.worst(), 1e-10) << n;
      EXPECT_EQ(solved.state.active_contacts, 0u) << n;
      ASSERT_EQ(solved.state.free_bodies.size(), 1u) << n;
      EXPECT_EQ(solved.state.free_bodies[0],
                "body up is free to move: translation (1 0), rotation (0); translation (0 1), "
                "rotation (0); translation (0 0), rotation (1)");
    }
}

TEST(SelfBalancedLoads, AreHeldBySmalseAsWell)
{
  for (const std::string tolerance : {"1e-6", "1e-8", "1e-10"})
    for (const std::string n : {"1", "4", "8"})
      {
        const SolvedScene<2> solved(block_on_block(squeezed),
                                    {"Solver/Method=SMALSE-M", "Decomposition/Subdomains=" + n,
                                     "Solver/Relative tolerance=" + tolerance});
        EXPECT_NEAR(solved.state.energy, -0.5 * 1.7 * 1.7 * 0.91 / 1000. * 0.21, 1e-9) << n;
        EXPECT_EQ(solved.state.active_contacts, 0u) << n;
        EXPECT_LE(solved.state.f_mults, 60u) << n;
      }
}

TEST(SelfBalancedLoads, OfABodyThatTouchesNothing)
{
  for (const unsigned int n : {1, 4})
    {
      const SolvedScene<2> solved(block_on_block(squeezed, "set Gap = 0.1"), subdomains(n));
      EXPECT_NEAR(solved.state.energy, -0.5 * 1.7 * 1.7 * 0.91 / 1000. * 0.21, 1e-12) << n;
      EXPECT_EQ(solved.state.free_bodies.size(), 1u) << n;
    }
}

TEST(SelfBalancedLoads, ThatMissBalanceByAMillionthLetTheBodyEscape)
{
  const auto message =
    error_of_solving(block_on_block("set Pressure = left: 1.7, right: 1.700002"));
  EXPECT_NE(message.find("body up is not held against its load along translation (-1 0)"),
            std::string::npos)
    << message;
}

TEST(StressFreeOverlap, EndsInARigidShift)
{
  for (const std::string gap : {"-0.01", "-0.01 + 0.02 * x", "-0.01 * sin(3 * x)"})
    for (const std::string supports : {"", "set Supports = left: x"})
      for (const unsigned int n : {1, 2, 7, 20})
        {
          const SolvedScene<2> solved(block_on_block(supports,
                                                     "set Interference = true\n  set Gap = " + gap),
                                      subdomains(n));
          const auto           what = gap + ", " + supports + ", " + std::to_string(n);
          EXPECT_NEAR(solved.state.strain_energy, 0., 1e-12) << what;
          EXPECT_EQ(solved.state.contact_force.norm(), 0.) << what;
          EXPECT_LE(solved.state.certificate.worst(), 1e-10) << what;
          EXPECT_EQ(solved.state.free_bodies.size(), 1u) << what;
          for (const auto &point : solved.state.contact)
            EXPECT_GE(point.gap, -1e-10) << what;
        }
}

TEST(RoundPin, MaySpinButNotAgainstAMoment)
{
  for (const unsigned int n : {1, 2, 6, 20})
    {
      const SolvedScene<2> solved(pin_in_plate("set Force = inner: 0 -500"), subdomains(n));
      EXPECT_NEAR(solved.state.contact_force[1], 500., 1e-6) << n;
      ASSERT_EQ(solved.state.free_bodies.size(), 1u) << n;
      EXPECT_EQ(solved.state.free_bodies[0],
                "body pin is free to move: translation (0 0), rotation (1)");
    }
  const auto message = error_of_solving(pin_in_plate("set Moment = inner: 1"));
  EXPECT_NE(message.find(
              "body pin is not held against its load along translation (0 0), rotation (1)"),
            std::string::npos)
    << message;
}

TEST(Slider, IsNamedWithItsDirection)
{
  const SolvedScene<2> solved(block_on_block("set Pressure = top: 1"), exact);
  ASSERT_EQ(solved.state.free_bodies.size(), 1u);
  EXPECT_EQ(solved.state.free_bodies[0],
            "body up is free to move: translation (1 0), rotation (0)");
  const SolvedScene<2> held(block_on_block("set Supports = left: x\n  set Pressure = top: 1"),
                            exact);
  EXPECT_EQ(held.state.free_bodies.size(), 0u);
}

TEST(Tie, DoesNotMakeTheActiveSetCycle)
{
  // The load on b3 has its resultant on one contact node; the other has neither force nor gap.
  const std::string stack = R"(
set Dimension = 2
set Bodies = b0, b1, b2, b3
subsection Body b0
 set Box corner = 0.0, 0.0
 set Box size = 1.7370253484580278, 0.9633372344667204
 set Box cells = 5, 4
 set Young's modulus = 276.27677443940064
 set Poisson's ratio = 0.30099538432832695
 set Supports = bottom: xy
end
subsection Body b1
 set Box corner = 0.0, 0.9695277286371133
 set Box size = 0.7706457685668399, 0.8550145052776028
 set Box cells = 5, 5
 set Young's modulus = 3305.6739664733523
 set Poisson's ratio = 0.40453956860430107
 set Supports = left: x
 set Body force = 0.0 -0.000288699496058732
end
subsection Body b2
 set Box corner = 0.0, 1.8245422339147161
 set Box size = 0.8628306700976596, 1.1455139479852392
 set Box cells = 8, 6
 set Young's modulus = 3.0484803261850293
 set Poisson's ratio = 0.3099652100556735
 set Supports = left: x
end
subsection Body b3
 set Box corner = 0.0, 2.9753994092002496
 set Box size = 1.209590232956877, 0.43962590015877584
 set Box cells = 2, 2
 set Young's modulus = 6015.240891581059
 set Poisson's ratio = 0.17252075973635805
 set Traction = top: 0.0 -0.0007007639772097399
end
subsection Contact
 set Pairs = b0.top: b1.bottom, b1.top: b2.bottom, b3.bottom: b2.top
 set Slave = first
end
)";
  for (const unsigned int n : {1, 9, 27, 29, 30})
    {
      const SolvedScene<2> solved(stack, {"Solver/Relative tolerance=1e-9", "Contact/Method=nodal",
                                          "Decomposition/Subdomains=" + std::to_string(n)});
      EXPECT_EQ(solved.state.dual.method, "active set") << n;
      EXPECT_LE(solved.state.f_mults, 30u) << n;
    }
}

TEST(PrescribedMotion, WithoutForcesIsSolvedBySmalse)
{
  for (const unsigned int n : {1, 3, 8, 15})
    {
      const SolvedScene<2> solved(
        block_on_block("set Supports = left: x\n  set Displacement = top: "
                       "y = -0.001",
                       "set Gap = 0.002 + 0.001 * sin(3 * x)"),
        {"Solver/Method=SMALSE-M", "Solver/Relative tolerance=1e-8",
         "Decomposition/Subdomains=" + std::to_string(n)});
      EXPECT_EQ(solved.state.active_contacts, 0u) << n;
      EXPECT_LE(solved.state.f_mults, 100u) << n;
    }
}

TEST(SlenderBeam, PeelsOffItsBase)
{
  // Half of it lifts off, by a third of its thickness per step.
  const SolvedScene<2> solved(R"(
set Dimension = 2
set Model = plane stress
set Bodies = beam
set Obstacles = floor
subsection Body beam
  set Box size = 40, 1
  set Box cells = 320, 4
  set Young's modulus = 1e5
  set Body force = 0, -0.01
  set Supports = left: x
  set Force = right: 0 0.1
end
subsection Obstacle floor
  set Normal = 0, 1
end
subsection Contact
  set Pairs = beam.bottom: floor
end
)");
  EXPECT_EQ(solved.state.dual.method, "active set");
  EXPECT_NEAR(solved.state.contact_force[1], 0.3, 1e-5);
  EXPECT_LE(solved.state.f_mults, 280u);
}
