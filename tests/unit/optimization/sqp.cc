#include <snug/base/errors.h>
#include <snug/optimization/minimize.h>

#include <gtest/gtest.h>

#include "problems.h"

#include <limits>
#include <set>

using namespace snug;
using namespace snug::optimization;

TEST(Sqp, SolvesQuadraticWithEqualityAndBounds)
{
  for (const unsigned int n : {1, 2, 9, 40})
    {
      const Knapsack knapsack(n);
      const auto     result = minimize(knapsack.problem(), tight());
      EXPECT_TRUE(result.success) << result.stop_reason;
      EXPECT_LT(distance(result.x, knapsack.solution()), design_accuracy) << n;
      EXPECT_LE(result.constraint_violation, 1e-8);
      EXPECT_LT(result.projected_gradient, 1e-4);
    }
}

TEST(Sqp, StaysWhereItStartsIfThatIsTheMinimum)
{
  const Knapsack knapsack(9);
  auto           problem = knapsack.problem();
  problem.start          = knapsack.solution();
  const auto result      = minimize(problem, OptimizationParameters());
  EXPECT_TRUE(result.success) << result.stop_reason;
  EXPECT_EQ(result.stop_reason, "gradient tolerance");
  EXPECT_EQ(result.evaluations, 1u);
  EXPECT_LT(distance(result.x, problem.start), 1e-7);
  EXPECT_LT(result.projected_gradient, 1e-7);
}

TEST(Sqp, EndsByItsOwnToleranceWithinDefaults)
{
  const Knapsack knapsack(16);
  const auto     result = minimize(knapsack.problem(), OptimizationParameters());
  EXPECT_TRUE(result.success);
  EXPECT_TRUE(result.stop_reason == "gradient tolerance" ||
              result.stop_reason == "objective tolerance" ||
              result.stop_reason == "design tolerance")
    << result.stop_reason;
  EXPECT_LE(result.constraint_violation, 1e-8);
  EXPECT_LT(distance(result.x, knapsack.solution()), 1e-3);
  // a convex quadratic is descended by full steps, almost without others
  EXPECT_LT(result.iterations, result.evaluations);
  EXPECT_GE(result.iterations + 4, result.evaluations);
}

TEST(Sqp, FollowsRosenbrocksValleyAlongACircle)
{
  const auto result = minimize(rosenbrock_on_circle(), tight());
  EXPECT_TRUE(result.success) << result.stop_reason;
  EXPECT_LT(distance(result.x, rosenbrock_minimum()), design_accuracy);
}

TEST(Sqp, ReachesTheSameDesignWhateverTheUnits)
{
  const auto   reference = minimize(rosenbrock_on_circle(), tight());
  const auto   exact     = rosenbrock_minimum();
  const double factors[] = {1e-6, 1e8};
  for (const double f : factors)
    for (const double length : factors)
      {
        auto problem = rosenbrock_on_circle();
        for (auto *v : {&problem.lower, &problem.upper, &problem.start})
          for (double &entry : *v)
            entry *= length;
        problem.constraint_scales = {f};
        problem.evaluate          = [=, inner = problem.evaluate](std::vector<double> x) {
          for (double &entry : x)
            entry /= length;
          auto value = inner(x);
          value.objective *= f;
          value.constraints[0] *= f;
          for (unsigned int i = 0; i < 2; ++i)
            {
              value.gradient[i] *= f / length;
              value.jacobian[0][i] *= f / length;
            }
          return value;
        };
        auto result = minimize(problem, tight());
        for (double &entry : result.x)
          entry /= length;
        EXPECT_TRUE(result.success) << result.stop_reason;
        EXPECT_LT(distance(result.x, exact), design_accuracy);
        EXPECT_NEAR(result.projected_gradient, reference.projected_gradient, 1e-6);
      }
}

