#include <snug/app/shape_problem.h>

#include <gtest/gtest.h>

#include "solved_scene.h"

/// Positions of bodies and obstacles in load cases, against scenes whose bodies are placed there
/// by `Rotate` and `Shift`, and against statics.
namespace {
using namespace snug;
using namespace snug::test;

/// Relative difference of forces of states that are solved to 1e-12.
const double tolerance = 1e-10;

const std::vector<std::string> to_1e_12 = {"Solver/Relative tolerance=1e-12"};

/// A block with a curved bottom on a block; @p more belongs to the upper body.
std::string blocks(const std::string &more, const std::string &load_cases)
{
  return R"(
set Dimension = 2
set Bodies = up, lo
set Load cases = a, b
subsection Body up
  set Box size = 1, 1
  set Box cells = 9, 5
  set Curved faces = bottom: cylinder z -2
  set Young's modulus = 2000
  )" + more +
         R"(
end
subsection Body lo
  set Box corner = -0.5, -1
  set Box size = 2, 1
  set Box cells = 14, 6
  set Young's modulus = 1000
  set Supports = bottom: xy
end
subsection Contact
  set Pairs = up.bottom: lo.top
end
)" + load_cases;
}

/// A pin in the hole of a plate, which the pin does not match.
std::string pin(const std::string &of_pin, const std::string &load_cases)
{
  return R"(
set Dimension = 2
set Bodies = pin, plate
set Load cases = a, b
set Element degree = 2
subsection Body pin
  set Mesh = ring
  set Inner radius = 3
  set Radius = 10
  set Cells = 32, 2
  set Young's modulus = 210000
  )" + of_pin +
         R"(
end
subsection Body plate
  set Mesh = ring
  set Inner radius = 10.02
  set Radius = 30
  set Cells = 40, 3
  set Young's modulus = 210000
  set Supports = outer: xy
end
subsection Contact
  set Pairs = pin.outer: plate.inner
end
)" + load_cases;
}

/// Load cases a, of no position, and b, of the given one. All other entries are equal.
std::string cases(const std::string &entries, const std::string &of_b)
{
  return "subsection Load case a\n" + entries + "\nend\nsubsection Load case b\n" + entries + "\n" +
         of_b + "\nend\n";
}

/// Forces of the contact rows of a load case.
template <int dim>
std::vector<double> forces(SolvedScene<dim> &of, const unsigned int load_case)
{
  const auto          state = of.solver.solve(of.positions, qp::WarmStart(), load_case);
  std::vector<double> result;
  for (const auto &point : state.contact)
    result.push_back(point.force);
  return result;
}

void expect_equal(const std::vector<double> &a, const std::vector<double> &b)
{
  ASSERT_EQ(a.size(), b.size());
  double largest = 0.;
  for (const double force : a)
    largest = std::max(largest, force);
  ASSERT_GT(largest, 0.);
  for (unsigned int i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], tolerance * largest);
}

TEST(Positions, OfAngleZeroChangeNothing)
{
  SolvedScene<2> solved(
    blocks("", cases("set Force = up.top: 1 -50\nset Displacement = up.top: x = "
                     "0",
                     "set Position = up: rotate z 0 about 1 2, shift 0 0")));
  EXPECT_EQ(forces(solved, 0), forces(solved, 1));
  EXPECT_EQ(solved.solver.positions().size(), 1u);
}

TEST(Positions, OfTheWholeSceneDoNotChangeForces)
{
  const std::string loads =
    "set Pressure = up.top: 50*(1+x)\nset Gravity = 0 -1\nset Displacement = up.left: normal = 0";
  for (const std::string method : {"nodal", "mortar"})
    {
      auto sets = to_1e_12;
      sets.push_back("Contact/Method=" + method);
      SolvedScene<2> solved(blocks("set Density = 0.1",
                                   cases(loads,
                                         "set Position = up: rotate z 30 about 1 2, shift 3 4; lo: "
                                         "rotate z 30 about 1 2, shift 3 4")),
                            sets);
      EXPECT_EQ(solved.solver.positions().size(), 2u);
      expect_equal(forces(solved, 0), forces(solved, 1));
    }
}

/// Q x + c - Q c is the placement of a body that is turned about c.
TEST(Positions, AreThoseOfBodiesThatAreBuiltThere)
{
  const std::string  loads = "set Force = up.top: 1 -50\nset Displacement = up.left: normal = 0";
  const double       angle = 4., w = angle * M_PI / 180.;
  std::ostringstream shift;
  shift.precision(17);
  shift << "set Rotate = z: 4\nset Shift = " << 0.5 - 0.5 * std::cos(w) + 0.1 << ", "
        << -0.5 * std::sin(w) - 0.01;
  for (const std::string method : {"nodal", "mortar"})
    {
      auto sets = to_1e_12;
      sets.push_back("Contact/Method=" + method);
      SolvedScene<2> moved(
        blocks("",
               cases(loads, "set Loads in space = true\nset Position = up: rotate z 4 about 0.5 "
                            "0, shift 0.1 -0.01")),
        sets);
      SolvedScene<2> built(blocks(shift.str(), cases(loads, "")), sets);
      expect_equal(forces(moved, 1), forces(built, 0));
    }
}

