#include <snug/shape/spline.h>

#include <gtest/gtest.h>

#include <cmath>

namespace snug {
namespace {
using shape::Spline;
using shape::SplineNet;

double bernstein(unsigned int n, unsigned int j, double s)
{
  double binomial = 1.;
  for (unsigned int i = 1; i <= j; ++i)
    binomial *= (n - i) / double(i);
  return binomial * std::pow(s, j) * std::pow(1. - s, n - 1 - j);
}

const std::vector<double> places = {0., 1e-9, 0.2, 0.5, 0.61, 1. - 1e-12, 1.};

TEST(Spline, SumsToOneAndIsNotNegative)
{
  for (unsigned int degree = 0; degree < 5; ++degree)
    for (unsigned int n = degree + 1; n < 9; ++n)
      for (const double s : places)
        {
          const auto values = Spline(n, degree).values(s);
          double     sum    = 0.;
          ASSERT_EQ(values.second.size(), degree + 1);
          ASSERT_LE(values.first + degree, n - 1);
          for (const double value : values.second)
            {
              EXPECT_GE(value, 0.);
              sum += value;
            }
          EXPECT_NEAR(sum, 1., 1e-15);
        }
}

TEST(Spline, OfOneSpanIsBernstein)
{
  for (unsigned int n = 1; n < 9; ++n)
    for (const double s : places)
      {
        const auto values = Spline(n, n - 1).values(s);
        EXPECT_EQ(values.first, 0u);
        for (unsigned int j = 0; j < n; ++j)
          EXPECT_NEAR(values.second[j], bernstein(n, j, s), 1e-15);
      }
}

TEST(Spline, ReproducesTheCoordinateFromGrevilleAbscissae)
{
  for (unsigned int degree = 1; degree < 5; ++degree)
    for (unsigned int n = degree + 1; n < 9; ++n)
      for (const double s : places)
        {
          const Spline spline(n, degree);
          const auto   values = spline.values(s);
          double       sum    = 0.;
          for (unsigned int k = 0; k <= degree; ++k)
            sum += values.second[k] * spline.greville(values.first + k);
          EXPECT_NEAR(sum, s, 1e-15);
        }
}

/// Degree p has p - 1 continuous derivatives: a jump of the first one
/// would be of the size of the derivative, here about 1 over 1e-6.
TEST(Spline, IsSmoothAcrossItsKnots)
{
  const Spline spline(6, 3); // knots at 1/3 and 2/3
  const double h     = 1e-4;
  const auto   value = [&](double s, unsigned int i) {
    const auto values = spline.values(s);
    return i < values.first || i > values.first + 3 ? 0. : values.second[i - values.first];
  };
  for (unsigned int i = 0; i < 6; ++i)
    {
      const double second =
        (value(1. / 3 + h, i) - 2 * value(1. / 3, i) + value(1. / 3 - h, i)) / (h * h);
      EXPECT_LT(std::abs(second), 100.);
    }
  EXPECT_GT(value(1. / 3, 2), 0.1);
}

TEST(SplineNet, RunsTheFirstAxisFastest)
{
  const SplineNet net({3, 4}, 0);
  ASSERT_EQ(net.n_points(), 12u);
  const auto values = net.values({0.3, 0.8});
  ASSERT_EQ(values.size(), 12u);
  for (const auto &value : values)
    EXPECT_NEAR(value.second,
                bernstein(3, value.first % 3, 0.3) * bernstein(4, value.first / 3, 0.8), 1e-15);
  EXPECT_EQ(net.greville(7), (std::vector<double>{0.5, 2. / 3}));
  EXPECT_TRUE(net.on_side(2, 0, 1));
  EXPECT_TRUE(net.on_side(2, 1, 0));
  EXPECT_FALSE(net.on_border(4));
  EXPECT_TRUE(net.on_border(6));
}

TEST(SplineNet, IsConstantAlongAnAxisWithOnePoint)
{
  const SplineNet net({6, 1}, 3);
  const SplineNet along({6}, 3);
  ASSERT_EQ(net.n_points(), 6u);
  for (const double s : {0., 0.3, 0.77, 1.})
    for (const double t : {0., 0.4, 1.})
      EXPECT_EQ(net.values({s, t}), along.values({s}));
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_EQ(net.on_border(i), i == 0 || i == 5);
}

TEST(SplineNet, HasLocalSupport)
{
  const SplineNet net({10, 8, 6}, 2);
  EXPECT_EQ(net.values({0.5, 0.5, 0.1}).size(), 27u);
  EXPECT_EQ(net.n_points(), 480u);
}
} // namespace
} // namespace snug
