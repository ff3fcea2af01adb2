#include <snug/elasticity/lagrange.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>

#include <array>

namespace snug::elasticity {
namespace {
/// Index of node @p a along each axis.
template <int dim>
std::array<unsigned int, dim> node_indices(const unsigned int degree, unsigned int a)
{
  std::array<unsigned int, dim> indices;
  for (unsigned int d = 0; d < dim; ++d, a /= degree + 1)
    indices[d] = a % (degree + 1);
  return indices;
}

struct ValueAndDerivative
{
  double value;
  double derivative;
};

/// Function i of degree p on [0,1]: prod_{j != i} (p x - j) / (i - j).
ValueAndDerivative lagrange_1d(const unsigned int p, const unsigned int i, const double x)
{
  ValueAndDerivative result{1., 0.};
  for (unsigned int j = 0; j <= p; ++j)
    if (j != i)
      {
        const double scale  = 1. / (double(i) - double(j));
        const double factor = (p * x - j) * scale;
        result.derivative   = result.derivative * factor + result.value * p * scale;
        result.value *= factor;
      }
  return result;
}
} // namespace

template <int dim>
LagrangePoint<dim> lagrange_point(const unsigned int degree, const dealii::Point<dim> &point)
{
  const unsigned int n = dealii::Utilities::pow(degree + 1, dim);
  LagrangePoint<dim> result;
  result.point = point;
  result.values.assign(n, 1.);
  result.gradients.resize(n);
  for (unsigned int a = 0; a < n; ++a)
    {
      const auto indices = node_indices<dim>(degree, a);
      for (unsigned int d = 0; d < dim; ++d)
        result.gradients[a][d] = 1.;
      for (unsigned int e = 0; e < dim; ++e)
        {
          const auto f = lagrange_1d(degree, indices[e], point[e]);
          result.values[a] *= f.value;
          for (unsigned int d = 0; d < dim; ++d)
            result.gradients[a][d] *= (d == e) ? f.derivative : f.value;
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

template LagrangePoint<1>              lagrange_point(unsigned int, const dealii::Point<1> &);
template LagrangePoint<2>              lagrange_point(unsigned int, const dealii::Point<2> &);
template LagrangePoint<3>              lagrange_point(unsigned int, const dealii::Point<3> &);
template std::vector<LagrangePoint<1>> lagrange_gauss_points(unsigned int);
template std::vector<LagrangePoint<2>> lagrange_gauss_points(unsigned int);
template std::vector<LagrangePoint<3>> lagrange_gauss_points(unsigned int);
template std::vector<LagrangePoint<1>> lagrange_nodes(unsigned int);
template std::vector<LagrangePoint<2>> lagrange_nodes(unsigned int);
template std::vector<LagrangePoint<3>> lagrange_nodes(unsigned int);
} // namespace snug::elasticity