TEST(Sqp, NeedsNoValueOfTheObjectiveAtTheStart)
{
  // f(start) = 0: the scale must come from the gradient.
  const Knapsack knapsack(9);
  auto           problem = knapsack.problem();
  const double   shift   = problem.evaluate(problem.start).objective;
  problem.evaluate       = [shift, inner = problem.evaluate](const auto &x) {
    auto value = inner(x);
    value.objective -= shift;
    return value;
  };
  const auto result = minimize(problem, tight());
  EXPECT_TRUE(result.success) << result.stop_reason;
  EXPECT_LT(distance(result.x, knapsack.solution()), design_accuracy);
}

TEST(Sqp, MovesTheStartIntoTheBounds)
{
  const Knapsack knapsack(9);
  auto           problem = knapsack.problem();
  problem.start[0]       = 17.;
  problem.start[1]       = -1e6;
  std::vector<double> first;
  Hooks               hooks;
  hooks.on_iteration = [&](const Iteration &iteration) {
    if (iteration.number == 0)
      first = iteration.x;
  };
  const auto result = minimize(problem, tight(), hooks);
  EXPECT_EQ(first[0], 1.);
  EXPECT_EQ(first[1], 0.);
  EXPECT_EQ(first[2], 0.5);
  EXPECT_LT(distance(result.x, knapsack.solution()), design_accuracy);
}

TEST(Sqp, LeavesVariablesWithEqualBoundsAlone)
{
  const Knapsack knapsack(9);
  auto           problem = knapsack.problem();
  problem.lower[4] = problem.upper[4] = 0.25;
  const auto result                   = minimize(problem, tight());
  EXPECT_TRUE(result.success) << result.stop_reason;
  EXPECT_EQ(result.x[4], 0.25);
  EXPECT_LE(result.constraint_violation, 1e-8);
  EXPECT_LT(result.projected_gradient, 1e-5);
}

TEST(Sqp, AsksForEachDesignOnceAndWithinTheBounds)
{
  auto                          problem = rosenbrock_on_circle();
  std::set<std::vector<double>> designs;
  unsigned int                  calls = 0;
  problem.evaluate                    = [&, inner = problem.evaluate](const auto &x) {
    ++calls;
    designs.insert(x);
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        EXPECT_LE(problem.lower[i], x[i]);
        EXPECT_GE(problem.upper[i], x[i]);
      }
    return inner(x);
  };
  const auto result = minimize(problem, OptimizationParameters());
  EXPECT_EQ(calls, designs.size());
  EXPECT_EQ(calls, result.evaluations);
}

TEST(Sqp, ReportsEveryAcceptedDesignOnce)
{
  std::vector<Iteration> reported;
  Hooks                  hooks;
  hooks.on_iteration = [&](const Iteration &it) { reported.push_back(it); };
  const auto problem = rosenbrock_on_circle();
  const auto result  = minimize(problem, tight(), hooks);
  ASSERT_EQ(reported.size(), result.iterations + 1);
  EXPECT_EQ(reported[0].x, problem.start);
  EXPECT_EQ(reported[0].evaluation.objective, result.objective_initial);
  std::set<std::vector<double>> designs;
  for (unsigned int i = 0; i < reported.size(); ++i)
    {
      EXPECT_EQ(reported[i].number, i);
      EXPECT_TRUE(designs.insert(reported[i].x).second);
      EXPECT_EQ(reported[i].evaluation.objective, problem.evaluate(reported[i].x).objective);
      EXPECT_LE(reported[i].evaluations, result.evaluations);
    }
  EXPECT_LT(reported.back().projected_gradient, 1e-5);
  EXPECT_GT(reported.front().projected_gradient, 1e-1);
}

TEST(Sqp, KeepsToTheNumberOfEvaluations)
{
  for (const unsigned int allowed : {1, 2, 3, 5, 7})
    {
      OptimizationParameters parameters = tight();
      parameters.maximum_evaluations    = allowed;
      const auto result                 = minimize(rosenbrock_on_circle(), parameters);
      EXPECT_EQ(result.evaluations, allowed);
      EXPECT_EQ(result.stop_reason, "maximum evaluations");
      EXPECT_FALSE(result.success);
    }
}

