#ifndef snug_tests_qp_active_set_checks_h
#define snug_tests_qp_active_set_checks_h

#include "dense_problem.h"

#include <snug/qp/active_set.h>

#include <gtest/gtest.h>

inline snug::qp::SolverParameters with_tolerance(double tolerance)
{
  snug::qp::SolverParameters parameters;
  parameters.relative_tolerance = tolerance;
  return parameters;
}

inline snug::qp::DualSolution solve_cold(const DenseProblem &problem, double tolerance)
{
  return snug::qp::ActiveSet(with_tolerance(tolerance)).solve(problem, snug::qp::WarmStart());
}

inline void expect_certified(const DenseProblem           &problem,
                             const snug::qp::DualSolution &solution,
                             double                        tolerance)
{
  EXPECT_LE(solution.kkt_residual, tolerance);
  const auto lambda = problem.gather(solution.lambda);
  const auto active = problem.gather(solution.active);
  for (unsigned int i = 0; i < lambda.n_rows(); ++i)
    if (problem.data.bounded[i])
      {
        EXPECT_GE(lambda(i), 0.);
        EXPECT_EQ(bool(active[i]), lambda(i) > 0.);
      }
    else
      {
        EXPECT_TRUE(active[i]);
      }
  auto residual = problem.data.d;
  residual.add(-1., dense::product(problem.data.F, lambda));
  EXPECT_LT(dense::distance(residual, problem.gather(solution.residual)),
            1e-13 * (1. + dense::largest(problem.data.d)));
  EXPECT_EQ(solution.f_mults, problem.context().work.f_mults);
}

#endif
