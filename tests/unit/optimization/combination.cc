#include <snug/optimization/combination.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace snug;
using Numbers = std::vector<double>;
using optimization::Combination;

optimization::Combined
combine(const Combination kind, const Numbers &values, const Numbers &weights)
{
  return optimization::combined(kind, values, weights, 5.);
}

TEST(Combination, OneObjectiveKeepsItsValue)
{
  for (const auto kind : {Combination::sum, Combination::worst})
    {
      const auto one = combine(kind, {-3.}, {1.});
      EXPECT_EQ(one.value, -3.);
      EXPECT_EQ(one.factors, Numbers{1.});
    }
}

TEST(Combination, SumIsWeighted)
{
  const auto both = combine(Combination::sum, {-3., 2.}, {2., 0.5});
  EXPECT_EQ(both.value, -5.);
  EXPECT_EQ(both.factors, (Numbers{2., 0.5}));
}

TEST(Combination, WorstIsASharpUpperBoundOfTheMaximum)
{
  const double bound = 5. * std::log(3.) / 100.;
  for (const Numbers &values :
       {Numbers{-1., -2., -3.}, Numbers{1., 1., 1.}, Numbers{0.1, 0., -50.}, Numbers{1e5, 1e4, 0.}})
    {
      const double largest = *std::max_element(values.begin(), values.end());
      const auto   worst   = combine(Combination::worst, values, {1., 1., 1.});
      EXPECT_GE(worst.value, largest);
      EXPECT_LE(worst.value, largest + bound * (1. + 1e-14));
      double sum = 0.;
      for (const double factor : worst.factors)
        sum += factor;
      EXPECT_NEAR(sum, 1., 1e-14);
    }
  EXPECT_NEAR(combine(Combination::worst, {1., 1., 1.}, {1., 1., 1.}).value, 1. + bound, 1e-14);
}

TEST(Combination, FactorsAreTheDerivatives)
{
  const Numbers values = {1., 1.02, 0.9}, weights = {1., 0.99, 1.1};
  const double  step  = 1e-5;
  const auto    worst = combine(Combination::worst, values, weights);
  for (unsigned int c = 0; c < 3; ++c)
    {
      Numbers forward = values, backward = values;
      forward[c] += step;
      backward[c] -= step;
      const double slope = (combine(Combination::worst, forward, weights).value -
                            combine(Combination::worst, backward, weights).value) /
                           (2. * step);
      EXPECT_NEAR(worst.factors[c], slope, 1e-7);
      EXPECT_GT(worst.factors[c], 0.05);
    }
}
} // namespace
