#include <snug/base/errors.h>
#include <snug/optimization/limit.h>
#include <snug/optimization/minimize.h>

#include <gtest/gtest.h>

#include "problems.h"

#include <numeric>
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

const Algorithm all[] = {Algorithm::SQP, Algorithm::MMA};
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

TEST(Algorithms, AcceptViolationsUpToTheConstraintTolerance)
{
  const Knapsack knapsack(9);
  const double   full = std::accumulate(knapsack.a.begin(), knapsack.a.end(), 0.);
  for (const Algorithm algorithm : all)
    for (const double tolerance : {1e-2, 1e-4})
      {
        auto problem = at_most(knapsack);
        problem.start.assign(9, 1.001 * knapsack.total / full); // 1e-3 above the limit
        auto parameters                 = with(algorithm);
        parameters.constraint_tolerance = tolerance;
        parameters.maximum_evaluations  = 1;
        const auto result               = minimize(problem, parameters);
        EXPECT_NEAR(result.constraint_violation, 1e-3, 1e-9) << to_text(algorithm);
        EXPECT_EQ(failure_reason(result, parameters).empty(), tolerance > 1e-3)
          << to_text(algorithm);
      }
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

/// min |x - t|^2 / 2 from 0, where the gradient of c = a x^2 + b y^2 is
/// @p slope, round-off.
static DesignProblem blind(const std::vector<double> &t,
                           const double               a,
                           const double               b,
                           const Relation             relation,
                           const double               slope = 1e-17)
{
  DesignProblem problem;
  problem.lower             = {-1., -1.};
  problem.upper             = {1., 1.};
  problem.start             = {0., 0.};
  problem.relations         = {relation};
  problem.constraint_scales = {1.};
  problem.evaluate          = [=](const std::vector<double> &x) {
    Evaluation value;
    value.gradient  = {x[0] - t[0], x[1] - t[1]};
    value.objective = 10. + (std::pow(value.gradient[0], 2) + std::pow(value.gradient[1], 2)) / 2.;
    value.constraints = {a * x[0] * x[0] + b * x[1] * x[1]};
    value.jacobian    = {{slope + 2. * a * x[0], 2. * b * x[1]}};
    return value;
  };
  return problem;
}

/// The gradient of the constraint vanishes at the start, like that of the volume of a symmetric
/// body.
TEST(Algorithms, LeaveAStartWhereAConstraintHasNoGradient)
{
  const std::vector<double> t = {0.5, 0.2};
  for (const Algorithm algorithm : all)
    {
      const auto free = minimize(blind(t, -1., -1., Relation::at_most), with(algorithm));
      EXPECT_TRUE(free.success) << to_text(algorithm) << ": " << free.stop_reason;
      EXPECT_LT(distance(free.x, t), 1e-3) << to_text(algorithm);
      const auto held = minimize(blind(t, 1., -1., Relation::at_most), with(algorithm));
      EXPECT_TRUE(held.success) << to_text(algorithm) << ": " << held.stop_reason;
      EXPECT_LT(distance(held.x, {0.35, 0.35}), 1e-3) << to_text(algorithm);
      if (!takes_equalities(algorithm))
        continue;
      const auto equal = minimize(blind(t, 1., -1., Relation::equal), with(algorithm));
      EXPECT_TRUE(equal.success) << to_text(algorithm) << ": " << equal.stop_reason;
      EXPECT_LT(distance(equal.x, {0.35, 0.35}), 1e-3) << to_text(algorithm);
    }
}

/// A slope that is small, but none: MMA's first model allows no step.
TEST(Algorithms, NoSuccessAtAStartThatCannotBeLeft)
{
  for (const Algorithm algorithm : all)
    {
      const auto result =
        minimize(blind({-0.5, 0.2}, 1., 1., Relation::at_most, -1e-7), with(algorithm));
      EXPECT_TRUE(result.iterations > 0 || !result.success)
        << to_text(algorithm) << ": " << result.stop_reason;
    }
}

/// A narrow valley across the axes, which separable models see badly.
TEST(Algorithms, EndByATolerance)
{
  for (const Relation relation : {Relation::at_most, Relation::equal})
    {
      auto problem     = blind({0.6, 0.1}, -1., -1., relation);
      problem.start    = {-0.5, 0.5};
      problem.evaluate = [inner = problem.evaluate](const std::vector<double> &x) {
        auto         value = inner(x);
        const double along = x[0] - 0.6 + x[1] - 0.1, across = x[0] - 0.6 - x[1] + 0.1;
        value.objective   = 10. + (along * along + 1e4 * across * across) / 2.;
        value.gradient    = {along + 1e4 * across, along - 1e4 * across};
        value.constraints = {x[0] + 2. * x[1] - 0.8};
        value.jacobian    = {{1., 2.}};
        return value;
      };
      for (const Algorithm algorithm : all)
        {
          if (relation == Relation::equal && !takes_equalities(algorithm))
            continue;
          OptimizationParameters parameters;
          parameters.algorithm = algorithm;
          const auto result    = minimize(problem, parameters);
          EXPECT_TRUE(result.success) << to_text(algorithm) << ": " << result.stop_reason;
          EXPECT_LT(distance(result.x, {0.6, 0.1}), 1e-3) << to_text(algorithm);
        }
    }
}

/// x^2 + y^2 = 0 holds at the start alone.
TEST(Algorithms, NoSuccessWhereOnlyTheStartMeetsAnEquality)
{
  const auto result = minimize(blind({0.5, 0.2}, 1., 1., Relation::equal), with(Algorithm::SQP));
  EXPECT_FALSE(result.success) << result.stop_reason;
  EXPECT_NE(failure_reason(result, with(Algorithm::SQP)), "");
}

/// A limit of round-off, as of a displacement that symmetry forbids.
TEST(Algorithms, ScaleConstraintsByTheirSlopesWhereLimitsAreRoundOff)
{
  for (const double scale : {0., 1e-17})
    {
      auto problem              = blind({0.5, 0.2}, 0., 0., Relation::at_most);
      problem.constraint_scales = {scale};
      problem.evaluate          = [inner = problem.evaluate](const std::vector<double> &x) {
        auto value        = inner(x);
        value.constraints = {1e-3 * (x[0] - x[1]) + 1e-13 * std::sin(1e9 * x[0])};
        value.jacobian    = {{1e-3, -1e-3}};
        return value;
      };
      for (const Algorithm algorithm : all)
        {
          const auto result = minimize(problem, with(algorithm));
          EXPECT_TRUE(result.success) << to_text(algorithm) << ": " << result.stop_reason;
          EXPECT_LT(distance(result.x, {0.35, 0.35}), 1e-3) << to_text(algorithm);
        }
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
