#include <gtest/gtest.h>

#include "error_checks.h"

#include <limits>

#include <snug/scene/check.h>

using namespace snug;

TEST(Errors, TheSceneIsGoodWithoutThem)
{
  EXPECT_EQ(error_of({}), "");
}

TEST(Errors, NameFileLineEntryAndValue)
{
  EXPECT_EQ(error_of({}, replaced(scene_text(), "Poisson's ratio = 0.3", "Poisson's ratio = 0.7")),
            "scene.prm, line 11: entry 'Body punch/Poisson's ratio' = '0.7': "
            "must be above -1 and below 0.5");
  // Also where nobody set the entry, and after continued lines.
  EXPECT_EQ(error_of({}, replaced(scene_text(), "  set Box cells       = 2", "#")),
            "scene.prm: entry 'Body foundation/Box cells' = '': must have 3 "
            "numbers separated by commas, one per dimension");
  EXPECT_EQ(error_of({}, replaced(scene_text(), "top: 100", "top: much")),
            "scene.prm, line 14: entry 'Body punch/Pressure' = 'top: much': "
            "'much' must be a formula of x,y,z (Unexpected token \"much\" found at "
            "position 0)");
}

TEST(Errors, UnknownEntriesAndSections)
{
  EXPECT_EQ(error_of({}, replaced(scene_text(), "Young's modulus", "Yuong's modulus")),
            "scene.prm, line 10: unknown entry 'Body punch/Yuong's modulus' = "
            "'210000'; "
            "did you mean 'Young's modulus'?");
  EXPECT_EQ(error_of({"Solver/Maximum evaluations=3"}),
            "--set: unknown entry 'Solver/Maximum evaluations' = '3'; it belongs to "
            "subsection 'Optimization'");
  EXPECT_EQ(error_of({"Optimization/Task=state"}),
            "--set: unknown entry 'Optimization/Task' = 'state'; it belongs outside of "
            "subsections");
  EXPECT_TRUE(has(error_of({}, scene_text() + "subsection Solvr\nend\n"),
                  "scene.prm, line 38: unknown subsection 'Solvr'; did you "
                  "mean 'Solver'?"));
  EXPECT_TRUE(has(error_of({}, replaced(scene_text(), "Body punch", "Body p")),
                  "line 6: unknown subsection 'Body p'"));
  EXPECT_TRUE(has(error_of({"Body punhc/Box cells=1,1,1"}), "did you mean 'Body punch'?"));
}

TEST(Errors, LinesThatAreNoStatements)
{
  const auto message = [](const std::string &line) {
    return error_of({}, "set Task = state\n" + line + "\n");
  };
  for (const std::string line : {"Task : state", "set Task", "set = 1", "subsection",
                                 "sett Task = 1", "include other.prm", "end here"})
    EXPECT_TRUE(has(message(line), "scene.prm, line 2: '" + line + "' must")) << message(line);
  EXPECT_EQ(message("subsection Solver"), "scene.prm, line 2: 'subsection Solver' has no 'end'");
  EXPECT_EQ(message("end"), "scene.prm, line 2: 'end' without a 'subsection'");
  EXPECT_TRUE(has(error_of({"Task"}), "--set 'Task': must read"));
  EXPECT_TRUE(has(error_of({"Output directory=a#b"}), "must not contain '#'"));
}

TEST(Errors, Choices)
{
  expect_error({"Task", "optimise",
                "one of state, sensitivity, optimize; did "
                "you mean 'optimize'?"});
  expect_error({"Dimension", "4", "one of 2, 3"});
  expect_error({"Element degree", "3", "one of auto, 1, 2"});
  expect_error({"Solver/Method", "active sett", "did you mean 'active set'?"});
  expect_error({"Solver/Factorization", "LAPACK", "CHOLMOD, MUMPS"});
  expect_error({"Solver/Preconditioner", "dirichlet", "'Dirichlet'?"});
  expect_error({"Gradient/Method", "magic", "finite differences"});
  expect_error({"Shape/Basis", "Bezier", "Bezier patch"});
  expect_error({"Solver/Report linear reference", "maybe", "true or false"});
}

