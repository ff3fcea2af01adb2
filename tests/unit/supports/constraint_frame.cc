#include <snug/supports/constraint_frame.h>

#include <deal.II/base/point.h>

#include <gtest/gtest.h>

#include <random>

namespace {
using namespace snug;
using supports::ConstraintFrame;
using supports::Orthonormalised;

/// Random unit vectors and values of two load cases.
template <int dim>
ConstraintFrame<dim> random_frame(unsigned int n, unsigned int seed, bool unit)
{
  std::mt19937                           generator(seed);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  ConstraintFrame<dim>                   frame;
  for (unsigned int j = 0; j < n; ++j)
    {
      dealii::Tensor<1, dim> d;
      for (unsigned int c = 0; c < dim; ++c)
        d[c] = uniform(generator);
      frame.directions.push_back(unit ? d / d.norm() : d);
      frame.values.push_back({uniform(generator), uniform(generator)});
    }
  return frame;
}

template <int dim>
ConstraintFrame<dim>
moved(ConstraintFrame<dim> frame, const ConstraintFrame<dim> &velocity, double step)
{
  for (unsigned int j = 0; j < frame.directions.size(); ++j)
    {
      frame.directions[j] += step * velocity.directions[j];
      for (unsigned int c = 0; c < 2; ++c)
        frame.values[j][c] += step * velocity.values[j][c];
    }
  return frame;
}

/// q_k . u - s_k of load case c.
template <int dim>
double residual(const ConstraintFrame<dim>   &frame,
                unsigned int                  k,
                unsigned int                  c,
                const dealii::Tensor<1, dim> &u)
{
  return frame.directions[k] * u - frame.values[k][c];
}

template <int dim>
void check(unsigned int n)
{
  const auto                 given = random_frame<dim>(n, 7, true);
  const Orthonormalised<dim> constraints(given);
  const auto                &frame = constraints.frame();
  ASSERT_GT(constraints.independence(), 0.1);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int k = 0; k < n; ++k)
      EXPECT_NEAR(frame.directions[j] * frame.directions[k], double(j == k), 1e-13);

  // u that meets the orthonormal constraints meets the given ones
  for (unsigned int c = 0; c < 2; ++c)
    {
      dealii::Tensor<1, dim> u;
      for (unsigned int k = 0; k < n; ++k)
        u += frame.values[k][c] * frame.directions[k];
      for (unsigned int k = 0; k < n; ++k)
        EXPECT_NEAR(residual(given, k, c, u), 0., 1e-13);
    }

  // derivatives against differences; multipliers: the energy they give
  const auto           velocity   = random_frame<dim>(n, 5, false);
  const auto           derivative = constraints.derivative(velocity);
  const double         step       = 1e-3;
  const int            place[]    = {-2, -1, 1, 2};
  const double         weight[]   = {1. / 12., -8. / 12., 8. / 12., -1. / 12.};
  ConstraintFrame<dim> difference = frame;
  for (unsigned int j = 0; j < n; ++j)
    {
      difference.directions[j] = dealii::Tensor<1, dim>();
      difference.values[j]     = {0., 0.};
    }
  for (unsigned int p = 0; p < 4; ++p)
    difference =
      moved(difference, Orthonormalised<dim>(moved(given, velocity, place[p] * step)).frame(),
            weight[p] / step);
  const auto multipliers = random_frame<2>(n, 6, false);
  for (unsigned int c = 0; c < 2; ++c)
    {
      dealii::Tensor<1, dim> u;
      for (unsigned int k = 0; k < n; ++k)
        u += frame.values[k][c] * frame.directions[k];
      std::vector<double> m;
      double              slope = 0.;
      for (unsigned int k = 0; k < n; ++k)
        {
          EXPECT_LT((derivative.directions[k] - difference.directions[k]).norm(), 1e-8);
          EXPECT_NEAR(derivative.values[k][c], difference.values[k][c], 1e-8);
          m.push_back(multipliers.values[k][c]);
          slope += m[k] * residual(derivative, k, c, u);
        }
      const auto of_given = constraints.given_multipliers(m);
      for (unsigned int k = 0; k < n; ++k)
        slope -= of_given[k] * residual(velocity, k, c, u);
      EXPECT_NEAR(slope, 0., 1e-12);
    }
}

TEST(ConstraintFrame, IsOrthonormalWithExactDerivatives)
{
  check<2>(1);
  check<2>(2);
  check<3>(2);
  check<3>(3);
}

TEST(ConstraintFrame, NoticesDependence)
{
  ConstraintFrame<2> frame;
  frame.directions = {dealii::Point<2>(1., 0.), dealii::Point<2>(0.6, 0.8)};
  frame.values     = {{0.}, {0.}};
  EXPECT_NEAR(Orthonormalised<2>(frame).independence(), 0.8, 1e-15);
  frame.directions[1] = dealii::Point<2>(-1., 0.);
  EXPECT_EQ(Orthonormalised<2>(frame).independence(), 0.);
}
} // namespace
