#include <gtest/gtest.h>

#include <cmath>

#include "solved_scene.h"

using namespace snug;
using namespace snug::test;

namespace {
/// A quarter of a sphere on a block of other faces.
std::string sphere_on_block(const std::string &bodies = "upper, lower",
                            const std::string &method = "mortar")
{
  return "set Dimension = 3\nset Bodies = " + bodies + R"(
subsection Body upper
  set Box corner = 0, 0, 1
  set Box cells = 4, 4, 3
  set Curved faces = bottom: -(x^2 + y^2) / 32
  set Young's modulus = 1000
  set Supports = left: normal, front: normal
  set Pressure = top: 1
end
subsection Body lower
  set Box cells = 5, 5, 3
  set Young's modulus = 1000
  set Supports = left: normal, front: normal, bottom: normal
end
subsection Contact
  set Method = )" +
         method + R"(
  set Slave = first
  set Pairs = lower.top: upper.bottom
end
)";
}

/// Nested quarter rings with a pressure inside; the inner one has twice as many cells.
std::string rings(double inner_modulus)
{
  return R"(
set Dimension = 2
set Bodies = inner, outer
subsection Body inner
  set Mesh = ring
  set Inner radius = 2
  set Radius = 3
  set Part = quarter
  set Cells = 24, 6
  set Young's modulus = )" +
         std::to_string(inner_modulus) + R"(
  set Supports = start: normal, end: normal
  set Pressure = inner: 10
end
subsection Body outer
  set Mesh = ring
  set Inner radius = 3
  set Radius = 4
  set Part = quarter
  set Cells = 12, 3
  set Young's modulus = 1000
  set Supports = start: normal, end: normal
end
subsection Contact
  set Pairs = inner.outer: outer.inner
end
)";
}

/// (largest - least) / largest pressure.
double scatter(const SolvedScene<2> &solved)
{
  double least = solved.state.max_pressure;
  for (const auto &point : solved.state.contact)
    least = std::min(least, point.pressure);
  return 1. - least / solved.state.max_pressure;
}

const std::vector<std::string> sharp = {"Solver/Relative tolerance=1e-12"};

/// Return the maximum difference of the pressures of two states, in the order of the rows, relative
/// to the maximum pressure.
double largest_difference(const SolvedScene<3> &a, const SolvedScene<3> &b)
{
  EXPECT_EQ(a.state.contact.size(), b.state.contact.size());
  double worst = 0.;
  for (unsigned int i = 0; i < a.state.contact.size(); ++i)
    worst = std::max(worst, std::abs(a.state.contact[i].pressure - b.state.contact[i].pressure));
  return worst / a.state.max_pressure;
}

void expect_invariance(const std::string &method)
{
  SCOPED_TRACE(method);
  const std::string    text = sphere_on_block("upper, lower", method);
  const SolvedScene<3> here(text, sharp);
  EXPECT_GT(here.state.active_contacts, 6u);
  EXPECT_LT(largest_difference(here, {text, sharp, some_motion()}), 1e-9);
  Motion<3> to_millimetres;
  to_millimetres.factor = 1000.;
  EXPECT_LT(largest_difference(here, {text, sharp, to_millimetres}), 1e-9);
  const SolvedScene<3> turned_round(sphere_on_block("lower, upper", method), sharp);
  EXPECT_LT(largest_difference(here, turned_round), 1e-9);
}

void expect_same_iterations(const std::string &method)
{
  SCOPED_TRACE(method);
  const std::string text = sphere_on_block("upper, lower", method);
  Motion<3>         larger;
  larger.factor = 32.;
  const SolvedScene<3> here(text), there(text, {}, larger);
  const SolvedScene<3> stiff(text, {"Body upper/Young's modulus=8192000",
                                    "Body lower/Young's modulus=8192000",
                                    "Body upper/Pressure=top: 8192"});
  EXPECT_EQ(here.state.f_mults, there.state.f_mults);
  EXPECT_EQ(here.state.f_mults, stiff.state.f_mults);
  for (unsigned int i = 0; i < here.state.contact.size(); ++i)
    {
      const double p = here.state.contact[i].pressure;
      EXPECT_EQ(p, there.state.contact[i].pressure);
      EXPECT_EQ(8192. * p, stiff.state.contact[i].pressure);
    }
}
} // namespace

