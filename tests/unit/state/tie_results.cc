#include <snug/elasticity/linear_traction.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

/// The punch hangs on the foundation by a tied pair of its bottom alone.
template <int dim>
TestScene<dim> tied_blocks(const unsigned int n, const unsigned int m, const unsigned int degree)
{
  auto scene                      = two_blocks<dim>(n, m, 0.);
  scene.degree                    = degree;
  scene.solver.relative_tolerance = 1e-12;
  scene.bodies[0].supports.clear();
  scene.bodies[0].loads.clear();
  scene.pairs                     = {{{0, face_index(dim - 1, 0)}, {1, face_index(dim - 1, 1)}}};
  scene.pairs[0].parameters.law   = contact::Law::tied;
  scene.pairs[0].parameters.slave = contact::Slave::first;
  return scene;
}

/// Check force and moment of a tied pair by the equilibrium of the punch, a cantilever with the
/// load (3, 1, -2) at the centre of its top.
template <int dim>
void expect_equilibrium(const TestScene<dim> &of)
{
  auto                   scene   = of;
  const double           loads[] = {3., 1., -2.};
  dealii::Tensor<1, dim> load;
  for (unsigned int d = 0; d < dim; ++d)
    load[d] = loads[d];
  scene.bodies[0].loads[face_index(dim - 1, 1)].traction = load;
  Problem<dim>           problem(scene);
  const auto             state = problem.solve();
  dealii::Tensor<1, dim> top;
  for (unsigned int d = 0; d < dim; ++d)
    top[d] = scene.bodies[0].corner[d] + (d + 1 < dim ? 0.5 : 1.);
  ASSERT_EQ(state.ties.size(), 1u);
  const auto &tie    = state.ties[0];
  const auto  moment = elasticity::moment_of(top - tie.centre, load);
  // The tolerance of the solution is 1e-12 of the forces between subdomains, which are larger.
  EXPECT_LT((tie.force + load).norm(), 1e-9 * load.norm());
  EXPECT_LT((tie.moment + moment).norm(), 1e-9 * moment.norm());
  EXPECT_NEAR(tie.area, 1., 1e-10);
  EXPECT_TRUE(state.contact.empty());
}

TEST(TieResults, ForceAndMomentAreInEquilibriumWithTheLoad)
{
  for (const unsigned int degree : {1, 2})
    for (const unsigned int m : {3, 4})
      {
        expect_equilibrium(tied_blocks<2>(3, m, degree));
        // Couples transmit the moment of the shear force over a gap.
        auto apart = tied_blocks<2>(3, m, degree);
        apart.bodies[0].corner[1] += 0.1;
        expect_equilibrium(apart);
      }
  for (const auto &[m, degree] : {std::pair(2u, 1u), {3u, 1u}, {3u, 2u}})
    {
      auto apart = tied_blocks<3>(2, m, degree);
      apart.bodies[0].corner[2] += 0.1;
      expect_equilibrium(apart);
    }
}

/// Check that a uniform tension passes a tied pair.
template <int dim>
void expect_uniform_tension(TestScene<dim> scene)
{
  for (auto &body : scene.bodies)
    body.material.poissons_ratio = 0.;
  scene.bodies[0].loads[face_index(dim - 1, 1)].pressure = -10.;
  Problem<dim> problem(scene);
  const auto   state = problem.solve();
  for (const auto &point : state.tied)
    {
      EXPECT_NEAR(point.pressure, -10., 1e-9) << dim << ' ' << scene.degree;
      EXPECT_LT(point.traction.norm(), 1e-9) << dim << ' ' << scene.degree;
    }
  EXPECT_NEAR(state.ties.at(0).max_tension, 10., 1e-9);
  EXPECT_EQ(state.ties.at(0).nodes, state.tied.size());
}

TEST(TieResults, UniformTensionPassesUnlikeMeshes)
{
  for (const unsigned int degree : {1, 2})
    {
      auto scene                    = tied_blocks<2>(3, 4, degree);
      scene.bodies[0].refined_below = 0.4; // with hanging nodes
      expect_uniform_tension(scene);
      expect_uniform_tension(tied_blocks<3>(2, 3, degree));
    }
}
} // namespace
