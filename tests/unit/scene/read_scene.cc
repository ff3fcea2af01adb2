#include <gtest/gtest.h>

#include "scene_text.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

#include <unistd.h>

#include <snug/base/values.h>

using namespace snug;

using Numbers  = std::vector<double>;
using Integers = std::vector<unsigned int>;

TEST(ReadScene, FillsTheParametersOfEveryModule)
{
  const scene::Scene scene = read_with({});
  EXPECT_EQ(scene.task, scene::Task::optimize);
  EXPECT_EQ(scene.dimension, 3U);
  EXPECT_EQ(scene.contact.pairs.size(), 1U);
  EXPECT_EQ(scene.contact.pairs.at(0).slave, "punch.bottom");
  EXPECT_EQ(scene.contact.pairs.at(0).master, "foundation.top");
  EXPECT_EQ(scene.shapes[0].basis, "Bezier patch");
  EXPECT_EQ(scene.shapes[0].control_points, (Integers{3, 2}));
  EXPECT_EQ(scene.shapes[0].bounds, (Numbers{-0.25, 0.25}));
  EXPECT_EQ(scene.optimization.constraints,
            (std::vector<std::pair<std::string, std::string>>{{"volume", "initial"}}));
  EXPECT_EQ(scene.optimization.objective, "potential energy");
}

/// The algorithm SQP was called SLSQP.
TEST(ReadScene, ReadsTheFormerNameOfAnAlgorithm)
{
  const auto scene = read_with({"Optimization/Algorithm=MMA", "Optimization/Algorithm=SLSQP"});
  EXPECT_EQ(scene.optimization.algorithm, optimization::Algorithm::SQP);
}

TEST(ReadScene, KeepsTwoBodiesApart)
{
  const scene::Scene scene = read_with({});
  ASSERT_EQ(scene.bodies.size(), 2U);
  const auto &punch      = scene.bodies[0];
  const auto &foundation = scene.bodies[1];
  EXPECT_EQ(punch.name, "punch");
  EXPECT_EQ(punch.mesh.corner, (Numbers{0, 0, 1}));
  EXPECT_EQ(punch.mesh.cells, (Integers{3, 4, 5}));
  EXPECT_EQ(punch.mesh.curved_faces.at("bottom"), "sphere 4");
  EXPECT_EQ(punch.mesh.curved_faces.at("top"), "0.1*min(x,y)");
  EXPECT_EQ(punch.material.youngs_modulus, 210000.);
  EXPECT_EQ(punch.supports.at("left"), "x");
  EXPECT_EQ(punch.supports.at("front"), "y");
  EXPECT_EQ(punch.loads.pressure.at("top"), "100");
  EXPECT_EQ(components(punch.loads.traction.at("top")),
            (std::vector<std::string>{"0", "0", "-5.5"}));
  EXPECT_EQ(components(punch.loads.traction.at("left")), (std::vector<std::string>{"1", "0", "0"}));
  EXPECT_EQ(foundation.mesh.cells, (Integers{2, 2, 2}));
  EXPECT_EQ(foundation.mesh.grading, (Numbers{1, 1, 0.5}));
  EXPECT_EQ(foundation.mesh.refinements, 1U);
  EXPECT_EQ(foundation.material.youngs_modulus, 70000.);
  EXPECT_TRUE(foundation.loads.pressure.empty());
}

TEST(ReadScene, FillsEmptyListsWithTheirDefaults)
{
  const scene::Scene scene = read_with({});
  EXPECT_EQ(scene.bodies[0].mesh.size, (Numbers{1, 1, 1}));
  EXPECT_EQ(scene.bodies[0].mesh.grading, (Numbers{1, 1, 1}));
  EXPECT_EQ(scene.bodies[1].mesh.corner, (Numbers{0, 0, 0}));
}

TEST(ReadScene, NamedShapesHaveTheirOwnSubsections)
{
  const std::string text  = replaced(scene_text(), "subsection Shape\n",
                                     "set Shapes = a, left side\n"
                                      "subsection Shape left side\n"
                                      "set Basis = none\nend\n"
                                      "subsection Shape a\n");
  const auto        scene = read_with({"Shape left side/Bounds=0,1"}, text);
  ASSERT_EQ(scene.shapes.size(), 2U);
  EXPECT_EQ(scene.shapes[0].name, "a");
  EXPECT_EQ(scene.shapes[0].control_points, (Integers{3, 2}));
  EXPECT_EQ(scene.shapes[1].name, "left side");
  EXPECT_EQ(scene.shapes[1].basis, "none");
  EXPECT_EQ(scene.shapes[1].bounds, (Numbers{0, 1}));
  EXPECT_EQ(printed(read_with({}, printed(scene))), printed(scene));
}

TEST(ReadScene, OverridesComeAfterTheFile)
{
  const scene::Scene scene =
    read_with({"Body punch/Box cells=4,4,4", "Task = state", "Body punch/Young's modulus=1",
               "Body punch/Young's modulus=2"});
  EXPECT_EQ(scene.bodies[0].mesh.cells, (Integers{4, 4, 4}));
  EXPECT_EQ(scene.task, scene::Task::state);
  EXPECT_EQ(scene.bodies[0].material.youngs_modulus, 2.);
  EXPECT_EQ(scene::read_scene({"scene.prm", scene_text(), {}, "elsewhere"}).output_directory,
            "elsewhere");
}