TEST(Sqp, NeverClaimsSuccessForAVolumeThatCannotBe)
{
  for (const unsigned int n : {2, 16})
    for (const double tolerance : {1e-4, 1e-6, 1e-8})
      {
        Knapsack knapsack(n);
        knapsack.total *= 3.;
        OptimizationParameters parameters;
        parameters.objective_tolerance = tolerance;
        const auto result              = minimize(knapsack.problem(), parameters);
        EXPECT_FALSE(result.success);
        EXPECT_GT(result.constraint_violation, 0.3);
        EXPECT_EQ(result.stop_reason, "no design satisfies the limits");
      }
}

TEST(Sqp, MeetsNonlinearConstraintsAlsoWithLooseObjectiveTolerance)
{
  // NLopt by itself reports success with |c| = 6e-3 here and there.
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6})
    {
      OptimizationParameters parameters;
      parameters.objective_tolerance = tolerance;
      const auto result              = minimize(rosenbrock_on_circle(), parameters);
      EXPECT_TRUE(result.success) << result.stop_reason;
      EXPECT_LE(result.constraint_violation, 1e-8);
    }
}

TEST(Sqp, RejectsWrongInput)
{
  const Knapsack knapsack(3);
  const auto rejects = [](const DesignProblem &problem, const OptimizationParameters &parameters) {
    EXPECT_THROW(minimize(problem, parameters), InputError);
  };
  auto problem     = knapsack.problem();
  problem.upper[1] = -1.;
  rejects(problem, OptimizationParameters());
  problem          = knapsack.problem();
  problem.start[2] = std::numeric_limits<double>::quiet_NaN();
  rejects(problem, OptimizationParameters());
  problem          = knapsack.problem();
  problem.upper[2] = std::numeric_limits<double>::infinity();
  rejects(problem, OptimizationParameters());
  auto parameters                = OptimizationParameters();
  parameters.maximum_evaluations = 0;
  rejects(knapsack.problem(), parameters);
  parameters                     = OptimizationParameters();
  parameters.objective_tolerance = 0.;
  rejects(knapsack.problem(), parameters);
}

TEST(Sqp, RejectsMoreEqualitiesThanVariablesInOneLine)
{
  auto problem     = Knapsack(2).problem();
  problem.evaluate = [inner = problem.evaluate](const std::vector<double> &x) {
    auto value = inner(x);
    value.constraints.resize(3, value.constraints[0]);
    value.jacobian.resize(3, value.jacobian[0]);
    return value;
  };
  problem.constraint_scales.resize(3, 1.);
  try
    {
      minimize(problem, OptimizationParameters());
      FAIL() << "3 equalities for 2 variables";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(one_line(error), "the number of equality constraints, 3, must not exceed the "
                                 "number of design variables, 2");
    }
}

/// Where no bound is active, the width of the bounds decides nothing.
TEST(Sqp, TakesTheSamePathWhateverTheBounds)
{
  std::vector<std::vector<double>> paths[2];
  for (const unsigned int wide : {0, 1})
    {
      auto problem    = rosenbrock_on_circle();
      problem.lengths = {0.1, 0.1};
      if (wide == 1)
        problem.lower = {-100., -200.}, problem.upper = {300., 100.};
      Hooks hooks;
      hooks.on_iteration = [&](const Iteration &it) { paths[wide].push_back(it.x); };
      OptimizationParameters parameters;
      parameters.design_tolerance = 1e-15; // relative to the width
      EXPECT_TRUE(minimize(problem, parameters, hooks).success);
    }
  ASSERT_EQ(paths[0].size(), paths[1].size());
  for (unsigned int k = 0; k < paths[0].size(); ++k)
    EXPECT_LT(distance(paths[0][k], paths[1][k]), 1e-9) << k;
}