TEST(Errors, TypesAndNumbersThatAreNone)
{
  expect_error({"Body punch/Young's modulus", "stiff", "a number"});
  expect_error({"Body punch/Young's modulus", "nan", "a number"});
  expect_error({"Body punch/Young's modulus", "inf", "a number"});
  expect_error({"Body punch/Young's modulus", "1e999", "a number"});
  expect_error({"Body punch/Young's modulus", "1 2", "a number"});
  expect_error({"Body punch/Young's modulus", "", "a number"});
  expect_error({"Body punch/Box cells", "2, two, 2", "whole numbers"});
  expect_error({"Body punch/Box cells", "2, 2.5, 2", "whole numbers"});
  expect_error({"Body punch/Box cells", "0, 4, 4", "at least 1"});
  expect_error({"Body punch/Box cells", "4, 4, 99999999999", "whole numbers"});
  expect_error({"Body punch/Box corner", "0, nan, 0", "numbers"});
  expect_error({"Body punch/Pressure", "top: nan", "a formula of x,y,z"});
  expect_error({"Body punch/Pressure", "top: 1, top: 2", "different"});
  expect_error({"Body punch/Traction", "top: 0 0 inf", "a formula of x,y,z"});
  expect_error({"Body punch/Force", "top: 0 0 inf", "x y z"});
  expect_error({"Body punch/Force", "top: 0 0 x", "x y z"});
  expect_error({"Body punch/Refinements", "-1", "whole number"});
  expect_error({"Decomposition/Subdomains", "2.5", "auto or a whole number"});
  expect_error({"Decomposition/Subdomains", "0", "auto or a whole number"});
}

TEST(Errors, NumbersThatDoNotFitTheDimension)
{
  expect_error({"Body punch/Box cells", "4, 4", "must have 3 numbers"});
  expect_error({"Body punch/Box corner", "4, 4", "must have 3 numbers"});
  expect_error({"Body punch/Box size", "4, 4, 4, 4", "must have 3 numbers"});
  expect_error({"Body punch/Box grading", "1", "must have 3 numbers"});
  expect_error({"Body punch/Body force", "1, 2", "must have 3 formulas"});
  expect_error({"Body punch/Force", "top: 1 2", "must have 3 components"});
  expect_error({"Body punch/Moment", "top: 1", "must have 3 components"});
  expect_error({"Gravity", "0, -9.81", "must have 3 numbers"});
  expect_error({"Body punch/Traction", "top: 1 2", "must have 3 components"});
  expect_error({"Shape/Control points", "3, 3, 3", "must have 2 numbers"});
  expect_error({"Shape/Direction", "0, 1", "3 numbers"});
  expect_error({"Shape/Bounds", "1", "two numbers"});
}

TEST(Errors, BodiesAndBoundaries)
{
  expect_error({"Bodies", "punch, punch", "must not occur twice"});
  expect_error({"Bodies", "", "at least one body"});
  expect_error({"Bodies", "punch.1", "letters"});
  EXPECT_EQ(error_of({}, "set Dimension = 2\n"),
            "scene.prm: entry 'Bodies' = '': must name at least one body");
  expect_error({"Body punch/Supports", "topp: z", "did you mean 'top'?"});
  expect_error({"Body punch/Supports", "top: w", "'w' is not a component"});
  expect_error({"Body punch/Supports", "top: xx", "'x' occurs twice"});
  expect_error({"Body punch/Supports", "top", "boundary: components"});
  expect_error(
    {"Body punch/Supports", "top: normals", "(x, y, z, normal, radial, tangential, axial)"});
  const std::string drive = "Body punch/Displacement";
  expect_error({drive, "topp: z = 1", "did you mean 'top'?"});
  expect_error({drive, "top: z", "'component = formula'"});
  expect_error({drive, "top: w = 1", "'w' is not a component"});
  expect_error({drive, "top: z = x +", "formula of x,y,z"});
  expect_error({drive, "top: z = 1, top: z = 2", "'z' of 'top' is held twice"});
  expect_error({drive, "left: x = 1", "by 'Supports' as well"});
  EXPECT_EQ(error_of({drive + "=top: z = max(x, y), top: x = -0.01"}), "");
  expect_error({"Body punch/Pressure", "side: 1", "left, right, front, back"});
  expect_error({"Body punch/Traction", "side: 1 0 0", "is not a boundary"});
  expect_error({"Body punch/Curved faces", "side: sphere 4", "the faces are"});
  expect_error({"Contact/Pairs", "punch.bottom: foundaton.top", "did you mean 'foundation'?"});
  expect_error({"Contact/Pairs", "punch.bottom: foundation.side", "bottom, top"});
  expect_error({"Contact/Pairs", "punch: foundation.top", "body.boundary"});
  expect_error({"Contact/Pairs", "punch.top: punch.top", "with itself"});
  expect_error({"Contact/Pairs", "punch.bottom: foundation.top, foundation.top: punch.bottom",
                "paired twice"});
  expect_error({"Contact/Pairs", "punch.bottom + foundation.top: foundation.bottom", "one body"});
  expect_error({"Contact/Pairs", "punch.bottom + punch.bottom: foundation.top", "named once"});
  expect_error(
    {"Contact/Pairs", "punch.bottom + punch.top: foundation.top + punch.top", "one body"});
  expect_error({"Contact/Pairs", "punch.bottom + punch.top: punch.top", "with itself"});
  expect_error({"Shape/Face", "foundation.topp", "did you mean 'top'?"});
  expect_error({"Shape/Face", "block.top", "there is no body 'block'"});
}