TEST(ReadScene, SubdomainsAreANumberOrChosen)
{
  const std::string entry = "Decomposition/Subdomains=";
  EXPECT_EQ(read_with({}).tearing.subdomains, 0U);
  EXPECT_EQ(read_with({entry + "12"}).tearing.subdomains, 12U);
  EXPECT_EQ(read_with({entry + "12", entry + "auto"}).tearing.subdomains, 0U);
}

TEST(ReadScene, BodiesAreNearlyIncompressibleByTheirMaterialsAndBBar)
{
  const auto is_so = [](const std::vector<std::string> &overrides) {
    const auto scene = read_with(overrides);
    return scene::is_nearly_incompressible(scene, scene.bodies[0]);
  };
  const std::string b_bar = "Body punch/Formulation=B-bar", ratio = "Body punch/Poisson's ratio=";
  EXPECT_FALSE(is_so({ratio + "0.4999"}));
  EXPECT_FALSE(is_so({b_bar, ratio + "0.49"}));
  EXPECT_TRUE(is_so({b_bar, ratio + "0.499"}));
  auto scene = read_with({b_bar});
  scene.materials.resize(1);
  scene.materials[0].name                    = "rubber";
  scene.materials[0].material.poissons_ratio = 0.4999;
  scene.bodies[0].materials["coat"]          = "rubber";
  EXPECT_TRUE(scene::is_nearly_incompressible(scene, scene.bodies[0]));
}

TEST(ReadScene, LaterStatementsOfAFileWinAndLineEndsDoNotMatter)
{
  std::string text = scene_text() + "SET  Output   directory =  a b \nEnd";
  text.resize(text.size() - 4);
  EXPECT_EQ(read_with({}, text).output_directory, "a b");
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : scene_text())
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(printed(read_with({}, windows)), printed(read_with({})));
}

/// A message that quotes it would end there.
TEST(ReadScene, RefusesBytesThatAreZero)
{
  std::string text = scene_text();
  text.insert(text.find('=') + 2, 1, '\0');
  try
    {
      read_with({}, text);
      FAIL();
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("contains a null byte"), std::string::npos);
    }
}

TEST(PrintScene, ReadsBackToTheSameScene)
{
  // Numbers without a short decimal form, and every kind of value.
  const scene::Scene scene = read_with(
    {"Body punch/Young's modulus=0.1234567890123456789",
     "Body punch/Poisson's ratio=-3.3333333333333333e-5", "Body punch/Refine where=0.3-x^2-y^2",
     "Body punch/Local refinements=2", "Body foundation/Body force=0,0,-7.85e-5*max(x, y)",
     "Body foundation/Density=7.85e-9", "Gravity=0 0 -9810", "Body punch/Moment=top: 0 0.1 0",
     "Body punch/Displacement=top: z = -min(x, 0.1), top: x = 0", "Load cases=closing, opening",
     "Load case opening/Weight=0.3333333333333333",
     "Load case opening/Force=punch.top: 0 0 -1e3, punch.left: 1 2 3", "Optimization/Combine=worst",
     "Decomposition/Subdomains=7", "Solver/Relative tolerance=1e-9",
     "Solver/Report linear reference=true", "Shape/Initial=0.1,0.2,-0.1,0,0.01,0.02",
     "Element degree=2"});
  const scene::Scene again = read_with({}, printed(scene));
  EXPECT_EQ(printed(again), printed(scene));
  EXPECT_EQ(again.bodies[0].material.youngs_modulus, scene.bodies[0].material.youngs_modulus);
  EXPECT_EQ(again.bodies[0].material.poissons_ratio, scene.bodies[0].material.poissons_ratio);
  EXPECT_EQ(again.bodies[0].loads.traction, scene.bodies[0].loads.traction);
  EXPECT_EQ(again.bodies[0].mesh.curved_faces, scene.bodies[0].mesh.curved_faces);
  EXPECT_EQ(again.bodies[0].mesh.refine_where, "0.3-x^2-y^2");
  EXPECT_EQ(again.bodies[1].body_force, (std::vector<std::string>{"0", "0", "-7.85e-5*max(x, y)"}));
  EXPECT_EQ(again.gravity, (Numbers{0, 0, -9810}));
  EXPECT_EQ(again.bodies[0].loads.displacements.size(), 2U);
  EXPECT_EQ(again.bodies[0].loads.displacements, scene.bodies[0].loads.displacements);
  ASSERT_EQ(again.load_cases.size(), 2U);
  EXPECT_EQ(again.load_cases[1].weight, 0.3333333333333333);
  EXPECT_EQ(again.load_cases[1].loads.force, scene.load_cases[1].loads.force);
  ASSERT_EQ(again.contact.pairs.size(), scene.contact.pairs.size());
  EXPECT_EQ(again.contact.pairs[0].master, scene.contact.pairs[0].master);
  EXPECT_EQ(again.shapes[0].initial, scene.shapes[0].initial);
  EXPECT_EQ(again.state_tolerance, 1e-9);
  EXPECT_TRUE(again.report_linear_reference);
  EXPECT_EQ(again.tearing.subdomains, 7U);
  EXPECT_EQ(again.degree, 2U);
}

