#include <snug/mesh/lagrange.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>

#include <boost/container/small_vector.hpp>

namespace snug::mesh {
template <int dim>
LagrangePoint<dim> lagrange_point(const unsigned int degree, const dealii::Point<dim> &point)
{
  const unsigned int n = dealii::Utilities::pow(degree + 1, dim);
  boost::container::small_vector<std::array<double, 3>, dim *(surface_degree + 1)> of_axes;
  for (int axis = 0; axis < dim; ++axis)
    for (unsigned int i = 0; i <= degree; ++i)
      of_axes.push_back(lagrange<2>(degree, i, point[axis]));
  LagrangePoint<dim> result;
  result.point = point;
  result.value.assign(n, 1.);
  result.gradient.resize(n);
  result.hessian.resize(n);
  for (unsigned int a = 0; a < n; ++a)
    {
      const auto indices = node_indices<dim>(degree, a);
      for (int d = 0; d < dim; ++d)
        {
          result.gradient[a][d] = 1.;
          for (int e = 0; e < dim; ++e)
            result.hessian[a][d][e] = 1.;
        }
      for (int axis = 0; axis < dim; ++axis)
        {
          const auto &f = of_axes[axis * (degree + 1) + indices[axis]];
          result.value[a] *= f[0];
          for (int d = 0; d < dim; ++d)
            {
              result.gradient[a][d] *= f[d == axis];
              for (int e = 0; e < dim; ++e)
                result.hessian[a][d][e] *= f[(d == axis) + (e == axis)];
            }
        }
    }
  return result;
}

template <int dim>
std::vector<LagrangePoint<dim>> lagrange_gauss_points(const unsigned int degree)
{
  const dealii::QGauss<dim>       quadrature(degree + 1);
  std::vector<LagrangePoint<dim>> points;
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      points.push_back(lagrange_point<dim>(degree, quadrature.point(q)));
      points.back().weight = quadrature.weight(q);
    }
  return points;
}

template <int dim>
std::vector<LagrangePoint<dim>> lagrange_nodes(const unsigned int degree)
{
  std::vector<LagrangePoint<dim>> points;
  for (int a = 0; a < dealii::Utilities::pow<int>(degree + 1, dim); ++a)
    {
      const auto         indices = node_indices<dim>(degree, a);
      dealii::Point<dim> point;
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = double(indices[d]) / degree;
      points.push_back(lagrange_point<dim>(degree, point));
    }
  return points;
}

#define SNUG_INSTANTIATE(dim)                                                                        \
  template LagrangePoint<dim>              lagrange_point(unsigned int, const dealii::Point<dim> &); \
  template std::vector<LagrangePoint<dim>> lagrange_gauss_points(unsigned int);                      \
  template std::vector<LagrangePoint<dim>> lagrange_nodes(unsigned int);
SNUG_INSTANTIATE(1)
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mesh
