#include <snug/elasticity/face_load.h>

#include "cells.h"

using namespace elasticity_cells;

namespace {
/// A pressure at the Gauss points of a face with @p n nodes.
template <int dim>
FaceLoadValues<dim> uniform(std::size_t n, double pressure)
{
  return {std::vector<double>(n, pressure), {}, {}};
}
} // namespace

template <typename Case>
class FaceLoads : public ::testing::Test
{
public:
  static constexpr int          dim    = Case::dim;
  static constexpr unsigned int degree = Case::degree;

  const FaceLoad<dim> load{degree};
  const Nodes<dim>    cell = distorted<dim>(degree, 31);
  const Nodes<dim>    X    = face(Idealization::natural(dim));
  const Nodes<dim>    V    = random_field<dim>(X.size(), 32);
  const Nodes<dim>    u    = random_field<dim>(X.size(), 33);
  /// at the Gauss points, which are as many as the nodes
  const Nodes<dim>          traction = random_field<dim>(X.size(), 34);
  const std::vector<double> pressure = varying(X.size());

  static std::vector<double> varying(std::size_t n)
  {
    std::vector<double> pressure(n, 1.7);
    pressure[1] = 0.4;
    return pressure;
  }

  static Nodes<dim> face(const Idealization &idealization)
  {
    return extract<dim>(distorted<dim>(idealization, degree, 31),
                        face_nodes<dim>(degree, dim - 1, true));
  }
};
TYPED_TEST_SUITE(FaceLoads, AllCases);

TYPED_TEST(FaceLoads, PressureOnAClosedSurfaceIsBalanced)
{
  constexpr int          dim     = TestFixture::dim;
  const auto             normals = boundary_normals<dim>(TestFixture::degree, this->cell);
  dealii::Tensor<1, dim> force;
  dealii::Tensor<2, dim> moment;
  for (unsigned int a = 0; a < normals.size(); ++a)
    {
      force += normals[a];
      moment += outer_product(this->cell[a], normals[a]);
    }
  EXPECT_LT(force.norm(), 1e-13);
  // int x (x) n dA = volume I: no moment, and the divergence theorem
  const double volume = Element<dim>(TestFixture::degree).volume(this->cell);
  for (unsigned int d = 0; d < dim; ++d)
    moment[d][d] -= volume;
  EXPECT_LT(moment.norm(), 1e-13 * volume);
}

TYPED_TEST(FaceLoads, UnitFacesHaveUnitAreaAndPressurePushesInwards)
{
  constexpr int dim  = TestFixture::dim;
  const auto    cube = elasticity_cells::cube<dim>(TestFixture::degree);
  for (unsigned int d = 0; d < dim; ++d)
    for (const bool upper : {false, true})
      {
        const auto face  = extract<dim>(cube, face_nodes<dim>(TestFixture::degree, d, upper));
        double     total = 0.;
        for (const double area : this->load.areas(face))
          {
            EXPECT_GT(area, 0.);
            total += area;
          }
        EXPECT_NEAR(total, 1., 1e-14);

        Nodes<dim> f;
        this->load.force(face, uniform<dim>(face.size(), 5.), f);
        dealii::Tensor<1, dim> sum;
        for (const auto &vector : f)
          sum += vector;
        sum[d] += upper ? 5. : -5.;
        EXPECT_LT(sum.norm(), 1e-14);
      }
}

TYPED_TEST(FaceLoads, TractionActsOnTributaryAreas)
{
  constexpr int dim = TestFixture::dim;
  Nodes<dim>    f;
  const auto    t = this->traction[0];
  this->load.force(this->X, {{}, Nodes<dim>(this->X.size(), t), {}}, f);
  const auto areas = this->load.areas(this->X);
  for (unsigned int a = 0; a < f.size(); ++a)
    EXPECT_LT((f[a] - areas[a] * t).norm(), 1e-14);
}

/// A force at a point and one along a piece of a line.
template <int dim>
std::vector<ConcentratedForce<dim>> concentrated(unsigned int                  degree,
                                                 const dealii::Tensor<1, dim> &t)
{
  dealii::Point<dim - 1>     xi;
  dealii::Tensor<1, dim - 1> piece;
  for (unsigned int i = 0; i < dim - 1; ++i)
    {
      xi[i]    = 0.3 + 0.4 * i;
      piece[i] = 0.2 - 0.5 * i;
    }
  const auto shape = snug::mesh::lagrange_point<dim - 1>(degree, xi);
  return {{shape, 2. * t}, {shape, t, piece}};
}

