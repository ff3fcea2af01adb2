#include <snug/app/warm_start_extrapolation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace snug;
using app::WarmStartExtrapolation;

namespace {
/// Forces on three rows, smooth in two variables.
std::vector<qp::MultiVector> forces(const std::vector<double> &x, const double curvature)
{
  qp::MultiVector lambda(3);
  lambda(0) = 2. + 3. * x[0] - x[1];
  lambda(1) = 1. - x[0] + curvature * x[0] * x[1];
  lambda(2) = curvature * std::sin(x[1]);
  return {lambda, lambda};
}

double
error(const WarmStartExtrapolation &history, const std::vector<double> &x, const double curvature)
{
  const auto starts = history.at(x);
  const auto exact  = forces(x, curvature);
  double     worst  = 0.;
  for (unsigned int i = 0; i < 3; ++i)
    worst = std::max(worst, std::abs(starts.back().lambda(i) - exact.back()(i)));
  return worst;
}

/// Return the history of three designs at the distance @p h from (0.4, 0.2).
WarmStartExtrapolation around(const double h, const double curvature)
{
  WarmStartExtrapolation history({1., 1.});
  for (const auto &x : {std::vector<double>{0.4, 0.2}, {0.4 + h, 0.2}, {0.4, 0.2 + h}})
    history.add(x, forces(x, curvature));
  return history;
}
} // namespace

TEST(WarmStartExtrapolation, IsColdWithoutDesigns)
{
  EXPECT_TRUE(WarmStartExtrapolation({1.}).at({0.5}).empty());
}

TEST(WarmStartExtrapolation, OneDesignGivesItsForces)
{
  WarmStartExtrapolation history({1., 2.});
  history.add({0.1, 0.2}, forces({0.1, 0.2}, 1.));
  const auto starts = history.at({0.7, 0.9});
  ASSERT_EQ(starts.size(), 2u);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_EQ(starts[1].lambda(i), forces({0.1, 0.2}, 1.)[1](i));
}

/// A warm start of the design itself, also among nearer ones than rounding tells apart.
TEST(WarmStartExtrapolation, ADesignSolvedBeforeGivesItsForces)
{
  WarmStartExtrapolation history = around(1e-9, 1.);
  EXPECT_EQ(error(history, {0.4, 0.2 + 1e-9}, 1.), 0.);
}

/// The second term of the coefficients is of second order, as what a linear model leaves.
TEST(WarmStartExtrapolation, IsExactToSecondOrder)
{
  const auto at = [](const double h) { return std::vector<double>{0.4 + 0.6 * h, 0.2 + 0.7 * h}; };
  const double coarse = error(around(1e-1, 1.), at(1e-1), 1.);
  const double fine   = error(around(1e-2, 1.), at(1e-2), 1.);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_GT(coarse, 1e-4);
  EXPECT_NEAR(std::log10(coarse / fine), 2., 0.1);
}

/// A line search extrapolates by the secant between its ends, up to the error of the forces.
TEST(WarmStartExtrapolation, IsASecantOnALine)
{
  for (const double length : {1e-1, 1e-2, 1e-3})
    {
      const auto at = [&](const double t) { return std::vector<double>{0.4 + t, 0.2 - t}; };
      WarmStartExtrapolation history({1., 1.});
      for (const double t : {0., length})
        history.add(at(t), forces(at(t), 0.));
      // (length^2)^2 of the second term over length^2 of the first one
      EXPECT_LT(error(history, at(0.3 * length), 0.),
                4. * length * (length * length + 2e-6 / length));
    }
}

/// Designs closer than their forces are known tell no slope: they would multiply their errors.
TEST(WarmStartExtrapolation, DoesNotMultiplyErrors)
{
  WarmStartExtrapolation history({1., 1.});
  for (unsigned int i = 0; i < 6; ++i)
    {
      const std::vector<double> x{0.4 + 1e-11 * i, 0.2 + 1e-13 * i * i};
      auto                      noisy = forces(x, 1.);
      noisy.back()(0) += i % 2 == 0 ? 1e-6 : -1e-6;
      history.add(x, noisy);
    }
  EXPECT_LT(error(history, {0.4 + 1e-9, 0.2}, 1.), 2e-6);
}

TEST(WarmStartExtrapolation, TakesVariablesThatMoveNothing)
{
  // the unit of such a variable, as Shapes::first_steps() returns it
  WarmStartExtrapolation history({1., std::numeric_limits<double>::max()});
  for (const double t : {0.1, 0.2})
    history.add({t, 0.5}, forces({t, 0.5}, 0.));
  EXPECT_LT(error(history, {0.15, 0.5}, 0.), 1e-2);
}

TEST(WarmStartExtrapolation, ForgetsTheOldest)
{
  WarmStartExtrapolation history({1., 1.});
  history.add({0.5, 0.5}, forces({0.5, 0.5}, 1.));
  for (unsigned int i = 0; i < 20; ++i)
    history.add({0.01 * i, 0.}, forces({0.01 * i, 0.}, 1.));
  EXPECT_GT(error(history, {0.5, 0.5}, 1.), 1e-3);
}

TEST(WarmStartExtrapolation, GoesOnFromItsBytesBitForBit)
{
  const auto             history = around(1e-2, 1.);
  WarmStartExtrapolation other({1., 1.});
  ASSERT_TRUE(other.read(history.bytes(), {3, 3}));
  const auto a = history.at({0.41, 0.23}), b = other.at({0.41, 0.23});
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_EQ(a[0].lambda(i), b[0].lambda(i));
  EXPECT_FALSE(other.read(history.bytes(), {3, 4}));
  EXPECT_TRUE(other.at({0.41, 0.23}).empty());
  EXPECT_FALSE(other.read(history.bytes().substr(1), {3, 3}));
  EXPECT_TRUE(other.read("", {3, 3}));
  EXPECT_TRUE(other.at({0.41, 0.23}).empty());
}
