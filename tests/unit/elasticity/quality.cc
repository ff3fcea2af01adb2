#include "cells.h"

#include <limits>

using namespace elasticity_cells;

template <typename Case>
class Quality : public ::testing::Test
{
public:
  static constexpr int          dim    = Case::dim;
  static constexpr unsigned int degree = Case::degree;

  const Element<dim> element{degree};
  const Nodes<dim>   cube = elasticity_cells::cube<dim>(degree);

  /// A regular matrix with positive determinant, strongly sheared.
  dealii::Tensor<2, dim> shear() const
  {
    auto A = random_matrix<dim>(41);
    for (unsigned int d = 0; d < dim; ++d)
      A[d][d] = 2. + 3. * d;
    return A;
  }
};
TYPED_TEST_SUITE(Quality, AllCases);

TYPED_TEST(Quality, IsOneForParallelepipeds)
{
  constexpr int dim = TestFixture::dim;
  const auto    X   = times<dim>(this->shear(), this->cube);
  EXPECT_NEAR(this->element.quality(X), 1., 1e-14);
  EXPECT_NEAR(this->element.volume(X), determinant(this->shear()),
              1e-14 * determinant(this->shear()));
}

TYPED_TEST(Quality, DoesNotDependOnUnitsOrAffineMaps)
{
  constexpr int dim = TestFixture::dim;
  const auto    X   = distorted<dim>(TestFixture::degree, 42);
  const double  q   = this->element.quality(X);
  EXPECT_GT(q, 0.);
  EXPECT_LT(q, 1.);
  EXPECT_NEAR(this->element.quality(times<dim>(this->shear(), X)), q, 1e-13);
  EXPECT_NEAR(this->element.quality(sum<dim>(Nodes<dim>(X.size()), 1e-6, X)), q, 1e-13);
}

TYPED_TEST(Quality, ScaledJacobianIsTheSineOfParallelograms)
{
  constexpr int          dim = TestFixture::dim;
  dealii::Tensor<2, dim> A;
  for (unsigned int d = 0; d < dim; ++d)
    A[d][d] = 1. + 7. * d;
  EXPECT_NEAR(this->element.scaled_jacobian(times<dim>(A, this->cube)), 1., 1e-14);
  // the first edge turned by 60 degrees towards the second
  A[0][0] = 3. * std::cos(dealii::numbers::PI / 3.);
  A[1][0] = 3. * std::sin(dealii::numbers::PI / 3.);
  EXPECT_NEAR(this->element.scaled_jacobian(times<dim>(A, this->cube)),
              std::cos(dealii::numbers::PI / 3.), 1e-14);
}

TYPED_TEST(Quality, DistortionHasItsDerivatives)
{
  constexpr int dim   = TestFixture::dim;
  const auto    X     = distorted<dim>(TestFixture::degree, 42);
  const auto    V     = distorted<dim>(TestFixture::degree, 43);
  const double  worst = 1. - this->element.scaled_jacobian(X);
  // the p-norm of values from 0 to 1: the larger p, the nearer to the largest
  EXPECT_NEAR(std::pow(this->element.distortion(X, 900., worst), 1. / 900.), 1., 1e-2);
  for (const double p : {1., 2., 8.})
    {
      const double value = this->element.distortion(X, p, worst);
      EXPECT_GE(value, 1. - 1e-12);
      EXPECT_NEAR(this->element.distortion(X, p, 2. * worst), value / std::pow(2., p),
                  1e-12 * value);
      Nodes<dim> gradient(X.size());
      this->element.add_distortion_gradient(X, p, worst, 3., gradient);
      const double h          = 1e-5;
      const double difference = this->element.distortion(sum<dim>(X, h, V), p, worst) -
                                this->element.distortion(sum<dim>(X, -h, V), p, worst);
      EXPECT_NEAR(dot<dim>(gradient, V), 3. * difference / (2. * h),
                  1e-6 * (1. + std::abs(difference) / h))
        << p;
    }
  EXPECT_NEAR(this->element.distortion(this->cube, 2., 1.), 0., 1e-28);
}

TYPED_TEST(Quality, FindsTangledCells)
{
  constexpr int dim      = TestFixture::dim;
  auto          mirrored = this->cube;
  for (auto &x : mirrored)
    x[0] = -x[0];
  EXPECT_NEAR(this->element.quality(mirrored), -1., 1e-14);

  // a corner pushed through the opposite diagonal
  auto folded = this->cube;
  for (unsigned int d = 0; d < dim; ++d)
    folded[0][d] = 0.8;
  EXPECT_LT(this->element.quality(folded), 0.);
  EXPECT_LT(this->element.scaled_jacobian(folded), 0.);

  auto twisted = this->cube;
  std::swap(twisted[0], twisted[TestFixture::degree]);
  EXPECT_LT(this->element.quality(twisted), 0.);
}

TYPED_TEST(Quality, IsZeroWithoutVolume)
{
  constexpr int dim  = TestFixture::dim;
  auto          flat = this->cube;
  for (auto &x : flat)
    x[dim - 1] = 0.;
  EXPECT_EQ(this->element.quality(flat), 0.);
  EXPECT_EQ(this->element.scaled_jacobian(flat), 0.);

  auto invalid  = this->cube;
  invalid[0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(this->element.quality(invalid), 0.);
  EXPECT_EQ(this->element.scaled_jacobian(invalid), 0.);
}

TEST(QuarterPoint, MidNodesMayNotReachTheQuarterPoint)
{
  // x(xi) through 0, m, 1 has x'(0) = 4 m - 1
  const Element<2> element(2);
  const auto       quality = [&](const double m) {
    auto X = cube<2>(2);
    for (const unsigned int a : {1, 4, 7})
      X[a][0] = m;
    return element.quality(X);
  };
  EXPECT_NEAR(quality(0.3), 0.2, 1e-14);
  EXPECT_NEAR(quality(0.25), 0., 1e-14);
  EXPECT_LT(quality(0.2), 0.);
}

TYPED_TEST(Quality, AspectIsTheRatioOfTheLongestAxisToTheShortest)
{
  constexpr int          dim = TestFixture::dim;
  dealii::Tensor<2, dim> A;
  for (unsigned int d = 0; d < dim; ++d)
    A[d][d] = 2. + 7. * d;
  const double expected = A[dim - 1][dim - 1] / A[0][0];
  EXPECT_NEAR(this->element.aspect(this->cube), 1., 1e-14);
  EXPECT_NEAR(this->element.aspect(times<dim>(A, this->cube)), expected, 1e-13);
  // a turn by 30 degrees, another unit
  dealii::Tensor<2, dim> Q   = dealii::unit_symmetric_tensor<dim>();
  const double           sin = 0.5, cos = std::sqrt(0.75);
  Q[0][0] = Q[1][1] = 1e-6 * cos;
  Q[1][0]           = 1e-6 * sin;
  Q[0][1]           = -Q[1][0];
  for (unsigned int d = 2; d < dim; ++d)
    Q[d][d] = 1e-6;
  EXPECT_NEAR(this->element.aspect(times<dim>(Q * A, this->cube)), expected, 1e-13);
}
