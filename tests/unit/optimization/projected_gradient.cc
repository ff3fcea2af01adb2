#include <snug/optimization/projected_gradient.h>

#include <gtest/gtest.h>

#include "problems.h"

#include <algorithm>
#include <cmath>
#include <random>

using namespace snug::optimization;

namespace {
double projected_norm(const std::vector<double> &r, const std::vector<BoundState> &at_bounds)
{
  double sum = 0.;
  for (unsigned int i = 0; i < r.size(); ++i)
    if (at_bounds[i] == BoundState::inside || (at_bounds[i] == BoundState::at_lower && r[i] < 0.) ||
        (at_bounds[i] == BoundState::at_upper && r[i] > 0.))
      sum += r[i] * r[i];
  return std::sqrt(sum);
}
double norm_of(const std::vector<double>             &g,
               const std::vector<ConstraintGradient> &constraint_gradients,
               const std::vector<BoundState>         &at_bounds)
{
  return projected_gradient(g, constraint_gradients, at_bounds).norm;
}
} // namespace

TEST(ProjectedGradient, IsZeroAtAPointOfKarushKuhnAndTucker)
{
  std::mt19937            random(3);
  const auto              row_0 = random_vector(random, 20);
  const auto              row_1 = random_vector(random, 20);
  auto                    g     = random_vector(random, 20);
  std::vector<BoundState> at_bounds(20, BoundState::inside);
  for (unsigned int i = 0; i < 20; ++i)
    {
      const double sign = i < 5 ? 1. : i < 9 ? -1. : 0.;
      at_bounds[i]      = i < 5    ? BoundState::at_lower
                          : i < 9  ? BoundState::at_upper
                          : i < 10 ? BoundState::fixed
                                   : BoundState::inside;
      g[i]              = 3. * row_0[i] - 2. * row_1[i] + (i == 9 ? 11. : sign * std::abs(g[i]));
    }
  EXPECT_NEAR(norm_of(g, {{row_0, false}, {row_1, false}}, at_bounds), 0., 1e-13);
  // a dependent row changes nothing
  EXPECT_NEAR(norm_of(g, {{row_0, false}, {row_1, false}, {row_0, false}}, at_bounds), 0., 1e-13);
  // a bound multiplier of the wrong sign does
  g[2] -= 50. * std::abs(g[2]) + 50.;
  EXPECT_GT(norm_of(g, {{row_0, false}, {row_1, false}}, at_bounds), 1.);
}

TEST(ProjectedGradient, IsTheMinimumOverTheMultiplier)
{
  // Compared with a scan over mu, bounds at random.
  std::mt19937 random(5);
  for (unsigned int sample = 0; sample < 20; ++sample)
    {
      const auto              g = random_vector(random, 12);
      const auto              a = random_vector(random, 12);
      std::vector<BoundState> at_bounds(12);
      for (BoundState &place : at_bounds)
        place = static_cast<BoundState>(random() % 4);
      double scanned = 1e300;
      for (double mu = -50.; mu < 50.; mu += 1e-3)
        {
          auto r = g;
          for (unsigned int i = 0; i < r.size(); ++i)
            r[i] += mu * a[i];
          scanned = std::min(scanned, projected_norm(r, at_bounds));
        }
      const double computed = norm_of(g, {{a, false}}, at_bounds);
      EXPECT_LE(computed, scanned + 1e-12);
      // the scan is off by half a step of 1e-3 at most
      EXPECT_NEAR(computed, scanned, 4e-3);
    }
}

TEST(ProjectedGradient, InequalitiesOnlyPush)
{
  std::mt19937                  random(11);
  const std::vector<BoundState> at_bounds(6, BoundState::inside);
  const auto                    a = random_vector(random, 6);
  std::vector<double>           against(6), along(6);
  for (unsigned int i = 0; i < 6; ++i)
    {
      against[i] = -2. * a[i];
      along[i]   = 2. * a[i];
    }
  // the descent -g leads out of c <= 0, or into it
  EXPECT_NEAR(norm_of(against, {{a, true}}, at_bounds), 0., 1e-14);
  EXPECT_DOUBLE_EQ(norm_of(along, {{a, true}}, at_bounds), norm_of(along, {}, at_bounds));
  EXPECT_NEAR(norm_of(along, {{a, false}}, at_bounds), 0., 1e-14);
}

TEST(ProjectedGradient, WithoutConstraintsOrBoundsIsTheNorm)
{
  EXPECT_DOUBLE_EQ(norm_of({3., -4.}, {}, {BoundState::inside, BoundState::inside}), 5.);
  EXPECT_DOUBLE_EQ(norm_of({3., -4.}, {}, {BoundState::at_lower, BoundState::at_upper}), 0.);
  EXPECT_DOUBLE_EQ(norm_of({}, {}, {}), 0.);
}
