#include <snug/optimization/starts.h>

#include <gtest/gtest.h>

#include "problems.h"

using namespace snug;
using namespace snug::optimization;

namespace {
/// f = sum_i x_i^4 - x_i^2 + 0.2 x_i with 2^n minima in [-1, 1]^n. The start is in the worst one.
DesignProblem double_wells(const unsigned int n)
{
  DesignProblem problem;
  problem.lower.assign(n, -1.);
  problem.upper.assign(n, 1.);
  problem.start.assign(n, 0.7);
  problem.evaluate = [](const std::vector<double> &x) {
    Evaluation value;
    for (const double t : x)
      {
        value.objective += t * t * t * t - t * t + 0.2 * t;
        value.gradient.push_back(4. * t * t * t - 2. * t + 0.2);
      }
    return value;
  };
  return problem;
}

/// The lower minimum of one well, by bisection of 4 t^3 - 2 t + 0.2.
double lower_minimum()
{
  double low = -1., high = -0.5;
  for (unsigned int i = 0; i < 60; ++i)
    {
      const double t                                    = (low + high) / 2.;
      (4. * t * t * t - 2. * t + 0.2 < 0. ? low : high) = t;
    }
  return low;
}

OptimizationParameters with_starts(const unsigned int n)
{
  OptimizationParameters parameters;
  parameters.starts = n;
  return parameters;
}

TEST(Starts, FindTheLowestMinimum)
{
  const auto problem = double_wells(2);
  const auto one     = minimize_from_starts(problem, with_starts(1));
  EXPECT_GT(one.x[0], 0.5);
  EXPECT_GT(one.x[1], 0.5);
  std::vector<unsigned int> numbers;
  Hooks                     hooks;
  hooks.on_iteration = [&](const Iteration &iteration) { numbers.push_back(iteration.number); };
  const auto best    = minimize_from_starts(problem, with_starts(12), hooks);
  EXPECT_TRUE(best.success);
  for (const double x : best.x)
    EXPECT_NEAR(x, lower_minimum(), 1e-5);
  EXPECT_EQ(best.objective_initial, one.objective_initial);
  // iterations are numbered through all searches, the starts included
  for (unsigned int i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(numbers[i], i);
  EXPECT_EQ(best.iterations + 1, numbers.size());
  EXPECT_EQ(minimize_from_starts(problem, with_starts(12)).x, best.x); // the same designs
}

TEST(Starts, ShareTheMaximumOfEvaluations)
{
  auto         problem = double_wells(3);
  unsigned int n       = 0;
  problem.evaluate     = [&n, inner = problem.evaluate](const auto &x) {
    ++n;
    return inner(x);
  };
  auto parameters                = with_starts(100);
  parameters.maximum_evaluations = 30;
  const auto result              = minimize_from_starts(problem, parameters);
  EXPECT_EQ(n, 30u);
  EXPECT_EQ(result.evaluations, 30u);
}

TEST(Starts, LeaveOutDesignsThatCannotBeEvaluated)
{
  auto problem     = double_wells(1);
  problem.evaluate = [inner = problem.evaluate](const auto &x) {
    if (x[0] < 0.)
      throw TangledMesh("no value");
    return inner(x);
  };
  std::vector<std::string> log;
  Hooks                    hooks;
  hooks.log         = [&](const std::string &line) { log.push_back(line); };
  const auto result = minimize_from_starts(problem, with_starts(8), hooks);
  EXPECT_TRUE(result.success);
  EXPECT_GT(result.x[0], 0.5);
  EXPECT_TRUE(std::any_of(log.begin(), log.end(), [](const std::string &line) {
    return line.find("cannot be evaluated: no value") != std::string::npos;
  }));
}

TEST(Starts, EndTogetherByAnInterruption)
{
  auto         problem = double_wells(2);
  unsigned int n       = 0;
  problem.evaluate     = [&n, inner = problem.evaluate](const auto &x) {
    if (++n > 12)
      throw Interrupted("by a test");
    return inner(x);
  };
  const auto result = minimize_from_starts(problem, with_starts(50));
  EXPECT_EQ(result.end, StopReason::interrupted);
  EXPECT_EQ(result.stop_reason, "interrupted");
  EXPECT_FALSE(result.success);
  EXPECT_LE(result.evaluations, 13u);
}
} // namespace
