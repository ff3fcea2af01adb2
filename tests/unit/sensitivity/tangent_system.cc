#include <snug/sensitivity/data_derivatives.h>
#include <snug/sensitivity/tangent_system.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unit/sensitivity/velocities.h>

namespace {
using namespace snug;
using namespace snug::test;

/// Largest |x| over subdomains and ranks.
double largest(const feti::PrimalVectors &x)
{
  double result = 0.;
  for (const auto &part : x)
    for (unsigned int j = 0; j < part.n_columns(); ++j)
      for (unsigned int i = 0; i < part.n_rows(); ++i)
        result = std::max(result, std::abs(part(i, j)));
  return dealii::Utilities::MPI::max(result, MPI_COMM_WORLD);
}

/// The optimality conditions of the sensitivity problem:
/// K u' + B' lambda' = ft, B_E u' = ct_E, B_s u' = ct_s, lambda'_i = 0 else.
template <int dim>
void expect_optimal(const TestScene<dim> &scene, sensitivity::Solves solves)
{
  Problem<dim> problem(scene);
  const auto   state = problem.solve();
  const auto  &feti  = problem.solver.feti(state);
  const auto   V     = column_velocities(problem);
  const auto   data =
    sensitivity::data_derivatives(problem.solver, state, V, sensitivity::GradientParameters());
  const sensitivity::TangentSystem system(feti, sensitivity::strong_rows(problem.solver, state),
                                          problem.model.solver, solves, state.dual.directions);
  const auto                       derivatives = system.solve(data);

  auto residual = feti.linearization().multiply_Bt(derivatives.dual);
  for (unsigned int s = 0; s < residual.size(); ++s)
    {
      feti.linearization().subdomains()[s].K.multiply_add(1., derivatives.primal[s], residual[s]);
      residual[s].add(-1., data.primal[s]);
    }
  EXPECT_LT(largest(residual), 1e-8 * largest(data.primal));

  auto gaps = feti.linearization().multiply_B(derivatives.primal);
  gaps.add(-1., data.dual);
  const auto &of_contact = problem.solver.gluing(0).contact_of_row();
  double      error      = 0.;
  for (unsigned int j = 0; j < V.size(); ++j)
    for (unsigned int i = 0; i < gaps.n_rows(); ++i)
      if (!feti.bounded()[i] || state.contact[of_contact[i]].strong)
        error = std::max(error, std::abs(gaps(i, j)));
      else
        EXPECT_EQ(derivatives.dual(i, j), 0.);
  error = dealii::Utilities::MPI::max(error, MPI_COMM_WORLD);
  EXPECT_LT(error, 1e-8 * largest(derivatives.primal));
}

TEST(TangentSystem, SolvesItsProblem2D)
{
  auto scene = two_blocks<2>(6, 7, 3.);
  set_design(scene, 4, 0.04);
  narrow_punch(scene);
  scene.bodies[1].refined_below = 0.45;
  expect_optimal(scene, sensitivity::Solves::block);
  expect_optimal(scene, sensitivity::Solves::recycled);
}

TEST(TangentSystem, SolvesItsProblemQuadratic2D)
{
  auto scene   = two_blocks<2>(3, 3, 3.);
  scene.degree = 2;
  set_design(scene, 4, 0.04);
  expect_optimal(scene, sensitivity::Solves::block);
}

TEST(TangentSystem, SolvesItsProblem3D)
{
  auto scene = two_blocks<3>(4, 3, 3.);
  set_design(scene, 3, 0.04);
  scene.bodies[1].refined_below = 0.45;
  expect_optimal(scene, sensitivity::Solves::block);
}

TEST(TangentSystem, SolvesItsProblemOnClusters)
{
  auto flat = two_blocks<2>(6, 7, 3.);
  set_design(flat, 4, 0.04);
  auto solid = two_blocks<3>(6, 6, 3.);
  set_design(solid, 3, 0.04);
  flat.subdomains = solid.subdomains = 24;
  flat.cluster_edge = solid.cluster_edge = 2;
  expect_optimal(flat, sensitivity::Solves::recycled);
  expect_optimal(solid, sensitivity::Solves::block);
}

TEST(TangentSystem, ColumnsDoNotDependOnTheirCompany)
{
  auto scene = two_blocks<3>(3, 4, 3.);
  set_design(scene, 3, 0.03);
  Problem<3> problem(scene);
  const auto state = problem.solve();
  const auto rows  = sensitivity::strong_rows(problem.solver, state);
  const auto data = sensitivity::data_derivatives(problem.solver, state, column_velocities(problem),
                                                  sensitivity::GradientParameters());
  for (const auto solves : {sensitivity::Solves::block, sensitivity::Solves::recycled})
    {
      const sensitivity::TangentSystem system(problem.solver.feti(state), rows,
                                              problem.model.solver, solves, state.dual.directions);
      const auto                       all = system.solve(data);
      for (const unsigned int j : {0, 5})
        {
          sensitivity::KktVectors one;
          one.primal         = data.primal.columns_from(j, 1);
          one.dual           = data.dual.columns_from(j, 1);
          auto         error = system.solve(one).primal;
          const double size  = largest(error);
          error.add(-1., all.primal.columns_from(j, 1));
          EXPECT_LT(largest(error), 1e-8 * size);
        }
    }
}
} // namespace
