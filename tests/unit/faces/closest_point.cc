#include <snug/faces/closest_point.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace snug::faces;

namespace {
/// Nodes of a curved face over [0,1]^(dim-1), moved by up to @p amplitude.
template <int dim>
std::vector<dealii::Tensor<1, dim>>
crooked_face(const FaceShape<dim> &shape, double amplitude, std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  std::vector<dealii::Tensor<1, dim>>    nodes(shape.n_nodes());
  for (unsigned int k = 0; k < nodes.size(); ++k)
    for (unsigned int d = 0; d < dim; ++d)
      nodes[k][d] = uniform(random) + (d < dim - 1 ? shape.node(k)[d] : 0.);
  return nodes;
}

template <int dim>
dealii::Tensor<1, dim> face_point(const FaceShape<dim>                      &shape,
                                  const std::vector<dealii::Tensor<1, dim>> &nodes,
                                  const dealii::Point<dim - 1>              &xi)
{
  const auto             values = shape.at(xi);
  dealii::Tensor<1, dim> x;
  for (unsigned int k = 0; k < nodes.size(); ++k)
    x += values.value[k] * nodes[k];
  return x;
}

/// No point of a fine sample of the face may be closer, and the one found
/// must be where it says.
template <int dim>
void expect_closest(unsigned int degree)
{
  const FaceShape<dim>                   shape(degree);
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> uniform(-0.3, 1.3);
  for (unsigned int trial = 0; trial < 200; ++trial)
    {
      const auto             nodes = crooked_face<dim>(shape, 0.1 / (degree * degree), random);
      dealii::Tensor<1, dim> p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = uniform(random) - (d == dim - 1 ? 0.5 : 0.);
      const auto found = closest_point(shape, nodes, p);
      EXPECT_NEAR((face_point(shape, nodes, found.xi) - found.position).norm(), 0., 1e-14);
      EXPECT_NEAR((found.position - p).norm_square(), found.squared_distance, 1e-14);
      const unsigned int n = 40;
      for (unsigned int i = 0; i <= n; ++i)
        for (unsigned int j = 0; j <= (dim == 3 ? n : 0); ++j)
          {
            dealii::Point<dim - 1> xi;
            xi[dim - 2]  = j / double(n);
            xi[0]        = i / double(n);
            const auto x = face_point(shape, nodes, xi);
            ASSERT_GE((x - p).norm_square(), found.squared_distance - 1e-13)
              << "degree " << degree << ", trial " << trial << ", xi " << xi << ", found "
              << found.xi;
          }
    }
}
} // namespace

TEST(ClosestPoint, NoSampleOfTheFaceIsCloser)
{
  expect_closest<2>(1);
  expect_closest<2>(2);
  expect_closest<3>(1);
  expect_closest<3>(2);
}

TEST(ClosestPoint, OffsetAlongTheNormalLeadsBackToRoundOff)
{
  const FaceShape<3>                     shape(2);
  std::mt19937                           random(8);
  std::uniform_real_distribution<double> uniform(0.05, 0.95);
  for (unsigned int trial = 0; trial < 100; ++trial)
    {
      const auto             nodes = crooked_face<3>(shape, 0.05, random);
      const dealii::Point<2> xi(uniform(random), uniform(random));
      const auto             values = shape.at(xi);
      dealii::Tensor<1, 3>   t1, t2;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        {
          t1 += values.gradient[k][0] * nodes[k];
          t2 += values.gradient[k][1] * nodes[k];
        }
      const auto normal = dealii::cross_product_3d(t1, t2);
      const auto p      = face_point(shape, nodes, xi) + 0.05 * normal;
      EXPECT_NEAR(closest_point(shape, nodes, p).xi.distance(xi), 0., 1e-13);
    }
}

TEST(ClosestPoint, NodesAreFoundExactly)
{
  for (const unsigned int degree : {1, 2})
    {
      const FaceShape<3> shape(degree);
      std::mt19937       random(9);
      const auto         nodes = crooked_face<3>(shape, 0.1, random);
      for (unsigned int k = 0; k < nodes.size(); ++k)
        EXPECT_NEAR(closest_point(shape, nodes, nodes[k]).xi.distance(shape.node(k)), 0., 1e-14);
    }
}
