#include "friction_cases.h"

#include <snug/base/errors.h>
#include <snug/qp/active_set.h>
#include <snug/qp/projected_gcr.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace snug::qp;

namespace {
SolverParameters to(const double tolerance)
{
  SolverParameters parameters;
  parameters.relative_tolerance = tolerance;
  return parameters;
}

/// Return @p n, or a few on several ranks, which show only that calls are collective.
unsigned int number_of_cases(const unsigned int n)
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks == 1 ? n : 4;
}

/// Contacts belong to one rank, which owns all rows of these small problems.
DualSolution solve(const DenseProblem &problem,
                   const double        tolerance,
                   const WarmStart    &start = {MultiVector(), {}})
{
  return ActiveSet(to(tolerance)).solve(problem, start);
}
} // namespace

TEST(Friction, AgreesWithGaussSeidelOnHeldBodies)
{
  for (const unsigned int n_tangents : {1u, 2u})
    for (unsigned int seed = 0; seed < number_of_cases(20); ++seed)
      {
        FrictionCase of;
        of.n_tangents           = n_tangents;
        of.floating             = false;
        of.coefficient          = 0.1 * (1 + seed % 5);
        of.shear                = 1.;
        of.seed                 = seed;
        of.bound                = seed % 4 == 3 ? 0.1 : 0.;
        const auto         data = friction_data(of);
        const DenseProblem problem(data, 1);
        const auto         solution = solve(problem, 1e-12);
        const auto         lambda   = problem.gather(solution.lambda);
        EXPECT_LT(friction_errors(data, lambda, solution.amplitudes).worst(), 1e-10) << seed;
        EXPECT_LT(dense::distance(gauss_seidel(data, 4000), lambda), 1e-8) << seed;
      }
}

TEST(Friction, SolvesOrRefusesRandomCases)
{
  unsigned int solved = 0, not_converged = 0;
  for (const unsigned int n_tangents : {1u, 2u})
    for (unsigned int seed = 0; seed < number_of_cases(300); ++seed)
      {
        FrictionCase of;
        of.n_tangents           = n_tangents;
        of.coefficient          = 0.1 + 0.05 * (seed % 19);
        of.shear                = 0.1 * (seed % 10);
        of.contrast             = seed % 3 == 0 ? 100. : 3.;
        of.seed                 = seed;
        const auto         data = friction_data(of);
        const DenseProblem problem(data, 1);
        try
          {
            const auto solution = solve(problem, 1e-10);
            const auto lambda   = problem.gather(solution.lambda);
            EXPECT_LT(friction_errors(data, lambda, solution.amplitudes).worst(), 1e-7)
              << n_tangents << " " << seed;
            ++solved;
          }
        catch (const snug::SolveError &error)
          {
            const std::string what = error.what();
            not_converged += what.find("slides") == std::string::npos &&
                             what.find("no equilibrium") == std::string::npos;
          }
      }
  const unsigned int n = 2 * number_of_cases(300);
  EXPECT_GT(solved, n / 2);
  EXPECT_LE(not_converged, 6u);
}

namespace {
/// Return sets on which all contacts slip along directions turned by @p angle, except that the
/// contacts before @p n_sticking stick.
FreeRows turned_slips(const DualProblem &problem, const double angle, const unsigned int n_sticking)
{
  RowSet            rows(problem.n_owned(), 1);
  std::vector<Slip> slips;
  unsigned int      contact = 0;
  for (const FrictionCone &cone : problem.cones())
    if (contact++ >= n_sticking)
      {
        const double a = angle + contact;
        for (const unsigned int t : cone.tangents)
          rows[t] = 0;
        slips.push_back({cone, {{std::cos(a), std::sin(a)}}, 0.3 + 0.1 * contact});
      }
  return {rows, slips};
}

/// Solve on @p free_set from zero with @p krylov. Return lambda and the iterations.
std::pair<MultiVector, unsigned int> solution_of(const DualProblem &problem, ProjectedGcr &krylov)
{
  MultiVector lambda(problem.n_owned()), residual = problem.d();
  const auto  result = krylov.solve(lambda, residual, {1e-11}, 1000);
  EXPECT_TRUE(result.converged);
  return {lambda, result.iterations};
}
} // namespace

TEST(Friction, DirectionsOfOtherSetsSaveFMults)
{
  unsigned int without = 0, with = 0;
  for (unsigned int seed = 0; seed < number_of_cases(20); ++seed)
    {
      FrictionCase of;
      of.floating = false;
      of.seed     = seed;
      const DenseProblem problem(friction_data(of), 1);
      const auto         first = problem.free_set(turned_slips(problem, 0., 0));
      const auto         next  = problem.free_set(turned_slips(problem, 0.02, 1));
      ProjectedGcr       on_first(problem, *first);
      solution_of(problem, on_first);
      ProjectedGcr anew(problem, *next), recalling(problem, *next, on_first.release_directions());
      const auto   expected = solution_of(problem, anew), found = solution_of(problem, recalling);
      auto         difference = found.first;
      difference.add(-1., expected.first);
      EXPECT_LT(norms(difference, MPI_COMM_WORLD)[0],
                1e-8 * (1. + norms(expected.first, MPI_COMM_WORLD)[0]));
      without += expected.second;
      with += found.second;
    }
  EXPECT_LT(with, 0.7 * without);
}