/// Curved surfaces turn with their bodies, at an angle that is no multiple of the cells'.
TEST(Positions, TurnTrueSurfaces)
{
  const auto displacement = [](const double x, const double y) {
    std::ostringstream text;
    text.precision(17);
    text << "set Displacement = pin.inner: x = " << x << ", pin.inner: y = " << y;
    return text.str();
  };
  const double   c = std::cos(7.3 * M_PI / 180.), s = std::sin(7.3 * M_PI / 180.);
  SolvedScene<2> moved(pin("",
                           cases(displacement(0.05, -0.02), "set Position = pin: rotate z 7.3")),
                       to_1e_12);
  SolvedScene<2> built(pin("set Rotate = z: 7.3",
                           cases(displacement(0.05 * c + 0.02 * s, 0.05 * s - 0.02 * c), "")),
                       to_1e_12);
  expect_equal(forces(moved, 1), forces(built, 0));
}

/// A bar on two round supports and against a wall, all turned by 30 degrees.
std::string supported_bar(const std::string &of_b)
{
  const std::string turn = "rotate z 30 about 5 0";
  return R"(
set Dimension = 2
set Bodies = bar
set Obstacles = left, right, wall
set Load cases = a, b
subsection Body bar
  set Box size = 10, 1
  set Box cells = 40, 4
  set Young's modulus = 200000
end
subsection Obstacle left
  set Shape = cylinder
  set Point = 1, -1
  set Radius = 1
end
subsection Obstacle right
  set Shape = cylinder
  set Point = 9, -1
  set Radius = 1
end
subsection Obstacle wall
  set Shape = plane
  set Point = 0, 0
  set Normal = 1, 0
end
subsection Contact
  set Pairs = bar.bottom: left, bar.bottom: right, bar.left: wall
end
)" + cases("set Force = bar.top: -1e-3 -100", of_b + "\nset Position = bar: " + turn + "; left: " +
                                                turn + "; right: " + turn + "; wall: " + turn);
}

/// Return the forces of the pairs with the left and right support and with the wall.
std::vector<double> forces_of_pairs(SolvedScene<2> &solved)
{
  const auto          state = solved.solver.solve(solved.positions, qp::WarmStart(), 1);
  std::vector<double> result;
  for (const auto &pair : state.pairs)
    result.push_back(pair.force.norm());
  return result;
}

TEST(Positions, TurnLoadsUnlessTheyAreInSpace)
{
  SolvedScene<2> follower(supported_bar(""), to_1e_12),
    in_space(supported_bar("set Loads in space = true"), to_1e_12);
  const auto   turned = forces_of_pairs(follower), straight = forces_of_pairs(in_space);
  const double c = std::cos(M_PI / 6.), s = std::sin(M_PI / 6.);
  EXPECT_NEAR(turned[0] + turned[1], 100., 1e-6);
  EXPECT_NEAR(turned[2], 1e-3, 1e-8);
  // The load is (-0.001, -100) in space; the wall faces along (cos 30, sin 30).
  EXPECT_NEAR(straight[0] + straight[1], 100. * c - 1e-3 * s, 1e-6);
  EXPECT_NEAR(straight[2], 100. * s + 1e-3 * c, 1e-6);
}

TEST(Positions, NeedOnePairInContact)
{
  const auto two_pairs = [](const std::string &shift) {
    return blocks("", cases("set Force = up.top: 0 -50\nset Displacement = up.top: x = 0",
                            "set Position = up: shift " + shift)) +
           "subsection Contact\n  set Pairs = up.bottom: lo.top, up.right: lo.left\n"
           "  set Search distance = 0.4\nend\n";
  };
  const auto error = [](const std::string &text) -> std::string {
    try
      {
        SolvedScene<2> solved(text);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  };
  EXPECT_NE(error(two_pairs("0 9")).find("in load case 'a'"), std::string::npos);
  const auto one_pair = [](const std::string &shift) {
    return blocks("", cases("set Force = up.top: 0 -50\nset Displacement = up.top: x = 0",
                            "set Position = up: shift " + shift)) +
           "subsection Contact\n  set Search distance = 0.4\nend\n";
  };
  EXPECT_NE(error(one_pair("0 9")).find("in load case 'b'"), std::string::npos);
  EXPECT_EQ(error(one_pair("0.3 0")), "");
}
} // namespace
