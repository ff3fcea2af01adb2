#include <snug/mesh/lagrange.h>

#include <deal.II/fe/fe_q.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace snug::mesh;

namespace {
/// Values and gradients against dealii::FE_Q at a point in the cube.
template <int dim>
void compare_with_fe_q(const unsigned int degree)
{
  const dealii::FE_Q<dim> fe(degree);
  dealii::Point<dim>      point;
  for (unsigned int d = 0; d < dim; ++d)
    point[d] = 0.2 + 0.3 * d;
  const auto found = lagrange_point<dim>(degree, point);
  ASSERT_EQ(found.value.size(), fe.n_dofs_per_cell());
  for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      unsigned int a = 0, stride = 1;
      for (unsigned int d = 0; d < dim; ++d, stride *= degree + 1)
        a += stride * std::lround(fe.unit_support_point(i)[d] * degree);
      EXPECT_NEAR(found.value[a], fe.shape_value(i, point), 1e-14);
      EXPECT_LT((found.gradient[a] - fe.shape_grad(i, point)).norm(), 1e-13);
    }
}
} // namespace

TEST(Lagrange, AgreesWithFE_Q)
{
  for (const unsigned int degree : {1, 2})
    {
      compare_with_fe_q<1>(degree);
      compare_with_fe_q<2>(degree);
      compare_with_fe_q<3>(degree);
    }
}

TEST(Lagrange, IsNodal)
{
  for (const unsigned int degree : {1, 2})
    {
      const auto points = lagrange_nodes<3>(degree);
      for (unsigned int a = 0; a < points.size(); ++a)
        for (unsigned int b = 0; b < points.size(); ++b)
          EXPECT_EQ(points[a].value[b], a == b ? 1. : 0.);
    }
}

TEST(Lagrange, WeightsSumToOne)
{
  for (const unsigned int degree : {1, 2})
    {
      double sum = 0.;
      for (const auto &point : lagrange_gauss_points<2>(degree))
        sum += point.weight;
      EXPECT_NEAR(sum, 1., 1e-14);
    }
}
