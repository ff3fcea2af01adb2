#include <snug/base/errors.h>
#include <snug/optimization/minimize.h>

#include <gtest/gtest.h>

#include "problems.h"

#include <algorithm>
#include <limits>

using namespace snug;
using namespace snug::optimization;

TEST(SqpFailures, StepsBackFromTangledDesignsAndArrives)
{
  // The valley's minimum is at x = 0.786; the first long steps land beyond.
  const auto               exact = rosenbrock_minimum();
  std::vector<std::string> log;
  Hooks                    hooks;
  hooks.log          = [&](const std::string &line) { log.push_back(line); };
  const auto problem = with_hole(rosenbrock_on_circle(), 0.9, 10.);
  const auto result  = minimize(problem, tight(), hooks);
  EXPECT_TRUE(result.success) << result.stop_reason;
  EXPECT_LT(distance(result.x, exact), design_accuracy);
  ASSERT_FALSE(log.empty());
  EXPECT_NE(log[0].find("to a quarter"), std::string::npos) << log[0];
  EXPECT_NE(log[0].find("cell 5 of body punch"), std::string::npos);
}

TEST(SqpFailures, StopsAtTheBestDesignIfTheMinimumIsTangled)
{
  const auto exact = rosenbrock_minimum();
  for (const bool as_nan : {false, true})
    {
      auto problem = with_hole(rosenbrock_on_circle(), 0.6, 10.);
      if (as_nan)
        problem.evaluate = [inner = problem.evaluate](const auto &x) {
          try
            {
              return inner(x);
            }
          catch (const TangledMesh &)
            {
              Evaluation nan = rosenbrock_on_circle().evaluate(x);
              nan.objective  = std::numeric_limits<double>::quiet_NaN();
              return nan;
            }
        };
      const auto result = minimize(problem, tight());
      EXPECT_FALSE(result.success);
      EXPECT_EQ(result.stop_reason.rfind("failed evaluations (", 0), 0u);
      EXPECT_EQ(result.stop_reason.find("is tangled") == std::string::npos, as_nan)
        << result.stop_reason;
      // beside the hole, on the circle
      EXPECT_LE(result.x[0], 0.6);
      EXPECT_NEAR(result.x[0], 0.6, 1e-5);
      EXPECT_LE(result.constraint_violation, 1e-8);
      EXPECT_LE(result.evaluations, 70u);
    }
}

TEST(SqpFailures, OnlyResultsThatMeetTheConstraintsAreNoComplaint)
{
  auto parameters                = tight();
  parameters.maximum_evaluations = 1;
  const auto result              = minimize(rosenbrock_on_circle(), parameters);
  EXPECT_EQ(result.stop_reason, "maximum evaluations");
  for (const double violation : {0., 0.9, 1.1, 1e5})
    for (const StopReason end :
         {StopReason::interrupted, StopReason::evaluations, StopReason::round_off})
      {
        auto other                 = result;
        other.end                  = end;
        other.constraint_violation = violation * usable_violation;
        const auto text            = failure_reason(other, parameters);
        EXPECT_EQ(text.empty(), violation < 1. && end != StopReason::round_off);
        EXPECT_EQ(text.find("violates") != std::string::npos, !text.empty() && violation > 0.);
      }
  EXPECT_EQ(failure_reason(minimize(rosenbrock_on_circle(), tight()), tight()), "");
}

/// A search along a curved constraint violates it by the square of its steps.
TEST(SqpFailures, TheLowestDesignOnItsLimitsIsKeptWhenEvaluationsRunOut)
{
  auto       problem = rosenbrock_on_circle();
  const auto start   = problem.evaluate(problem.start).objective;
  double     lowest  = start;
  problem.evaluate   = [&lowest, inner = problem.evaluate](const std::vector<double> &x) {
    const auto value = inner(x);
    if (std::abs(value.constraints[0]) <= usable_violation)
      lowest = std::min(lowest, value.objective);
    return value;
  };
  unsigned int n_lower = 0;
  for (unsigned int n = 1; n < 25; ++n)
    {
      auto parameters                = tight();
      parameters.maximum_evaluations = n;
      lowest                         = start;
      const auto result              = minimize(problem, parameters);
      if (result.end != StopReason::evaluations || lowest == start)
        continue;
      ++n_lower;
      EXPECT_LE(result.objective_final, lowest) << n;
      EXPECT_LE(result.constraint_violation, usable_violation) << n;
      EXPECT_EQ(failure_reason(result, parameters), "") << n;
    }
  EXPECT_GT(n_lower, 0u);
}

