#include <snug/advice/cost.h>
#include <snug/mesh/surface.h>
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

template <int dim>
mesh::BodyMesh<dim> make_mesh(const scene::Scene &scene)
{
  std::vector<geometry::BodyMeshParameters> bodies;
  for (const auto &body : scene.bodies)
    bodies.push_back(body.mesh);
  return mesh::BodyMesh<dim>(MPI_COMM_WORLD, bodies, scene.degree, scene::idealization(scene),
                             scene.tearing);
}

template <int dim = 3>
advice::Counts count(const scene::Scene &scene)
{
  return advice::count(scene, make_mesh<dim>(scene));
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

TEST(Count, ContactRowsAreNodesOfTheFinerSide)
{
  EXPECT_EQ(count(read({"Body lower/Box cells=9, 8, 1"})).contact_rows, 90);
  EXPECT_EQ(count(read({"Body lower/Box cells=9, 8, 1", "Element degree=2"})).contact_rows,
            19 * 17);
  EXPECT_LT(count(read({"Contact/Slave=first"})).contact_rows, 60);
  const auto             scene = read({}, refined);
  const auto             mesh  = make_mesh<2>(scene);
  const mesh::Surface<2> top(mesh, {{1, geometry::boundary_index(mesh.geometry(1), "top")}});
  EXPECT_EQ(advice::count(scene, mesh).contact_rows, top.n_nodes());
}

TEST(Count, SubdomainsAreThoseOfTheTearing)
{
  for (const char *number : {"Decomposition/Subdomains=12", "Decomposition/Subdomains=auto"})
    {
      const auto scene = read({"Body lower/Box cells=10, 10, 10", number});
      const auto mesh  = make_mesh<3>(scene);
      EXPECT_EQ(advice::count(scene, mesh).subdomains, mesh::tear(mesh).n_global);
    }
}

TEST(Count, SubdomainsBySizeAreThoseOfAuto)
{
  const std::string cells = "Body lower/Box cells=20, 20, 20";
  const auto        given = count(read({cells, "Decomposition/Subdomains=500"})),
             by_auto      = count(read({cells}));
  EXPECT_GT(given.subdomains, 400.);
  EXPECT_NEAR(given.subdomains_by_size, by_auto.subdomains, 0.1 * by_auto.subdomains);
  EXPECT_FALSE(given.has_layers); // of the sphere
  EXPECT_FALSE(count<2>(read({}, refined)).has_layers);
  EXPECT_TRUE(count<2>(read({"Body lower/Local refinements=0"}, refined)).has_layers);
}

TEST(Cost, HasAsManySubdomainsAsRanks)
{
  const auto scene  = read({"Decomposition/Subdomains=12"});
  const auto counts = count(scene);
  EXPECT_LT(counts.subdomains, 40.);
  EXPECT_GE(advice::estimate_cost(scene, counts, 40, 1.).counts.subdomains, 40.);
}

TEST(Cost, IsSharedByRanksButForWhatEachHas)
{
  const auto scene  = read({"Body lower/Box cells=20, 20, 20"});
  const auto counts = count(scene);
  const auto one    = advice::estimate_cost(scene, counts, 1, 1.),
             four   = advice::estimate_cost(scene, counts, 4, 1.);
  EXPECT_EQ(one.memory_total, one.memory_largest);
  EXPECT_LT(four.memory_largest, one.memory_largest);
  EXPECT_GT(four.memory_total, one.memory_total);
  EXPECT_NEAR(four.setup, one.setup / 4., 1e-12);
  EXPECT_EQ(four.start, one.start);
}

TEST(Cost, FallsWithTheSpeedOfTheMachine)
{
  const auto scene  = read({});
  const auto counts = count(scene);
  EXPECT_NEAR(advice::estimate_cost(scene, counts, 1, 2.).total,
              advice::estimate_cost(scene, counts, 1, 1.).total / 2., 1e-12);
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
  const auto counts = count(read(shaped));
  const auto energy = advice::estimate_cost(read(shaped), counts, 1, 1.),
             stress = advice::estimate_cost(read(stressed), counts, 1, 1.);
  EXPECT_EQ(energy.n_designs, 7u);
  EXPECT_NEAR(energy.total - energy.start - energy.setup - energy.accuracy - energy.output,
              7. * energy.design, 1e-10);
  EXPECT_GT(stress.gradient, 5. * energy.gradient); // takes a solve
  std::ostringstream said;
  advice::print(energy, false, said);
  EXPECT_NE(said.str().find("for at most 7 designs"), std::string::npos) << said.str();
}
} // namespace snug::test