TEST(Errors, ObstaclesAndPairs)
{
  const std::vector<std::string> floor = {"Obstacles=floor"};
  expect_error({"Obstacles", "floor, floor", "must not occur twice"});
  expect_error({"Contact/Pairs", "floor: punch.bottom", "must come second"}, floor);
  expect_error({"Contact/Pairs", "punch.bottom: flor", "or be an obstacle in 'Obstacles'"}, floor);
  expect_error({"Obstacle floor/Shape", "plain", "did you mean 'plane'?"}, floor);
  expect_error({"Obstacle floor/Point", "1, 2", "3 finite numbers"}, floor);
  expect_error({"Obstacle floor/Normal", "0, 0, 0", "not be all zero"}, floor);
  expect_error({"Obstacle floor/Axis", "0, 1", "3 finite"}, floor);
  expect_error({"Obstacle floor/Radius", "0", "must be above 0"}, floor);
  expect_error({"Obstacle floor/Displacement", "1", "one per dimension"}, floor);
  expect_error({"Obstacle floor/Formula", "x +", "must be a formula"},
               {"Obstacles=floor", "Obstacle floor/Shape=formula"});
  expect_error({"Contact/Search distance", "-1", "must be 0 or above"});
  expect_error({"Contact/Largest angle", "0", "at most 180"});
  expect_error({"Contact/Gap", "2 * t", "must be a formula of x,y,z"});
  expect_error({"Pair punch.bottom: foundation.top/Gap", "", "must be a formula"});
  expect_error({"Pair punch.bottom: foundation.top/Slave", "last", "one of finer, first"});
  EXPECT_TRUE(has(error_of({"Pair punch.bottom: foundation.side/Gap=1"}),
                  "unknown subsection 'Pair punch.bottom: foundation.side'"));
}

TEST(Errors, PropertiesAndMeshes)
{
  expect_error({"Body punch/Young's modulus", "-1", "must be positive"});
  expect_error({"Body punch/Young's modulus", "0", "must be positive"});
  // Forces and displacements would leave the range of floating-point numbers.
  expect_error({"Body punch/Young's modulus", "1e-300", "must be at least 1e-60"});
  expect_error({"Body punch/Young's modulus", "1e+300", "must be at most 1e+60"});
  expect_error({"Body punch/Force", "top: 0 0 -1e+300", "must be at most 1e+60"});
  EXPECT_EQ(error_of({"Body punch/Young's modulus=1e-60"}), "");
  expect_error({"Body punch/Poisson's ratio", "0.5", "below 0.5"});
  expect_error({"Body punch/Poisson's ratio", "-1", "above -1"});
  expect_error({"Body punch/Box size", "1, 1, 0", "must be positive"});
  expect_error({"Body punch/Box grading", "1, 1, -2", "must be positive"});
  expect_error({"Body punch/Box cells", "9999, 9999, 9999", "4e6 cells per MPI rank"});
  expect_error({"Body punch/Refinements", "29", "1e9 cells"});
  const auto twice = error_of({"Body punch/Refinements=40"});
  EXPECT_EQ(twice.find("entry '"), twice.rfind("entry '")) << twice;
  // the coarsest of a series of meshes
  EXPECT_EQ(error_of({"Body punch/Refine where=x-1"}), "");
  expect_error({"Body punch/Local refinements", "16", "at most 15"});
  expect_error({"Body punch/Refine where", "x+(", "formula"});
  EXPECT_TRUE(
    has(error_of({"Body punch/Local refinements=1"}), "entry 'Body punch/Refine where' = ''"));
  EXPECT_TRUE(has(error_of({"Body punch/Curved faces=bottom: sphere 0.1"}),
                  "--set: entry 'Body punch/Curved faces' = "));
  EXPECT_TRUE(has(error_of({"Body punch/Curved faces=bottom: x+("}),
                  "--set: entry 'Body punch/Curved faces' = "));
}

