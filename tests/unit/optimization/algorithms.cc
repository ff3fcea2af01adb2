#include <snug/base/errors.h>
#include <snug/optimization/limit.h>
#include <snug/optimization/minimize.h>

#include <gtest/gtest.h>

#include "problems.h"

#include <string>

using namespace snug;
using namespace snug::optimization;

namespace {
/// The knapsack holds at most its total; a second limit is never reached.
DesignProblem at_most(const Knapsack &knapsack)
{
  auto problem              = knapsack.problem();
  problem.relations         = {Relation::at_most, Relation::at_most};
  problem.constraint_scales = {knapsack.total, knapsack.total};
  problem.evaluate          = [knapsack, inner = problem.evaluate](const auto &x) {
    auto value = inner(x);
    value.constraints.push_back(value.constraints[0] - 100. * knapsack.total);
    value.jacobian.push_back(value.jacobian[0]);
    return value;
  };
  return problem;
}

/// Half a knapsack: its total is reached (the solution is that of the
/// equality).
Knapsack full()
{
  Knapsack knapsack(9);
  for (double &target : knapsack.t)
    target += 1.;
  return knapsack;
}

OptimizationParameters with(const Algorithm algorithm)
{
  OptimizationParameters parameters;
  parameters.objective_tolerance  = 1e-10;
  parameters.algorithm            = algorithm;
  parameters.maximum_evaluations  = 2000;
  parameters.constraint_tolerance = 1e-7;
  return parameters;
}

const Algorithm all[] = {Algorithm::SLSQP, Algorithm::MMA, Algorithm::CCSAQ, Algorithm::AUGLAG};
} // namespace

TEST(Algorithms, HoldInequalities)
{
  const auto knapsack = full();
  for (const Algorithm algorithm : all)
    {
      const auto result = minimize(at_most(knapsack), with(algorithm));
      EXPECT_TRUE(result.success) << to_text(algorithm) << ": " << result.stop_reason;
      EXPECT_LT(distance(result.x, knapsack.solution()), 1e-3) << to_text(algorithm);
      EXPECT_LE(result.constraint_violation, 1e-7) << to_text(algorithm);
      EXPECT_LT(result.projected_gradient, 1e-3) << to_text(algorithm);
    }
}

TEST(Algorithms, LeaveLimitsThatAreNotReached)
{
  auto knapsack = Knapsack(9);
  knapsack.total *= 10.; // all of it fits
  auto lone = knapsack;
  for (unsigned int i = 0; i < 9; ++i)
    lone.t[i] = std::clamp(knapsack.t[i], 0., 1.);
  for (const Algorithm algorithm : all)
    {
      const auto result = minimize(at_most(knapsack), with(algorithm));
      EXPECT_TRUE(result.success) << to_text(algorithm) << ": " << result.stop_reason;
      EXPECT_LT(distance(result.x, lone.t), 1e-3) << to_text(algorithm);
    }
}

TEST(Algorithms, HoldEqualitiesOrRefuseThem)
{
  const Knapsack knapsack(9);
  for (const Algorithm algorithm : all)
    if (takes_equalities(algorithm))
      {
        const auto result = minimize(knapsack.problem(), with(algorithm));
        EXPECT_TRUE(result.success) << to_text(algorithm) << ": " << result.stop_reason;
        EXPECT_LT(distance(result.x, knapsack.solution()), 1e-3) << to_text(algorithm);
        EXPECT_LE(result.constraint_violation, 1e-7) << to_text(algorithm);
      }
    else
      EXPECT_THROW(minimize(knapsack.problem(), with(algorithm)), InputError);
}

TEST(Algorithms, ReportDesignsThatGetBetter)
{
  for (const Algorithm algorithm : all)
    {
      std::vector<Iteration> reported;
      Hooks                  hooks;
      hooks.on_iteration = [&](const Iteration &it) { reported.push_back(it); };
      const auto result  = minimize(at_most(full()), with(algorithm), hooks);
      ASSERT_EQ(reported.size(), result.iterations + 1) << to_text(algorithm);
      EXPECT_EQ(reported.front().evaluation.objective, result.objective_initial);
      EXPECT_GT(reported.front().projected_gradient, 1e-1);
    }
}

TEST(Algorithms, StepBackFromDesignsWithoutAValue)
{
  for (const Algorithm algorithm : all)
    {
      // the minimum is beside the hole
      const auto knapsack = full();
      const auto minimum  = knapsack.solution();
      const auto problem  = with_hole(at_most(knapsack), minimum[0] + 0.05, minimum[0] + 0.1);
      const auto result   = minimize(problem, with(algorithm));
      EXPECT_NE(result.stop_reason, "") << to_text(algorithm);
      EXPECT_LE(result.objective_final, result.objective_initial);
    }
}

TEST(Limit, ReadsSidesValuesAndMultiples)
{
  const auto expect = [](const std::string &text, Limit::Side side, double value, bool of_initial) {
    const auto limit = read_limit(text);
    EXPECT_EQ(limit.side, side) << text;
    EXPECT_EQ(limit.value, value) << text;
    EXPECT_EQ(limit.of_initial, of_initial) << text;
  };
  expect("initial", Limit::Side::equal, 1., true);
  expect("= initial", Limit::Side::equal, 1., true);
  expect("5", Limit::Side::equal, 5., false);
  expect("<= 120", Limit::Side::at_most, 120., false);
  expect("<=-1e-3", Limit::Side::at_most, -1e-3, false);
  expect(">= 0.9 initial", Limit::Side::at_least, 0.9, true);
  for (const std::string wrong :
       {"", "<=", "< 3", "initially", "3 4", "nan", "=> 2", "2 * initial"})
    EXPECT_ANY_THROW(read_limit(wrong)) << wrong;
}
