#include "cells.h"

using namespace elasticity_cells;

template <typename Case>
class ElementDerivatives : public ::testing::Test
{
public:
  static constexpr int          dim    = Case::dim;
  static constexpr unsigned int degree = Case::degree;

  const std::vector<TestElement<dim>> elements = all_elements<dim>(degree, 11);
  const std::size_t                   n        = elements[0].X.size();
  const Nodes<dim>                    V        = random_field<dim>(n, 12);
  const Nodes<dim>                    u        = random_field<dim>(n, 13);
  const Nodes<dim>                    w        = random_field<dim>(n, 14);
  /// a force density at the Gauss points, which are as many as the nodes
  const Nodes<dim> b = random_field<dim>(n, 15);

  Nodes<dim>
  force(const Element<dim> &element, const Nodes<dim> &X, const Nodes<dim> &displacements) const
  {
    Nodes<dim> r;
    element.internal_force(X, material, displacements, r);
    return r;
  }

  /// K'(X; velocity) u.
  Nodes<dim> force_derivative(const TestElement<dim> &of, const Nodes<dim> &velocity) const
  {
    return of.element.internal_force_derivatives(of.X, {velocity}, material, u).front();
  }
};
TYPED_TEST_SUITE(ElementDerivatives, AllCases);

TYPED_TEST(ElementDerivatives, InternalForceAgreesWithDifferences)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    {
      const auto expected =
        derivative<dim>([&](const Nodes<dim> &X) { return this->force(of.element, X, this->u); },
                        of.X, this->V);
      EXPECT_LT(distance<dim>(this->force_derivative(of, this->V), expected),
                1e-9 * norm<dim>(expected))
        << of.name();
    }
}

TYPED_TEST(ElementDerivatives, TranslationChangesNothing)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    {
      Nodes<dim> V(this->n);
      for (auto &vector : V)
        for (unsigned int c = 0; c < dim; ++c)
          vector[c] = of.may_translate(c) ? this->b[0][c] : 0.;
      EXPECT_LT(norm<dim>(this->force_derivative(of, V)),
                1e-13 * norm<dim>(this->force_derivative(of, this->V)))
        << of.name();
    }
}

TYPED_TEST(ElementDerivatives, RotationTurnsTheStiffness)
{
  // K(R X) = R K R^T, so V = W X with W skew gives K' = W K - K W
  constexpr int dim = TestFixture::dim;
  const auto    W   = random_skew<dim>(16);
  for (const auto &of : this->elements)
    if (!of.idealization.is_axisymmetric())
      {
        const auto expected = sum<dim>(times<dim>(W, this->force(of.element, of.X, this->u)), -1.,
                                       this->force(of.element, of.X, times<dim>(W, this->u)));
        EXPECT_LT(distance<dim>(this->force_derivative(of, times<dim>(W, of.X)), expected),
                  1e-13 * norm<dim>(expected))
          << of.name();
      }
}

TYPED_TEST(ElementDerivatives, StretchScalesTheStiffness)
{
  // K ~ length for solids, in whole or as bodies of revolution; else length^0
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    {
      const bool solid    = dim == 3 || of.idealization.is_axisymmetric();
      const auto force    = this->force(of.element, of.X, this->u);
      const auto expected = sum<dim>(Nodes<dim>(force.size()), solid ? 1. : 0., force);
      EXPECT_LT(distance<dim>(this->force_derivative(of, of.X), expected), 1e-13 * norm<dim>(force))
        << of.name();
    }
}

TYPED_TEST(ElementDerivatives, EnergyGradientIsTheTranspose)
{
  constexpr int dim    = TestFixture::dim;
  const double  factor = 0.5;
  const auto    start  = random_field<dim>(this->n, 17);
  for (const auto &of : this->elements)
    {
      auto gradient = start;
      of.element.add_energy_gradient(of.X, material, this->u, this->w, factor, gradient);
      gradient = sum<dim>(gradient, -1., start);
      EXPECT_NEAR(dot<dim>(gradient, this->V),
                  factor * dot<dim>(this->w, this->force_derivative(of, this->V)),
                  1e-13 * norm<dim>(gradient) * norm<dim>(this->V))
        << of.name();

      auto swapped = start;
      of.element.add_energy_gradient(of.X, material, this->w, this->u, factor, swapped);
      EXPECT_LT(distance<dim>(sum<dim>(swapped, -1., start), gradient), 1e-13 * norm<dim>(gradient))
        << of.name();
    }
}

TYPED_TEST(ElementDerivatives, BodyForceAgreesWithDifferences)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    {
      Nodes<dim> found;
      of.element.body_force_derivative(of.X, this->V, this->b, found);
      const auto expected = derivative<dim>(
        [&](const Nodes<dim> &X) {
          Nodes<dim> f;
          of.element.body_force(X, this->b, f);
          return f;
        },
        of.X, this->V);
      EXPECT_LT(distance<dim>(found, expected), 1e-10 * norm<dim>(expected)) << of.name();

      Nodes<dim> gradient(this->n);
      of.element.add_body_force_gradient(of.X, this->b, this->u, 2., gradient);
      EXPECT_NEAR(dot<dim>(gradient, this->V), 2. * dot<dim>(found, this->u),
                  1e-13 * norm<dim>(gradient) * norm<dim>(this->V))
        << of.name();
    }
}

TYPED_TEST(ElementDerivatives, VolumeGradient)
{
  // Agrees with differences, and is the area vector of the boundary.
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    {
      Nodes<dim> gradient(this->n);
      of.element.add_volume_gradient(of.X, 1., gradient);
      const double expected = derivative<double>(
        [&](const double t) { return of.element.volume(sum<dim>(of.X, t, this->V)); });
      EXPECT_NEAR(dot<dim>(gradient, this->V), expected, 1e-9) << of.name();
      EXPECT_LT(distance<dim>(gradient,
                              boundary_normals<dim>(TestFixture::degree, of.X, of.idealization)),
                1e-13 * norm<dim>(gradient))
        << of.name();
    }
}