TEST(Errors, Designs)
{
  expect_error({"Shape/Bounds", "0.1, -0.1", "the first below the second"});
  expect_error({"Shape/Bounds", "0.1, 0.1", "the first below the second"});
  expect_error({"Shape/Direction", "0, 0, 0", "not all zero"});
  EXPECT_TRUE(has(error_of({"Shape/Initial=0.3"}), "0.3 must lie within the bounds -0.25, 0.25"));
  expect_error({"Shape/Initial", "0, 0, 0, 0, 0, -0.3", "within the bounds"});
  expect_error({"Shape/Basis", "none", "Task = optimize needs design variables"});
  EXPECT_EQ(error_of({"Shape/Basis=none", "Task=state"}), "");
  expect_error({"Shapes", "a, a", "must not occur twice"});
  expect_error({"Shapes", "a/b", "letters"});
  EXPECT_TRUE(has(error_of({"Shapes=a"}), "unknown subsection 'Shape'"));
}

TEST(Errors, Shapes)
{
  const std::vector<std::string> box = {"Shape/Basis=Bezier box",
                                        "Shape/Face=", "Shape/Box corner=0, 0, 0",
                                        "Shape/Box size=1, 1, 1", "Shape/Control points=3, 3, 3"};
  EXPECT_EQ(error_of(box), "");
  expect_error({"Shape/Box size", "1, 0, 1", "positive"}, box);
  expect_error({"Shape/Box size", "1, 1", "3 numbers"}, box);
  expect_error({"Shape/Box corner", "", "3 numbers"}, box);
  expect_error({"Shape/Bodies", "punch, anvil", "no body 'anvil'"}, box);
  expect_error({"Shape/Control points", "3, 3", "3 numbers"}, box);
  expect_error({"Shape/Face", "foundation.top", "left out"}, box);
  expect_error({"Shape/Reach", "1", "left out"}, box);
  expect_error({"Shape/Degree", "4", "left out for Basis = Bezier box"}, box);
  expect_error({"Shape/Box size", "1, 1, 1", "left out"});
  expect_error({"Shape/Filter radius", "0.1", "left out"});
  expect_error({"Shape/Modes", "0, 0, 1", "left out"});
  const std::vector<std::string> splines = {"Shape/Basis=B-spline patch",
                                            "Shape/Control points=4, 5"};
  EXPECT_EQ(error_of(splines), "");
  expect_error({"Shape/Control points", "3, 5", "'Degree' each"}, splines);
  expect_error({"Shape/Degree", "0", "between 1 and 10"}, splines);
  expect_error({"Shape/Reach", "-1", "positive"}, splines);
  expect_error({"Shape/Interior", "glue", "elasticity"}, splines);
  expect_error({"Shape/Fixed", "edges", "'border'"}, splines);
  expect_error({"Shape/Symmetry", "w: 1", "axes of 'xyz'"}, splines);
  const std::vector<std::string> nodes = {"Shape/Basis=node-wise",
                                          "Shape/Control points=", "Shape/Filter radius=0.1"};
  EXPECT_EQ(error_of(nodes), "");
  expect_error({"Shape/Filter radius", "0", "positive"}, nodes);
  expect_error({"Shape/Filter radius", "-0.1", "positive"}, nodes);
  expect_error({"Shape/Control points", "3, 3", "must be left out"}, nodes);

  const std::vector<std::string> modes = {"Shape/Basis=formula modes", "Shape/Control points=",
                                          "Shape/Direction=", "Shape/Modes=0,0,max(x,y); 1,0,z"};
  EXPECT_EQ(error_of(modes), "");
  EXPECT_EQ(read_with(modes).shapes[0].modes[0][2], "max(x,y)");
  expect_error({"Shape/Modes", "0, x", "3 formulas"}, modes);
  expect_error({"Shape/Fixed", "border", "left out"}, modes);
  expect_error({"Shape/Bodies", "punch", "left out"}, modes);
  EXPECT_TRUE(has(error_of({"Shape/Basis=formula modes",
                            "Shape/Control points=", "Shape/Direction=", "Shape/Modes=0, 0, x+("}),
                  "--set: entry 'Shape/Modes' = 'x+(': must be a formula"));
}

