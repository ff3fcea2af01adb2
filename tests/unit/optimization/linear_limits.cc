#include <snug/optimization/linear_limits.h>
#include <snug/optimization/minimize.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace snug::optimization;

/// min (x - 2)^2 + (y - 1)^2 with x y <= 10, whose limit x + y <= 1 leaves (1, 0).
DesignProblem parabola()
{
  DesignProblem problem;
  problem.start     = {-1., -1.};
  problem.lower     = {-5., -5.};
  problem.upper     = {5., 5.};
  problem.lengths   = {1., 1.};
  problem.relations = {Relation::at_most};
  problem.evaluate  = [](const std::vector<double> &x) {
    Evaluation result;
    result.objective   = std::pow(x[0] - 2., 2) + std::pow(x[1] - 1., 2);
    result.constraints = {x[0] * x[1] - 10.};
    return result;
  };
  problem.differentiate = [](const std::vector<double> &x, Evaluation &evaluation) {
    evaluation.gradient = {2. * (x[0] - 2.), 2. * (x[1] - 1.)};
    evaluation.jacobian = {{x[1], x[0]}};
  };
  problem.constraint_scales = {10.};
  return problem;
}

TEST(LinearLimits, HoldTheMinimum)
{
  const auto limited = with_limits(parabola(), {{{1., 1.}, 1.}, {{-1., 2.}, 3.}});
  for (const auto algorithm : {Algorithm::SQP, Algorithm::MMA})
    {
      OptimizationParameters parameters;
      parameters.algorithm = algorithm;
      const auto result    = minimize(limited, parameters);
      EXPECT_NEAR(result.x[0], 1., 1e-4);
      EXPECT_NEAR(result.x[1], 0., 1e-4);
      EXPECT_TRUE(result.success) << result.stop_reason;
    }
}

TEST(LinearLimits, FollowTheConstraintsWithTheirDerivatives)
{
  const auto limited = with_limits(parabola(), {{{1., 1.}, 1.}, {{-1., 2.}, 3.}});
  Evaluation at      = limited.evaluate({0.3, 0.4});
  EXPECT_EQ(at.constraints.size(), 3u);
  EXPECT_TRUE(at.jacobian.empty());
  limited.differentiate({0.3, 0.4}, at);
  ASSERT_EQ(at.jacobian.size(), 3u);
  const double h = 1e-3;
  for (unsigned int i = 0; i < 2; ++i)
    {
      std::vector<double> after = {0.3, 0.4}, before = after;
      after[i] += h;
      before[i] -= h;
      for (unsigned int j = 0; j < 3; ++j)
        EXPECT_NEAR((limited.evaluate(after).constraints[j] -
                     limited.evaluate(before).constraints[j]) /
                      (2. * h),
                    at.jacobian[j][i], 1e-10);
    }
}
} // namespace
