#include <snug/optimization/dense_vectors.h>
#include <snug/optimization/step_model.h>

#include <gtest/gtest.h>

#include "problems.h"

using namespace snug::optimization;

namespace {
using Vector = std::vector<double>;

/// min -x + y between -10 and 10, with x + y = @p total and x - 2y <= @p limit; lengths are 1.
DesignProblem linear(const double total, const double limit)
{
  DesignProblem problem;
  problem.lower             = {-10., -10.};
  problem.upper             = {10., 10.};
  problem.start             = {0., 0.};
  problem.lengths           = {1., 1.};
  problem.relations         = {Relation::equal, Relation::at_most};
  problem.constraint_scales = {1., 1.};
  problem.evaluate          = [=](const Vector &x) {
    Evaluation value;
    value.objective   = x[1] - x[0];
    value.gradient    = {-1., 1.};
    value.constraints = {x[0] + x[1] - total, x[0] - 2. * x[1] - limit};
    value.jacobian    = {{1., 1.}, {1., -2.}};
    return value;
  };
  return problem;
}
} // namespace

// y + B y = t of the knapsack: the model is exact and the step is the solution.
TEST(StepModel, FindsTheLeastOfAQuadraticWithAnEqualityAndBounds)
{
  for (const unsigned int n : {1, 2, 9, 40})
    {
      const Knapsack knapsack(n);
      const auto     design_problem = knapsack.problem();
      ScaledProblem  problem(design_problem); // lengths 0.1
      const auto    &start = *problem.start();
      SecantHessian  hessian(n, n);
      for (unsigned int i = 0; i < n; ++i)
        {
          Vector axis(n, 0.);
          axis[i] = 1.;
          hessian.raise(axis, 0.01 * knapsack.d[i] / problem.objective_scale());
        }
      const StepModel model(problem, start, hessian);
      const auto      d = model.minimizer(100.);
      Vector          x;
      for (const double entry : d)
        x.push_back(0.5 + 0.1 * entry);
      // NLopt ends where its objective, of order 1, changes by less than 1e-12: sqrt(1e-12)
      // times a few
      EXPECT_LT(distance(x, knapsack.solution()), 1e-5) << n;
    }
}

TEST(StepModel, StaysInTheBoxAndMeetsWhatCanBeMet)
{
  const SecantHessian none(2, 2);
  // x + y = 0, and -x + y falls along (1, -1) until x - 2y = 1.5
  const auto      easy = linear(0., 1.5);
  ScaledProblem   problem(easy);
  const StepModel model(problem, *problem.start(), none);
  EXPECT_LT(distance(model.minimizer(10.), {0.5, -0.5}), 1e-8);
  EXPECT_LT(distance(model.minimizer(0.25), {0.25, -0.25}), 1e-8);

  // x + y = 1 is out of reach of steps of 0.2: as close as they come
  const auto      far = linear(1., 5.);
  ScaledProblem   other(far);
  const StepModel model_of_far(other, *other.start(), none);
  EXPECT_LT(distance(model_of_far.minimizer(0.2), {0.2, 0.2}), 1e-6);
}

TEST(StepModel, MultipliersBalanceTheGradientInsideOfTheBox)
{
  const SecantHessian none(2, 2);
  const auto          easy = linear(0., 1.5);
  ScaledProblem       problem(easy);
  const StepModel     model(problem, *problem.start(), none);
  // (-1, 1) + mu (1, 1) + nu (1, -2) = 0
  const double F  = problem.objective_scale();
  const auto   mu = model.multipliers(model.minimizer(10.), 10.);
  ASSERT_EQ(mu.size(), 2u);
  EXPECT_NEAR(F * mu[0], 1. / 3., 1e-6);
  EXPECT_NEAR(F * mu[1], 2. / 3., 1e-6);
}