TEST(SphereOnBlock, DoesNotDependOnPlaceUnitsAndOrder)
{
  expect_invariance("nodal");
  expect_invariance("mortar");
}

TEST(SphereOnBlock, PowersOfTwoTakeTheSameIterations)
{
  expect_same_iterations("nodal");
  expect_same_iterations("mortar");
}

namespace {
/// A unit block that stands on another one and hangs over its end by @p overhang, pushed down
/// evenly and held by nothing else but a guide at its side in 3D.
std::string overhanging(unsigned int dim, double overhang, const std::string &cells)
{
  const std::string third = dim == 3 ? ", 0" : "", n = dim == 3 ? ", 2" : "";
  return "set Dimension = " + std::to_string(dim) + R"(
set Bodies = lo, up
subsection Body lo
  set Box cells = 2, 2)" +
         n + R"(
  set Supports = bottom: )" +
         (dim == 3 ? "xyz" : "xy") + R"(
end
subsection Body up
  set Box corner = )" +
         std::to_string(overhang) + third + R"(, 1
  set Box cells = )" +
         cells + R"(
  set Supports = )" +
         (dim == 3 ? "front: y" : "") + R"(
  set Pressure = top: 0.001
end
subsection Contact
  set Pairs = up.bottom: lo.top
  set Slave = first
  set Method = mortar
end
)";
}

template <int dim>
std::string error_of(const std::string &text)
{
  try
    {
      SolvedScene<dim> solved(text);
    }
  catch (const SolveError &error)
    {
      return error.what();
    }
  return "";
}
} // namespace

TEST(Overhang, TipsAsSoonAsItsCentreLiesBeyondTheEnd)
{
  for (const double overhang : {0.1, 0.3, 0.45, 0.49, 0.51, 0.55, 0.6, 0.7})
    {
      const auto expect = [&](const std::string &error) {
        const auto found = error.find("no equilibrium: body up is not held against its load");
        EXPECT_EQ(found != std::string::npos, overhang > 0.5) << overhang << ": " << error;
        EXPECT_TRUE(overhang > 0.5 || error.empty()) << overhang << ": " << error;
      };
      for (const std::string n : {"1", "2", "3", "5"})
        expect(error_of<2>(overhanging(2, overhang, n + ", 2")));
      for (const std::string n : {"1, 2, 2", "2, 3, 2", "3, 1, 2"})
        expect(error_of<3>(overhanging(3, overhang, n)));
    }
}

TEST(Overhang, PushesTheMasterAtItsEndAtMost)
{
  // In balance where the load's centre is, also where the only slave node there hangs over.
  for (const double overhang : {0.1, 0.3, 0.48})
    for (const std::string n : {"1", "2"})
      {
        const SolvedScene<2> solved(overhanging(2, overhang, n + ", 2"), exact);
        EXPECT_NEAR(solved.force(0)[1], 0.001, 1e-11);
        EXPECT_NEAR(solved.state.pairs[0].centre[0], overhang + 0.5, 1e-6);
      }
}

TEST(NestedRings, SlaveIsTheCoarserSide)
{
  for (const double modulus : {100., 1000., 5000., 100000.})
    {
      const SolvedScene<2> solved(rings(modulus));
      EXPECT_EQ(solved.state.contact.size(), 13u) << modulus;
      EXPECT_LT(scatter(solved), 1e-3) << modulus;
      if (modulus >= 1000.)
        {
          EXPECT_GT(scatter({rings(modulus), {"Contact/Slave=first"}}), 0.05) << modulus;
        }
    }
}
