#include <snug/base/assertions.h>
#include <snug/base/errors.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

/// Subdomains of a body, and those with unknowns that no row holds (which
/// the Dirichlet preconditioner factorizes), over all ranks.
template <int dim>
unsigned int count_subdomains(const Problem<dim> &problem, unsigned int body)
{
  unsigned int n = 0;
  for (const auto &subdomain : problem.tearing.subdomains)
    n += subdomain.body == body;
  return dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD);
}

TEST(Work, UnmovedBodiesAreLeftAlone)
{
  auto scene                = two_blocks<3>(4, 4, 3.);
  scene.feti.preconditioner = feti::Preconditioner::lumped; // one factorization per subdomain
  scene.feti.soft_modes     = feti::SoftModesOf::none; // they are found where contact is paired
  set_design(scene, 3, 0.02);
  Problem<3>         problem(scene);
  const unsigned int n     = problem.tearing.n_global;
  const auto         first = problem.solve();
  auto               work  = problem.context.total_work();
  EXPECT_EQ(work.assembled_subdomains, n);
  EXPECT_EQ(work.numeric_factorizations, n);
  EXPECT_EQ(work.symbolic_factorizations, n);

  scene.design[4] += 0.01;
  problem.solve(scene.design);
  work                     = problem.context.total_work();
  const unsigned int moved = count_subdomains(problem, 1);
  EXPECT_GT(moved, 1u);
  EXPECT_LT(moved, n);
  EXPECT_EQ(work.assembled_subdomains, n + moved);
  EXPECT_EQ(work.numeric_factorizations, n + moved);
  EXPECT_EQ(work.symbolic_factorizations, n);

  problem.solve(scene.design);
  work = problem.context.total_work();
  EXPECT_EQ(work.assembled_subdomains, n + moved);
  EXPECT_EQ(work.numeric_factorizations, n + moved);

  // and the first design gives the first answer
  const auto again = problem.solve();
  EXPECT_EQ(first.energy, again.energy);
}

TEST(Work, WarmStartCostsLessThanCold)
{
  auto scene = two_blocks<3>(4, 4, 3.);
  set_design(scene, 3, 0.02);
  scene.solver.relative_tolerance = 1e-6;
  Problem<3>    problem(scene);
  const auto    cold = problem.solve();
  qp::WarmStart start{cold.dual.lambda, cold.dual.active};
  scene.design[4] += 0.0004; // 1 % of the bounds' width
  const auto x    = problem.positions(scene.design);
  const auto warm = problem.solver.solve(x, start);
  const auto same = problem.solver.solve(x, qp::WarmStart());
  EXPECT_LT(warm.f_mults, same.f_mults);
  EXPECT_LT(relative_difference(warm.energy, same.energy), 1e-8);
}

TEST(Work, LinearReferenceCountsItsOwnMults)
{
  auto                scene = two_blocks<3>(4, 4, 3.);
  Problem<3>          problem(scene);
  const auto          state  = problem.solve();
  const unsigned long before = problem.context.work.f_mults;
  const unsigned long linear = problem.solver.linear_f_mults(state);
  EXPECT_EQ(problem.context.work.f_mults - before, linear);
  EXPECT_GT(linear, 0u);
  EXPECT_LT(linear, state.f_mults);
}

/// The data of a state are evaluated at its geometry and in its load case, independently of later
/// states of the solver.
TEST(Work, AStateIsFoundAgainAfterAnother)
{
  auto scene = two_blocks<3>(4, 4, 3.);
  set_design(scene, 3, 0.02);
  Problem<3> problem(scene);
  const auto state  = problem.solve();
  const auto linear = problem.solver.linear_f_mults(state);
  const auto d      = problem.solver.feti(state).d();
  auto       design = scene.design;
  for (double &height : design)
    height -= 0.2; // another contact zone
  const auto other = problem.solve(design);
  EXPECT_NE(other.energy, state.energy);
  // Each rank compares the nodes of its own subdomains.
  bool refused = false;
  try
    {
      problem.solver.feti(state);
    }
  catch (const InternalError &)
    {
      refused = true;
    }
  EXPECT_TRUE(dealii::Utilities::MPI::logical_or(refused, MPI_COMM_WORLD));
  problem.solver.restore(state);
  EXPECT_EQ(problem.solver.linear_f_mults(state), linear);
  const auto &again = problem.solver.feti(state).d();
  for (unsigned int i = 0; i < d.n_rows(); ++i)
    ASSERT_EQ(d(i), again(i));
}

/// A geometry that is not taken changes nothing, though its first
/// subdomains were looked at.
TEST(Work, ATangledMeshLeavesTheScaledJacobiansOfTheLastGeometry)
{
  const auto   scene = two_blocks<2>(4, 4, 3.);
  Problem<2>   problem(scene);
  const auto   x        = problem.positions(scene.design);
  const double expected = problem.solver.solve(x, qp::WarmStart()).least_scaled_jacobian;
  // sheared in the first body, folded in the last one
  auto tangled = x;
  for (unsigned int node = 0; node < x.size(); ++node)
    if (problem.mesh.body_of_node(node) == 0)
      tangled[node][0] += 2. * x[node][1];
    else
      tangled[node] *= -1. + 2. * x[node][0];
  EXPECT_THROW(problem.solver.solve(tangled, qp::WarmStart()), TangledMesh);
  EXPECT_EQ(problem.solver.solve(x, qp::WarmStart()).least_scaled_jacobian, expected);
}
} // namespace
