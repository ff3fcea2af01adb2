#include <snug/elasticity/face_load.h>

#include "cells.h"

using namespace elasticity_cells;

template <typename Case>
class Resultants : public ::testing::Test
{
public:
  static constexpr int          dim    = Case::dim;
  static constexpr unsigned int degree = Case::degree;
  using Point                          = dealii::Tensor<1, dim>;

  const FaceLoad<dim> load{degree};
  const Nodes<dim>    X =
    extract<dim>(distorted<dim>(degree, 41), face_nodes<dim>(degree, dim - 1, true));
  const Nodes<dim>     V      = random_field<dim>(X.size(), 42);
  const Nodes<dim>     u      = random_field<dim>(X.size(), 43);
  const Point          origin = random_field<dim>(1, 44)[0];
  const Resultant<dim> resultant{random_field<dim>(1, 45)[0], moment()};

  static dealii::Tensor<1, 3> moment()
  {
    auto m = random_field<3>(1, 46)[0];
    if (dim == 2)
      m[0] = m[1] = 0.;
    return m;
  }

  SpreadResultant<dim> spread(const Nodes<dim> &positions) const
  {
    return {resultant, load.moments(positions, origin), origin};
  }

  Nodes<dim> force(const Nodes<dim> &positions) const
  {
    Nodes<dim> f;
    load.force(positions, {{}, {}, spread(positions).traction()}, f);
    return f;
  }

  Nodes<dim> force_derivative() const
  {
    const auto now = spread(X);
    Nodes<dim> f;
    load.force_derivative(X, V, {{}, {}, now.traction()},
                          now.derivative(load.moment_derivatives(X, V, origin)), f);
    return f;
  }
};
TYPED_TEST_SUITE(Resultants, AllCases);

TYPED_TEST(Resultants, AreExact)
{
  constexpr int          dim = TestFixture::dim;
  const auto             f   = this->force(this->X);
  Resultant<dim>         found;
  const auto             areas = this->load.areas(this->X);
  dealii::Tensor<1, dim> centre;
  double                 area = 0.;
  for (unsigned int a = 0; a < f.size(); ++a)
    {
      centre += areas[a] * this->X[a];
      area += areas[a];
    }
  centre /= area;
  EXPECT_NEAR(this->spread(this->X).area(), area, 1e-14);
  EXPECT_LT((this->spread(this->X).traction().centre - centre).norm(), 1e-14);
  for (unsigned int a = 0; a < f.size(); ++a)
    {
      found.force += f[a];
      found.moment += moment_of(this->X[a] - centre, f[a]);
    }
  EXPECT_LT((found.force - this->resultant.force).norm(), 1e-13);
  EXPECT_LT((found.moment - this->resultant.moment).norm(), 1e-13);
}

TYPED_TEST(Resultants, DerivativeAgreesWithDifferences)
{
  constexpr int dim = TestFixture::dim;
  const auto    expected =
    derivative<dim>([&](const Nodes<dim> &X) { return this->force(X); }, this->X, this->V);
  EXPECT_LT(distance<dim>(this->force_derivative(), expected), 1e-9 * norm<dim>(expected));
}

TYPED_TEST(Resultants, GradientIsTheTransposeOfTheDerivative)
{
  constexpr int dim  = TestFixture::dim;
  const auto    now  = this->spread(this->X);
  const auto    of_u = this->load.displacement_moments(this->X, this->u, now.traction().centre);
  const ResultantWork<dim> work{now.traction(), now.area(), of_u.force,
                                now.divided_by_inertia(of_u.moment)};
  Nodes<dim>               gradient(this->X.size());
  gradient[0][0] = 1.;
  this->load.add_resultant_gradient(this->X, work, this->u, -3., gradient);
  gradient[0][0] -= 1.;
  EXPECT_NEAR(dot<dim>(gradient, this->V), -3. * dot<dim>(this->force_derivative(), this->u),
              1e-12 * norm<dim>(gradient) * norm<dim>(this->V));
}

TYPED_TEST(Resultants, BendAFlatSquareLinearly)
{
  // the moment about x of a unit square (2D: edge): t = 12 M s, s in [-1/2,
  // 1/2]
  constexpr int  dim  = TestFixture::dim;
  const auto     cube = elasticity_cells::cube<dim>(TestFixture::degree);
  const auto     face = extract<dim>(cube, face_nodes<dim>(TestFixture::degree, dim - 1, true));
  Resultant<dim> moment;
  moment.moment[dim == 2 ? 2 : 0] = 0.5;
  dealii::Tensor<1, dim>     origin;
  const SpreadResultant<dim> spread(moment, this->load.moments(face, origin), origin);
  for (const auto &x : face)
    {
      dealii::Tensor<1, dim> expected;
      expected[dim - 1] = dim == 2 ? 6. * (x[0] - 0.5) : 6. * (x[1] - 0.5);
      EXPECT_LT((spread.traction().value(x) - expected).norm(), 1e-13);
    }
}
