#include "cells.h"

#include <snug/elasticity/finite_difference.h>

using namespace elasticity_cells;

template <typename Case>
class ElementDerivatives : public ::testing::Test
{
public:
  static constexpr int          dim    = Case::dim;
  static constexpr unsigned int degree = Case::degree;

  const Element<dim> element{degree};
  const Nodes<dim>   X = distorted<dim>(degree, 11);
  const Nodes<dim>   V = random_field<dim>(X.size(), 12);
  const Nodes<dim>   u = random_field<dim>(X.size(), 13);
  const Nodes<dim>   w = random_field<dim>(X.size(), 14);
  /// a force density
  const dealii::Tensor<1, dim> b = random_field<dim>(1, 15)[0];

  Nodes<dim>
  force(const Nodes<dim> &positions, const Nodes<dim> &displacements) const
  {
    Nodes<dim> r;
    element.internal_force(positions, material, displacements, r);
    return r;
  }

  Nodes<dim>
  force_derivative(const Nodes<dim> &velocity) const
  {
    Nodes<dim> r;
    element.internal_force_derivative(X, velocity, material, u, r);
    return r;
  }
};
TYPED_TEST_SUITE(ElementDerivatives, AllCases);

TYPED_TEST(ElementDerivatives, InternalForceAgreesWithDifferences)
{
  constexpr int dim = TestFixture::dim;
  const auto    expected =
    derivative<dim>([this](
                      const Nodes<dim> &X) { return this->force(X, this->u); },
                    this->X,
                    this->V);
  EXPECT_LT(distance<dim>(this->force_derivative(this->V), expected),
            1e-9 * norm<dim>(expected));
}

TYPED_TEST(ElementDerivatives, TranslationChangesNothing)
{
  constexpr int dim = TestFixture::dim;
  Nodes<dim>    V(this->X.size());
  for (auto &vector : V)
    vector = this->b;
  EXPECT_LT(norm<dim>(this->force_derivative(V)),
            1e-13 * norm<dim>(this->force_derivative(this->V)));
}

TYPED_TEST(ElementDerivatives, RotationTurnsTheStiffness)
{
  // K(R X) = R K R^T, so V = W X with W skew gives K' = W K - K W
  constexpr int dim   = TestFixture::dim;
  const auto    W     = random_skew<dim>(16);
  const auto expected = sum<dim>(times<dim>(W, this->force(this->X, this->u)),
                                 -1.,
                                 this->force(this->X, times<dim>(W, this->u)));
  EXPECT_LT(distance<dim>(this->force_derivative(times<dim>(W, this->X)),
                          expected),
            1e-13 * norm<dim>(expected));
}

TYPED_TEST(ElementDerivatives, StretchScalesTheStiffness)
{
  // K ~ length^(dim-2)
  constexpr int dim      = TestFixture::dim;
  const auto    force    = this->force(this->X, this->u);
  const auto    expected = sum<dim>(Nodes<dim>(force.size()), dim - 2., force);
  EXPECT_LT(distance<dim>(this->force_derivative(this->X), expected),
            1e-13 * norm<dim>(force));
}

TYPED_TEST(ElementDerivatives, EnergyGradientIsTheTranspose)
{
  constexpr int dim    = TestFixture::dim;
  const double  factor = 0.5;
  const auto    start  = random_field<dim>(this->X.size(), 17);

  auto gradient = start;
  this->element.add_energy_gradient(
    this->X, material, this->u, this->w, factor, gradient);
  gradient = sum<dim>(gradient, -1., start);
  EXPECT_NEAR(dot<dim>(gradient, this->V),
              factor * dot<dim>(this->w, this->force_derivative(this->V)),
              1e-13 * norm<dim>(gradient) * norm<dim>(this->V));

  auto swapped = start;
  this->element.add_energy_gradient(
    this->X, material, this->w, this->u, factor, swapped);
  EXPECT_LT(distance<dim>(sum<dim>(swapped, -1., start), gradient),
            1e-13 * norm<dim>(gradient));
}

TYPED_TEST(ElementDerivatives, BodyForceAgreesWithDifferences)
{
  constexpr int dim = TestFixture::dim;
  Nodes<dim>    found;
  this->element.body_force_derivative(this->X, this->V, this->b, found);
  const auto expected = derivative<dim>(
    [this](const Nodes<dim> &X) {
      Nodes<dim> f;
      this->element.body_force(X, this->b, f);
      return f;
    },
    this->X,
    this->V);
  EXPECT_LT(distance<dim>(found, expected), 1e-10 * norm<dim>(expected));

  Nodes<dim> gradient(this->X.size());
  this->element.add_body_force_gradient(
    this->X, this->b, this->u, 2., gradient);
  EXPECT_NEAR(dot<dim>(gradient, this->V),
              2. * dot<dim>(found, this->u),
              1e-13 * norm<dim>(gradient) * norm<dim>(this->V));
}

TYPED_TEST(ElementDerivatives, VolumeGradient)
{
  // Agrees with differences, and is the area vector of the boundary.
  constexpr int dim = TestFixture::dim;
  Nodes<dim>    gradient(this->X.size());
  this->element.add_volume_gradient(this->X, 1., gradient);
  const double expected = derivative<double>([this](const double t) {
    return this->element.volume(sum<dim>(this->X, t, this->V));
  });
  EXPECT_NEAR(dot<dim>(gradient, this->V), expected, 1e-10);
  EXPECT_LT(distance<dim>(gradient,
                          boundary_normals<dim>(TestFixture::degree, this->X)),
            1e-13 * norm<dim>(gradient));
}

TYPED_TEST(ElementDerivatives, CentralDifferenceIsOfSecondOrder)
{
  constexpr int dim   = TestFixture::dim;
  const auto    exact = this->force_derivative(this->V);
  const auto    error = [&](const double step) {
    const auto approximation = central_difference<dim>(
      [this](const Nodes<dim> &X, Nodes<dim> &f) {
        f = this->force(X, this->u);
      },
      this->X,
      this->V,
      step);
    return distance<dim>(approximation, exact) / norm<dim>(exact);
  };
  EXPECT_NEAR(error(2e-3) / error(1e-3), 4., 0.05);
  EXPECT_LT(error(1e-5), 1e-8);
}
