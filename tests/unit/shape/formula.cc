#include <cmath>

#include "bodies.h"

namespace snug {
namespace {
using namespace test;

TEST(FormulaModes, AreTheirFormulasOnTheBodiesNamed)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, shape_bodies<2>(), 2);
  auto                    parameters = formulas<2>();
  parameters.bodies                  = {"foundation"};
  const shape::Shapes<2> shapes(mesh, body_names(), {parameters});
  ASSERT_EQ(shapes.n_variables(), 3u);
  const auto moved = shapes.apply({2., 3., 5.});
  for (unsigned int node = 0; node < moved.size(); ++node)
    {
      if (mesh.is_hanging(node))
        continue;
      dealii::Tensor<1, 2> expected;
      const auto          &x = mesh.reference_positions()[node];
      if (mesh.body_of_node(node) == 1)
        {
          expected[0] = 2. * x[0] + 3. * std::max(x[0], x[1]);
          expected[1] = 2. * x[1] + 5. * x[0] * x[1];
        }
      EXPECT_NEAR((moved[node] - expected).norm(), 0., 1e-14);
    }
  EXPECT_EQ(shapes.faces().size(), 4u);
  EXPECT_TRUE(shapes.control_points({0., 0., 0.}).empty());
}

TEST(FormulaModes, OnAFaceAreCarriedInward)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, shape_bodies<2>(), 1);
  auto                    parameters = formulas<2>();
  parameters.face                    = "punch.top"; // y = 6
  parameters.modes                   = {{"0", "y*x^2"}};
  const shape::Shapes<2> shapes(mesh, body_names(), {parameters});
  const auto             moved = shapes.apply({1.});
  for (unsigned int node = 0; node < moved.size(); ++node)
    if (mesh.body_of_node(node) == 0)
      {
        const auto &x = mesh.reference_positions()[node];
        EXPECT_NEAR(moved[node][1], 6. * x[0] * x[0] * (x[1] - 5.), 1e-13);
      }
}

/// Ranks without samples must fail, too.
TEST(FormulaModes, AreFiniteAtSamplesOfAllRanks)
{
  auto bodies                  = plain_cube<2>(4);
  bodies[0].sampled_boundaries = {"top"};
  bodies[0].is_designed        = true;
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, bodies, 1);
  auto                    parameters = formulas<2>();
  parameters.face                    = "cube.top";
  parameters.modes                   = {{"0", "sqrt(0.1-abs(sin(4*_pi*x)))"}}; // finite at nodes
  EXPECT_THROW(shape::Shapes<2>(mesh, {{"cube"}}, {parameters}), InputError);
}

TEST(FormulaModes, RejectWhatIsNoField)
{
  const auto with = [](const std::string &a, const std::string &b) {
    auto parameters  = formulas<2>();
    parameters.modes = {{a, b}};
    return parameters;
  };
  EXPECT_EQ(failure_reason<2>(formulas<2>()), "");
  expect_complaint<2>(with("x+(", "0"), "Modes", "formula");
  expect_complaint<2>(with("1/(x-5.5)", "0"), "Modes", "finite");
  auto bad  = formulas<2>();
  bad.modes = {{"x"}};
  expect_complaint<2>(bad, "Modes", "2 formulas");
  bad.modes = {};
  expect_complaint<2>(bad, "Modes", "at least one");
  bad       = formulas<2>();
  bad.fixed = {"border"};
  expect_complaint<2>(bad, "Fixed", "no control points");
  bad          = formulas<2>();
  bad.symmetry = {{"x", 0.}};
  expect_complaint<2>(bad, "Symmetry", "no control points");
}
} // namespace
} // namespace snug
