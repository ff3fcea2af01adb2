#include <snug/optimization/minimize.h>

#include <gtest/gtest.h>

#include <cmath>

/// Problems with maxima, against solutions that are known.
namespace {
using namespace snug::optimization;
using Vector = std::vector<double>;

/// Functions with their gradients at a design.
struct Term
{
  double value;
  Vector gradient;
};

/// min over x of a maximum of terms, or of the sum of two maxima. Constraints come first, where a
/// maximum of the objective's terms may be limited.
struct Problem
{
  std::function<std::vector<Term>(const Vector &)>   terms;
  std::vector<std::pair<unsigned int, unsigned int>> maxima; ///< ranges of terms
  Vector                                             start;

  DesignProblem operator()() const
  {
    DesignProblem problem;
    problem.start = start;
    problem.lower.assign(start.size(), -10.);
    problem.upper.assign(start.size(), 10.);
    problem.lengths.assign(start.size(), 1.);
    for (const auto &[begin, end] : maxima)
      problem.maxima.push_back({-1, begin, end});
    problem.relations.assign(maxima.back().second, Relation::term);
    problem.evaluate = [*this](const Vector &x) {
      Evaluation result;
      result.gradient.assign(x.size(), 0.);
      const auto all = terms(x);
      for (const auto &term : all)
        {
          result.constraints.push_back(term.value);
          result.jacobian.push_back(term.gradient);
        }
      for (const auto &[begin, end] : maxima)
        {
          unsigned int best = begin;
          for (unsigned int j = begin; j < end; ++j)
            if (all[j].value > all[best].value)
              best = j;
          result.objective += all[best].value;
          for (unsigned int i = 0; i < x.size(); ++i)
            result.gradient[i] += all[best].gradient[i];
        }
      return result;
    };
    return problem;
  }
};

/// The quadratic polynomial that is nearest to exp on [-1, 1] in the maximum norm: by the theorem
/// of Chebyshev its error takes its largest size four times with alternating signs.
TEST(Epigraph, FindsTheBestUniformApproximation)
{
  Problem problem;
  problem.start  = {1., 1., 0.3};
  problem.maxima = {{0, 202}};
  problem.terms  = [](const Vector &a) {
    std::vector<Term> terms;
    for (int k = 0; k <= 100; ++k)
      for (const double sign : {1., -1.})
        {
          const double t = -1. + k / 50.;
          terms.push_back({sign * (a[0] + a[1] * t + a[2] * t * t - std::exp(t)),
                           {sign, sign * t, sign * t * t}});
        }
    return terms;
  };
  const auto result = minimize(problem(), {});
  EXPECT_TRUE(result.success) << result.stop_reason;
  EXPECT_NEAR(result.objective_final, 0.0450, 1e-4); // E_2(exp) = 0.04502, Powell (1981)
  ASSERT_EQ(result.x.size(), 3u);
  int    changes = 0;
  double last    = 0.;
  for (int k = 0; k <= 100; ++k)
    {
      const double t = -1. + k / 50.;
      const double e = result.x[0] + result.x[1] * t + result.x[2] * t * t - std::exp(t);
      if (std::abs(e) > result.objective_final * (1. - 1e-7) && e * last <= 0.)
        {
          ++changes;
          last = e;
        }
    }
  EXPECT_EQ(changes, 4);
}

/// max(x^2 + y^2, (x-2)^2 + y^2, 2 y + 1.5): where the first two are equal, x = 1, and the third is
/// 2 y + 1.5 = 1 + y^2 at y = 1 - (1.5)^(1/2).
TEST(Epigraph, FindsTheKinkOfThreeFunctions)
{
  Problem problem;
  problem.start  = {5., 4.};
  problem.maxima = {{0, 3}};
  problem.terms  = [](const Vector &x) {
    const double y = x[1];
    return std::vector<Term>{{x[0] * x[0] + y * y, {2. * x[0], 2. * y}},
                             {(x[0] - 2.) * (x[0] - 2.) + y * y, {2. * (x[0] - 2.), 2. * y}},
                             {2. * y + 1.5, {0., 2.}}};
  };
  const auto   result = minimize(problem(), {});
  const double y      = 1. - std::sqrt(1.5);
  EXPECT_TRUE(result.success) << result.stop_reason;
  EXPECT_NEAR(result.x[0], 1., 1e-6);
  EXPECT_NEAR(result.x[1], y, 1e-6);
  // Terms within 1e-6 of the maximum count as active.
  EXPECT_NEAR(result.objective_final, 1. + y * y, 1e-6);
}

/// The range of x, 1 - x and 0.3 + x/10 is max(x, 1-x) - 0.3 - x/10 near x = 1/2, where it is
/// least.
TEST(Epigraph, MinimizesARange)
{
  Problem problem;
  problem.start  = {0.1};
  problem.maxima = {{0, 3}, {3, 6}};
  problem.terms  = [](const Vector &x) {
    const std::vector<Term> of    = {{x[0], {1.}}, {1. - x[0], {-1.}}, {0.3 + 0.1 * x[0], {0.1}}};
    auto                    terms = of;
    for (const auto &term : of)
      terms.push_back({-term.value, {-term.gradient[0]}});
    return terms;
  };
  const auto result = minimize(problem(), {});
  EXPECT_TRUE(result.success) << result.stop_reason;
  EXPECT_NEAR(result.x[0], 0.5, 1e-8);
  EXPECT_NEAR(result.objective_final, 0.15, 1e-8);
}

/// min max(y, -y) with max(x - y, -x - y) <= -1: y = 1 at x = 0.
DesignProblem limited_maximum(const Vector &start, const double length)
{
  DesignProblem problem;
  problem.start   = start;
  problem.lower   = {-10., -10.};
  problem.upper   = {10., 10.};
  problem.lengths = {length, length};
  problem.relations.assign(5, Relation::term);
  problem.relations[0]      = Relation::at_most;
  problem.constraint_scales = {1., 1., 1., 1., 1.};
  problem.maxima            = {{-1, 3, 5}, {0, 1, 3}};
  problem.evaluate          = [](const Vector &x) {
    Evaluation result;
    result.objective  = std::abs(x[1]);
    result.gradient   = {0., x[1] < 0. ? -1. : 1.};
    const double left = -x[0] - x[1], right = x[0] - x[1];
    result.constraints = {std::max(left, right) + 1., left, right, x[1], -x[1]};
    result.jacobian = {{left >= right ? -1. : 1., -1.}, {-1., -1.}, {1., -1.}, {0., 1.}, {0., -1.}};
    return result;
  };
  return problem;
}

TEST(Epigraph, LimitsAMaximum)
{
  // The last starts are so far from the limit that no step within the trust region meets it.
  for (const auto &[start, length] : {std::make_pair(Vector{3., 5.}, 1.),
                                      {Vector{3., -5.}, 0.5},
                                      {Vector{-2., -1.}, 0.1},
                                      {Vector{6., -9.}, 0.2}})
    {
      const auto result = minimize(limited_maximum(start, length), {});
      EXPECT_TRUE(result.success) << start[0] << ' ' << result.stop_reason;
      EXPECT_NEAR(result.x[0], 0., 1e-6) << start[0];
      EXPECT_NEAR(result.x[1], 1., 1e-6) << start[0];
    }
}
} // namespace