TEST(ReadScene, PairsTakeOverWhatContactSays)
{
  const std::string text  = R"(set Dimension = 2
set Bodies    = punch
set Obstacles = floor, ball
subsection Body punch
  set Box cells = 2, 2
end
subsection Pair punch.bottom: ball
  set Gap = 0.1 * x
end
subsection Contact
  set Pairs           = punch.bottom: floor, punch.bottom:ball
  set Search distance = 2
  set Gap             = 1
end
subsection Obstacle ball
  set Shape  = sphere
  set Point  = 1, 2
end
)";
  const auto        scene = read_with({"Contact/Interference=true"}, text);
  ASSERT_EQ(scene.contact.pairs.size(), 2U);
  const auto &floor = scene.contact.pairs[0].parameters;
  const auto &ball  = scene.contact.pairs[1].parameters;
  EXPECT_EQ(floor.gap, "1");
  EXPECT_EQ(ball.gap, "0.1 * x");
  EXPECT_EQ(ball.search_distance, 2.);
  EXPECT_TRUE(ball.interference);
  EXPECT_EQ(scene.obstacles[0].shape, "plane");
  EXPECT_EQ(scene.obstacles[0].normal, (std::vector<double>{0., 1.}));
  EXPECT_EQ(scene.obstacles[1].point, (std::vector<double>{1., 2.}));
  EXPECT_EQ(printed(read_with({}, printed(scene))), printed(scene));
}

TEST(PrintReference, HasOneRowForEachEntryOfAPrintedScene)
{
  std::ostringstream reference;
  scene::print_reference(reference);
  auto model = read_with({"Bodies=punch"}, "set Dimension = 2\n"
                                           "set Obstacles = floor\n"
                                           "set Load cases = heavy\n"
                                           "set Materials = steel\n"
                                           "set Responses = tip\n"
                                           "subsection Response tip\n"
                                           "set Quantity = volume\n"
                                           "end\n"
                                           "subsection Body punch\n"
                                           "set Box cells = 1, 1\n"
                                           "end\n"
                                           "subsection Contact\n"
                                           "set Pairs = punch.bottom: floor\n"
                                           "end\n");
  model.points.resize(1);
  model.bolts.resize(1);
  std::istringstream lines(printed(model));
  std::string        line;
  unsigned int       n_entries = 0;
  while (std::getline(lines, line))
    {
      const auto begin = line.find("set ");
      if (begin == std::string::npos)
        continue;
      std::string name = line.substr(begin + 4, line.find('=') - begin - 4);
      name.erase(name.find_last_not_of(' ') + 1);
      EXPECT_NE(reference.str().find("| `" + name + "` |"), std::string::npos) << name;
      ++n_entries;
    }
  const std::string text = reference.str();
  std::size_t       rows = 0;
  for (auto place = text.find("\n| `"); place != std::string::npos;
       place      = text.find("\n| `", place + 1))
    ++rows;
  EXPECT_EQ(rows, n_entries);
}

TEST(ReadText, GivesTheContentsOfAFile)
{
  const std::string file = ::testing::TempDir() + "snug-read-text.prm";
  std::ofstream(file) << "a\n\nb";
  EXPECT_EQ(scene::read_text(file), "a\n\nb");
  std::ofstream(file).close();
  EXPECT_EQ(scene::read_text(file), "");
  std::remove(file.c_str());
}

TEST(ReadText, TakesDevicesAndPipesOnlyIfAskedAndOnlyIfTheyEnd)
{
  using Source              = scene::TextSource;
  const auto failure_reason = [](const std::string &file, const Source source) -> std::string {
    try
      {
        scene::read_text(file, source);
        return "";
      }
    catch (const InputError &error)
      {
        return error.what();
      }
  };
  EXPECT_NE(failure_reason("/dev/zero", Source::regular_file).find("must be a regular file"),
            std::string::npos);
  EXPECT_NE(failure_reason("/dev/zero", Source::any).find("more than 16 MB"), std::string::npos);
  EXPECT_EQ(failure_reason("/dev/null", Source::any), "");
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  ASSERT_EQ(write(ends[1], "set Task = state", 16), 16);
  close(ends[1]);
  const auto file = "/dev/fd/" + std::to_string(ends[0]);
  EXPECT_NE(failure_reason(file, Source::regular_file), "");
  EXPECT_EQ(scene::read_text(file, Source::any), "set Task = state");
  close(ends[0]);
}

TEST(ReadText, NamesAFileThatCannotBeRead)
{
  for (const std::string file : {"nowhere/nothing.prm", "/"})
    try
      {
        scene::read_text(file);
        ADD_FAILURE() << file;
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("'" + file + "'"), std::string::npos);
      }
}