TEST(Errors, Methods)
{
  expect_error({"Optimization/Maximum evaluations", "0", "at least 1"});
  expect_error({"Optimization/Gradient tolerance", "0", "between"});
  expect_error({"Optimization/Objective tolerance", "0", "between"});
  expect_error({"Optimization/Design tolerance", "1", "between"});
  expect_error({"Optimization/Constraint tolerance", "-1", "between"});
  expect_error({"Solver/Relative tolerance", "0", "between 1e-14 and 0.1"});
  expect_error({"Solver/Maximum F-mults", "0", "at least 1"});
  expect_error({"Gradient/Step", "0", "above 0 and at most 0.1"});
  expect_error({"Gradient/Semi-analytic step", "1", "at most 0.1"});
  expect_error({"Gradient/Method", "energy", "objective 'compliance'"},
               {"Optimization/Objective=compliance"});
}

TEST(Errors, RequestsThatCannotMeanAnything)
{
  expect_error({"Load case a/Weight", "0", "at least one"}, {"Load cases=a"});
  expect_error({"Contact/Largest angle", "80", "at most 60 for mortar"}, {"Contact/Method=mortar"});
  EXPECT_EQ(error_of({"Contact/Method=mortar"}), "");
  expect_error({"Optimization/Objective", "mass", "no 'Density'"});
  expect_error({"Optimization/Constraints", "mass: initial", "no 'Density'"});
  EXPECT_EQ(error_of({"Optimization/Constraints=mass: initial", "Body punch/Density=1"}), "");
}

TEST(Errors, LongValuesAreCutAndStayOneLine)
{
  const std::string message = error_of({"Body punch/Young's modulus=1\t" + std::string(1000, 'x')});
  EXPECT_LT(message.size(), 200U);
  EXPECT_FALSE(has(message, "\t"));
}

TEST(Check, FindsNumbersThatAreNoneInScenesFromPrograms)
{
  const double nan      = std::numeric_limits<double>::quiet_NaN();
  const auto   spoilers = {
    +[](scene::Scene &s, double x) { s.bodies[0].mesh.corner[1] = x; },
    +[](scene::Scene &s, double x) { s.bodies[0].mesh.size[1] = x; },
    +[](scene::Scene &s, double x) { s.bodies[1].mesh.grading[0] = x; },
    +[](scene::Scene &s, double x) { s.bodies[1].material.youngs_modulus = x; },
    +[](scene::Scene &s, double x) { s.bodies[1].material.poissons_ratio = x; },
    +[](scene::Scene &s, double x) { s.bodies[0].material.density = x; },
    +[](scene::Scene &s, double x) { s.gravity = {0., 0., x}; },
    +[](scene::Scene &s, double x) { s.bodies[0].loads.force["top"] = {0., x, 0.}; },
    +[](scene::Scene &s, double x) { s.bodies[0].loads.moment["top"] = {0., x, 0.}; },
    +[](scene::Scene &s, double x) { s.shapes[0].bounds[1] = x; },
    +[](scene::Scene &s, double x) { s.shapes[0].initial.assign(6, x); },
    +[](scene::Scene &s, double x) { s.shapes[0].direction[2] = x; },
    +[](scene::Scene &s, double x) { s.state_tolerance = x; },
    +[](scene::Scene &s, double x) { s.gradient.step = x; },
    +[](scene::Scene &s, double x) { s.optimization.design_tolerance = x; }};
  const scene::Scene good = read_with({});
  EXPECT_NO_THROW(scene::check(good));
  unsigned int number = 0;
  for (const auto spoil : spoilers)
    {
      scene::Scene bad = good;
      spoil(bad, nan);
      EXPECT_THROW(scene::check(bad), InputError) << "spoiler " << number;
      bad = good;
      spoil(bad, std::numeric_limits<double>::infinity());
      EXPECT_THROW(scene::check(bad), InputError) << "spoiler " << number;
      ++number;
    }
}
