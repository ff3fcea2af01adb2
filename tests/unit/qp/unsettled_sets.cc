#include "active_set_checks.h"

#include <snug/qp/smalse.h>

#include <gtest/gtest.h>

using namespace snug::qp;

namespace {
/// Contacts for which the plain active set method visits sets in turn, 3, 4
/// and 5 of them (found by searching random positive definite matrices).
struct Cycle
{
  std::vector<std::vector<double>> F;
  std::vector<double>              d;
};

const std::vector<Cycle> &cycles()
{
  static const std::vector<Cycle> cycles = {
    {{{10, -16, -13}, {-16, 36, 36}, {-13, 36, 41}}, {-2, 3, 1}},
    {{{13, -8, 6, -16}, {-8, 33, 28, -11}, {6, 28, 41, -35}, {-16, -11, -35, 42}}, {4, -2, 1, -2}},
    {{{13, 3, -4, -16, -12},
      {3, 24, -5, -8, 7},
      {-4, -5, 24, -1, -6},
      {-16, -8, -1, 23, 17},
      {-12, 7, -6, 17, 24}},
     {3, -4, -1, -2, -2}}};
  return cycles;
}

/// The first @p n_cycles side by side.
DenseData cycling_data(unsigned int n_cycles = 1)
{
  unsigned int n = 0;
  for (unsigned int k = 0; k < n_cycles; ++k)
    n += cycles()[k].d.size();
  DenseData data;
  data.F = dense::Matrix(n, n);
  data.d = dense::Matrix(n);
  data.G = dense::Matrix(0, n);
  data.e = dense::Matrix(0);
  data.bounded.assign(n, 1);
  unsigned int first = 0;
  for (unsigned int k = 0; k < n_cycles; ++k)
    {
      const Cycle &cycle = cycles()[k];
      for (unsigned int i = 0; i < cycle.d.size(); ++i)
        {
          data.d(first + i) = cycle.d[i];
          for (unsigned int j = 0; j < cycle.d.size(); ++j)
            data.F(first + i, first + j) = cycle.F[i][j];
        }
      first += cycle.d.size();
    }
  return data;
}
} // namespace

TEST(ActiveSet, LeavesACycleBySingleSteps)
{
  SetRules options;
  options.forcing = 1e-3; // exact solves cycle
  const DenseProblem problem(cycling_data());
  const auto solution = ActiveSet(with_tolerance(1e-10), options).solve(problem, WarmStart());
  expect_certified(problem, solution, 1e-10);
  EXPECT_EQ(solution.method, "active set");
  EXPECT_GT(solution.outer_iterations, 9u); // three rounds of three sets
}

TEST(ActiveSet, FallsBackToSmalse)
{
  SetRules options;
  options.forcing      = 1e-3;
  options.single_steps = 0;
  const DenseProblem problem(cycling_data());
  const auto solution = ActiveSet(with_tolerance(1e-10), options).solve(problem, WarmStart());
  expect_certified(problem, solution, 1e-10);
  EXPECT_EQ(solution.method, "SMALSE-M");
  EXPECT_EQ(problem.log.str().find("SMALSE-M") != std::string::npos, problem.context().rank() == 0);
  const DenseProblem other(cycling_data());
  EXPECT_LT(dense::distance(problem.gather(solution.lambda),
                            other.gather(solve_cold(other, 1e-10).lambda)),
            1e-8);
}

TEST(ActiveSet, LeavesSmalseEnoughOfTheFMults)
{
  SetRules options;
  options.forcing      = 1e-3;
  options.single_steps = 1000;
  auto parameters      = with_tolerance(1e-10);
  // Three rounds of the cycle take more than a quarter of them.
  parameters.max_iterations = 60;
  const DenseProblem problem(cycling_data());
  const auto         solution = ActiveSet(parameters, options).solve(problem, WarmStart());
  expect_certified(problem, solution, 1e-10);
  EXPECT_EQ(solution.method, "SMALSE-M");
  EXPECT_EQ(problem.log.str().find("active set method: cycles after") != std::string::npos,
            problem.context().rank() == 0);
}

TEST(ActiveSet, FallsBackWhereItMakesNoProgress)
{
  // no set is met again within 60 steps
  SetRules options;
  options.forcing = 1e-6;
  const DenseProblem problem(cycling_data(3));
  const auto solution = ActiveSet(with_tolerance(1e-10), options).solve(problem, WarmStart());
  expect_certified(problem, solution, 1e-10);
  EXPECT_EQ(solution.method, "SMALSE-M");
  EXPECT_GT(solution.outer_iterations, options.patience);
  EXPECT_LT(solution.outer_iterations, 60u);
  EXPECT_EQ(problem.log.str().find("active set method: stalls (minimum KKT residual") !=
              std::string::npos,
            problem.context().rank() == 0);
  const DenseProblem other(cycling_data(3));
  const auto         known = Smalse(with_tolerance(1e-12)).solve(other, WarmStart());
  EXPECT_LT(dense::distance(problem.gather(solution.lambda), other.gather(known.lambda)), 1e-8);
}
