#include <snug/advice/cost.h>
#include <snug/mesh/tearing.h>
#include <snug/scene/read_scene.h>

#include <gtest/gtest.h>

#include <sstream>

namespace snug::test {
namespace {
const std::string text = R"(
set Dimension = 3
set Bodies = upper, lower
subsection Body upper
  set Mesh = sphere
  set Cells = 2
  set Part = half
  set Rotate = x: 180
  set Young's modulus = 1
end
subsection Body lower
  set Box cells = 4, 3, 2
  set Young's modulus = 1
end
subsection Contact
  set Pairs = upper.outer: lower.top
end
)";

scene::Scene read(const std::vector<std::string> &sets, const std::string &of = text)
{
  return scene::read_scene({"scene.prm", of, sets, ""});
}

/// Return the counts of the mesh of a scene.
template <int dim>
advice::Counts made(const scene::Scene &scene)
{
  std::vector<geometry::BodyMeshParameters> bodies;
  for (const auto &body : scene.bodies)
    bodies.push_back(body.mesh);
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, bodies, scene.degree, scene::idealization(scene),
                                 scene.tearing);
  advice::Counts            result;
  result.cells      = mesh.n_global_cells();
  result.nodes      = mesh.n_global_free_nodes();
  result.subdomains = mesh::tear(mesh).n_global;
  return result;
}

template <int dim>
void expect_counted(const scene::Scene &scene, const double tolerance)
{
  const auto expected = made<dim>(scene), found = advice::count(scene, 1);
  EXPECT_NEAR(found.cells / expected.cells, 1., tolerance);
  EXPECT_NEAR(found.nodes / expected.nodes, 1., tolerance);
}

/// Two squares, one of them refined around a corner.
const std::string refined = R"(
set Dimension = 2
set Bodies = upper, lower
subsection Body upper
  set Box corner = 0, 1
  set Box cells = 4, 4
  set Young's modulus = 1
end
subsection Body lower
  set Box cells = 8, 8
  set Young's modulus = 1
  set Refine where = 0.4 - sqrt(x^2 + (y - 1)^2)
  set Local refinements = 4
end
subsection Contact
  set Pairs = upper.bottom: lower.top
end
)";
} // namespace

TEST(Count, IsThatOfEvenMeshes)
{
  expect_counted<3>(read({}), 1e-12);
  expect_counted<3>(read({"Element degree=2"}), 1e-12);
  expect_counted<3>(read({"Body upper/Refinements=1", "Body lower/Refinements=2"}), 1e-12);
}

TEST(Count, IsNearlyThatOfMeshesRefinedLocally)
{
  expect_counted<2>(read({}, refined), 0.05);
  expect_counted<2>(read({"Body lower/Refinements=2", "Body lower/Local refinements=2"}, refined),
                    0.05);
}

TEST(Count, TakesTheNodesOfTheFinerSide)
{
  EXPECT_EQ(advice::count(read({"Body lower/Box cells=9, 8, 1"}), 1).contact_rows, 90);
  EXPECT_EQ(
    advice::count(read({"Body lower/Box cells=9, 8, 1", "Element degree=2"}), 1).contact_rows,
    19 * 17);
  EXPECT_LT(advice::count(read({"Contact/Slave=first"}), 1).contact_rows, 60);
}

TEST(Count, HasAsManySubdomainsAsAreWantedOrRanks)
{
  const auto scene = read({"Body lower/Box cells=10, 10, 10", "Decomposition/Subdomains=12"});
  EXPECT_NEAR(advice::count(scene, 1).subdomains, 12., 1.);
  EXPECT_GE(advice::count(scene, 40).subdomains, 40.);
}

TEST(Cost, IsSharedByRanksButForWhatEachHas)
{
  const auto scene = read({"Body lower/Box cells=20, 20, 20"});
  const auto one = advice::estimate_cost(scene, 1, 1.), four = advice::estimate_cost(scene, 4, 1.);
  EXPECT_EQ(one.memory_total, one.memory_largest);
  EXPECT_LT(four.memory_largest, one.memory_largest);
  EXPECT_GT(four.memory_total, one.memory_total);
  EXPECT_NEAR(four.setup, one.setup / 4., 1e-12);
  EXPECT_EQ(four.start, one.start);
}

TEST(Cost, FallsWithTheSpeedOfTheMachine)
{
  const auto scene = read({});
  EXPECT_NEAR(advice::estimate_cost(scene, 1, 2.).total,
              advice::estimate_cost(scene, 1, 1.).total / 2., 1e-12);
  const double speed = advice::machine_speed();
  EXPECT_GT(speed, 1e-3); // instrumented programs are slow
  EXPECT_LT(speed, 50.);
}

TEST(Cost, OfOptimizationsIsThatOfTheirDesigns)
{
  const std::vector<std::string> shaped   = {"Task=optimize",
                                             "Shape/Basis=Bezier patch",
                                             "Shape/Face=lower.top",
                                             "Shape/Control points=3, 3",
                                             "Shape/Bounds=-0.1, 0.1",
                                             "Optimization/Maximum evaluations=7"};
  auto                           stressed = shaped;
  stressed.insert(stressed.end(), {"Responses=s", "Response s/Quantity=von Mises norm",
                                   "Optimization/Objective=s"});
  const auto energy = advice::estimate_cost(read(shaped), 1, 1.),
             stress = advice::estimate_cost(read(stressed), 1, 1.);
  EXPECT_EQ(energy.n_designs, 7u);
  EXPECT_NEAR(energy.total - energy.start - energy.setup - energy.accuracy - energy.output,
              7. * energy.design, 1e-10);
  EXPECT_GT(stress.gradient, 5. * energy.gradient); // takes a solve
  std::ostringstream said;
  advice::print(energy, false, said);
  EXPECT_NE(said.str().find("for at most 7 designs"), std::string::npos) << said.str();
}
} // namespace snug::test