/// Wherever the evaluations run out, also within a line search.
TEST(SqpFailures, TheDesignFoundIsAlwaysOneOfTheIterations)
{
  for (unsigned int n = 1; n < 25; ++n)
    {
      auto parameters                = tight();
      parameters.maximum_evaluations = n;
      std::vector<std::vector<double>> designs;
      Hooks                            hooks;
      hooks.on_iteration = [&](const Iteration &iteration) {
        EXPECT_EQ(iteration.number, designs.size());
        designs.push_back(iteration.x);
      };
      const auto result = minimize(rosenbrock_on_circle(), parameters, hooks);
      EXPECT_EQ(result.iterations + 1, designs.size());
      EXPECT_EQ(std::count(designs.begin(), designs.end(), result.x), 1) << n;
    }
}

/// Beyond a hump of the constraint is a kink, above the limit, that the first step ends in.
TEST(SqpFailures, StepsBackFromKinksThatViolateTheConstraints)
{
  DesignProblem problem;
  problem.lower             = {0.};
  problem.upper             = {10.};
  problem.start             = {0.01};
  problem.relations         = {Relation::at_most};
  problem.constraint_scales = {1.};
  problem.evaluate          = [](const std::vector<double> &x) {
    Evaluation   value;
    const double kink = x[0] - 6.;
    value.objective   = 20. - x[0];
    value.gradient    = {-1.};
    value.constraints = {x[0] < 2. ? x[0] * x[0] - 0.25 : 0.5 + 0.8125 * std::abs(kink)};
    value.jacobian    = {{x[0] < 2. ? 2. * x[0] : std::copysign(0.8125, kink)}};
    return value;
  };
  const auto result = minimize(problem, tight());
  EXPECT_TRUE(result.success) << result.stop_reason;
  EXPECT_NEAR(result.x[0], 0.5, 1e-6);
}

TEST(SqpFailures, AStartWithoutValueIsTheCallersError)
{
  auto problem = with_hole(rosenbrock_on_circle(), -10., 10.);
  EXPECT_THROW(minimize(problem, tight()), TangledMesh);
  problem          = rosenbrock_on_circle();
  problem.evaluate = [inner = problem.evaluate](const auto &x) {
    auto value        = inner(x);
    value.gradient[1] = std::numeric_limits<double>::quiet_NaN();
    return value;
  };
  EXPECT_THROW(minimize(problem, tight()), SolveError);
}

TEST(SqpFailures, OtherExceptionsPassWithTypeAndMessage)
{
  struct Special : std::logic_error
  {
    using std::logic_error::logic_error;
  };
  for (const unsigned int failing : {1, 2, 5})
    {
      auto         problem = rosenbrock_on_circle();
      unsigned int calls   = 0;
      problem.evaluate     = [&, inner = problem.evaluate](const auto &x) {
        if (++calls == failing)
          throw Special("the disk is full");
        return inner(x);
      };
      try
        {
          minimize(problem, tight());
          FAIL();
        }
      catch (const Special &error)
        {
          EXPECT_STREQ(error.what(), "the disk is full");
        }
      EXPECT_EQ(calls, failing);
    }
}

TEST(SqpFailures, ErrorsOfTheHookPassEvenSolveErrors)
{
  for (const unsigned int failing : {0, 1, 3})
    {
      Hooks hooks;
      hooks.on_iteration = [&](const Iteration &iteration) {
        if (iteration.number == failing)
          throw SolveError("cannot write the picture");
      };
      EXPECT_THROW(minimize(rosenbrock_on_circle(), tight(), hooks), SolveError);
    }
}

TEST(SqpFailures, AnInterruptedSearchReturnsTheBestSoFar)
{
  auto         problem = rosenbrock_on_circle();
  unsigned int calls   = 0;
  problem.evaluate     = [&, inner = problem.evaluate](const auto &x) {
    if (++calls == 9)
      throw Interrupted("SIGTERM");
    return inner(x);
  };
  const auto result = minimize(problem, tight());
  EXPECT_EQ(result.stop_reason, "interrupted");
  EXPECT_FALSE(result.success);
  EXPECT_EQ(calls, 9u);
  EXPECT_EQ(problem.evaluate(result.x).objective, result.objective_final);

  Hooks hooks;
  hooks.on_iteration = [](const Iteration &iteration) {
    if (iteration.number == 2)
      throw Interrupted("SIGTERM");
  };
  EXPECT_EQ(minimize(problem, tight(), hooks).stop_reason, "interrupted");
}

TEST(SqpFailures, NoiseEndsTheSearchCloseToTheMinimum)
{
  // A solver tolerance's worth of noise: neither a hang nor a bad design.
  const Knapsack knapsack(9);
  auto           problem = knapsack.problem();
  problem.evaluate       = [inner = problem.evaluate](const auto &x) {
    auto value = inner(x);
    value.objective *= 1. + 1e-7 * std::sin(1e9 * std::accumulate(x.begin(), x.end(), 0.1));
    return value;
  };
  const auto result = minimize(problem, tight());
  EXPECT_LE(result.constraint_violation, 1e-8);
  // sqrt(1e-7) = 3e-4 in x times the problem's condition (5)
  EXPECT_LT(distance(result.x, knapsack.solution()), 2e-3);
  EXPECT_LE(result.evaluations, 200u);
}
