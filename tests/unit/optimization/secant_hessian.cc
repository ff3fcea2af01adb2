#include <snug/optimization/dense_vectors.h>
#include <snug/optimization/secant_hessian.h>

#include <gtest/gtest.h>

#include "problems.h"

#include <random>

using namespace snug::optimization;

namespace {
using Vector = std::vector<double>;

/// A diagonal Hessian whose entries are @p d.
Vector times(const Vector &d, const Vector &v)
{
  Vector result(v);
  for (unsigned int i = 0; i < v.size(); ++i)
    result[i] *= d[i];
  return result;
}
} // namespace

TEST(SecantHessian, HasTheCurvatureOfItsLastStep)
{
  std::mt19937  random(11);
  const Vector  curvatures = {1e-2, 1., 3., 1e3};
  SecantHessian B(4, 4);
  EXPECT_FALSE(B.is_measured());
  B.guess(7.);
  EXPECT_EQ(B.times({1., 2., 0., 0.}), (Vector{7., 14., 0., 0.}));
  EXPECT_FALSE(B.is_measured());
  for (unsigned int k = 0; k < 40; ++k)
    {
      const auto s = random_vector(random, 4), y = times(curvatures, s);
      const bool is_plain = dot(y, s) >= 0.2 * dot(s, B.times(s)); // nothing is damped
      B.update(s, y);
      EXPECT_TRUE(B.is_measured());
      for (unsigned int i = 0; is_plain && i < 4; ++i)
        EXPECT_NEAR(B.times(s)[i], y[i], 1e-10 * norm(y)) << k;
    }
}

TEST(SecantHessian, StaysPositiveWhateverIsMeasured)
{
  std::mt19937  random(5);
  SecantHessian B(6, 6);
  for (unsigned int k = 0; k < 60; ++k)
    {
      B.update(random_vector(random, 6), random_vector(random, 6));
      for (unsigned int trial = 0; trial < 20; ++trial)
        {
          const auto d = random_vector(random, 6);
          EXPECT_GT(dot(d, B.times(d)), 0.) << k;
        }
    }
}

TEST(SecantHessian, IsRaisedAlongADirectionAlone)
{
  SecantHessian B(3, 3);
  B.guess(2.);
  B.raise({0., 3., 0.}, 45.);
  EXPECT_EQ(B.times({1., 1., 1.}), (Vector{2., 5., 2.}));
  B.raise({0., 3., 0.}, 9.); // it has more
  EXPECT_EQ(B.times({1., 1., 1.}), (Vector{2., 5., 2.}));
}

/// Without a measured curvature in between the two that a step and a change saw, no scale is right.
TEST(SecantHessian, FirstStepSetsTheScaleOfAllDirections)
{
  SecantHessian B(3, 3);
  B.guess(1e-6);
  B.update({1., 0., 0.}, {100., 0., 0.});
  EXPECT_NEAR(B.times({1., 0., 0.})[0], 100., 1e-10);
  EXPECT_NEAR(B.times({0., 1., 0.})[1], 100., 1e-10);
}