TYPED_TEST(FaceLoads, DerivativeAgreesWithDifferences)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &idealization : idealizations<dim>())
    for (const auto &pressure : {std::vector<double>(), this->pressure})
      for (const auto &traction : {Nodes<dim>(), this->traction})
        {
          const FaceLoad<dim>       load(TestFixture::degree, idealization);
          const auto                X = this->face(idealization);
          const FaceLoadValues<dim> values{
            pressure, traction, {}, concentrated<dim>(TestFixture::degree, this->traction[0])};
          Nodes<dim> found;
          load.force_derivative(X, this->V, values, {}, found);
          const auto expected = derivative<dim>(
            [&](const Nodes<dim> &X) {
              Nodes<dim> f;
              load.force(X, values, f);
              return f;
            },
            X, this->V);
          // forces per revolution are about 10, else 1
          EXPECT_LE(distance<dim>(found, expected), 1e-9);
        }
}

TYPED_TEST(FaceLoads, GradientIsTheTransposeOfTheDerivative)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &idealization : idealizations<dim>())
    {
      const FaceLoad<dim>       load(TestFixture::degree, idealization);
      const auto                X = this->face(idealization);
      const FaceLoadValues<dim> values{this->pressure,
                                       this->traction,
                                       {},
                                       concentrated<dim>(TestFixture::degree, this->traction[0])};
      Nodes<dim>                f;
      load.force_derivative(X, this->V, values, {}, f);
      Nodes<dim> gradient(X.size());
      gradient[0][0] = 1.;
      load.add_force_gradient(X, values, this->u, -3., gradient);
      gradient[0][0] -= 1.;
      EXPECT_NEAR(dot<dim>(gradient, this->V), -3. * dot<dim>(f, this->u),
                  1e-13 * norm<dim>(gradient) * norm<dim>(this->V));
    }
}

TEST(FaceLoadWeight, ThicknessIsAFactor)
{
  const auto  X    = cube<2>(2);
  const auto  face = extract<2>(X, face_nodes<2>(2, 0, true));
  FaceLoad<2> thin(2, {Idealization::Kind::plane_stress, 0.25});
  Nodes<2>    f;
  thin.force(face, uniform<2>(3, 8.), f);
  double sum = 0.;
  for (const auto &force : f)
    sum += force[0];
  EXPECT_NEAR(sum, -8. * 0.25, 1e-14);
}

TEST(FaceLoadWeight, ConesHaveTheirArea)
{
  // frustum with radii 2 and 5, height 4, slant 5: area pi (2 + 5) 5
  for (const unsigned int degree : {1, 2})
    {
      const FaceLoad<2> load(degree, {Idealization::Kind::axisymmetric});
      Nodes<2>          face(degree + 1), f;
      for (unsigned int a = 0; a <= degree; ++a)
        {
          const double t = double(a) / degree;
          face[a]        = dealii::Point<2>(2. + 3. * t, 4. * t);
        }
      double area = 0., axial_force = 0.;
      for (const double share : load.areas(face))
        area += share;
      EXPECT_NEAR(area, dealii::numbers::PI * 35., 1e-12);

      // axial force of a pressure: on the projected annulus
      load.force(face, uniform<2>(face.size(), 2.), f);
      for (const auto &force : f)
        axial_force += force[1];
      EXPECT_NEAR(axial_force, 2. * dealii::numbers::PI * 21., 1e-12);
    }
}

TYPED_TEST(FaceLoads, FollowsTranslationsAndRotations)
{
  // translations: no change; V = W X with W skew: pressure forces turn,
  // dead tractions do not
  constexpr int             dim = TestFixture::dim;
  const Nodes<dim>          translation(this->X.size(), this->traction[0]);
  const FaceLoadValues<dim> both{this->pressure, this->traction, {}};
  Nodes<dim>                f, f_derivative;
  this->load.force_derivative(this->X, translation, both, {}, f_derivative);
  EXPECT_LT(norm<dim>(f_derivative), 1e-13);

  const auto W = random_skew<dim>(35);
  this->load.force(this->X, {this->pressure, {}, {}}, f);
  this->load.force_derivative(this->X, times<dim>(W, this->X), both, {}, f_derivative);
  EXPECT_LT(distance<dim>(f_derivative, times<dim>(W, f)), 1e-13);
}
