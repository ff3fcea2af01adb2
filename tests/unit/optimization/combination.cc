#include <snug/optimization/combination.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {
using namespace snug;
using optimization::Combination;
using Numbers = std::vector<double>;

const Numbers values = {3., -1., 2.5}, weights = {1., 2., 1.5};

double value(const std::string &text)
{
  return optimization::combined(Combination::read(text), values, weights).value;
}

TEST(Combination, HasTheValueOfItsFormula)
{
  const double sum = 3. - 2. + 3.75, mean = sum / 4.5;
  const double variance =
    (std::pow(3. - mean, 2) + 2. * std::pow(-1. - mean, 2) + 1.5 * std::pow(2.5 - mean, 2)) / 4.5;
  EXPECT_NEAR(value("sum"), sum, 1e-14);
  EXPECT_NEAR(value("mean"), mean, 1e-14);
  EXPECT_EQ(value("worst"), 3.75);
  EXPECT_EQ(value("range"), 3.75 + 2.);
  EXPECT_NEAR(value("deviation"), std::sqrt(variance), 1e-14);
  EXPECT_NEAR(value("mean + 2 deviation"), mean + 2. * std::sqrt(variance), 1e-14);
}

TEST(Combination, HasExactDerivatives)
{
  for (const auto *text : {"sum", "mean", "worst", "range", "deviation", "mean + 1.5 deviation"})
    {
      const auto   found = optimization::combined(Combination::read(text), values, weights);
      const double step  = 1e-6;
      for (unsigned int c = 0; c < values.size(); ++c)
        {
          auto forward = values, backward = values;
          forward[c] += step;
          backward[c] -= step;
          const double slope =
            (optimization::combined(Combination::read(text), forward, weights).value -
             optimization::combined(Combination::read(text), backward, weights).value) /
            (2. * step);
          EXPECT_NEAR(found.factors[c], slope, 1e-8) << text;
        }
    }
}

TEST(Combination, OfOneValue)
{
  for (const auto *text : {"mean", "worst"})
    EXPECT_EQ(optimization::combined(Combination::read(text), {-3.}, {1.}).value, -3.);
  for (const auto *text : {"range", "deviation"})
    {
      const auto found = optimization::combined(Combination::read(text), {-3.}, {1.});
      EXPECT_EQ(found.value, 0.);
      EXPECT_EQ(found.factors, Numbers{0.});
    }
}

TEST(Combination, IsReadFromTextAndPrinted)
{
  for (const std::string text :
       {"sum", "mean", "worst", "range", "deviation", "2 deviation", "mean + 0.5 deviation"})
    EXPECT_EQ(Combination::read(text).text(), text);
  for (const auto *text : {"", "least", "mean +", "-1 deviation", "mean + deviation 2", "2 mean"})
    EXPECT_THROW(Combination::read(text), std::invalid_argument) << text;
}
} // namespace
