#ifndef snug_mesh_lagrange_h
#define snug_mesh_lagrange_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace snug::mesh {
/// Degree of the polynomials that describe the true surfaces of faces.
constexpr unsigned int surface_degree = 4;

/// Return Lagrange function i of degree p with equidistant nodes on [0,1],
/// prod_{j != i} (p x - j) / (i - j), and its first @p order derivatives.
template <int order, typename Number>
std::array<Number, order + 1> lagrange(unsigned int p, unsigned int i, const Number &x)
{
  std::array<Number, order + 1> f{};
  f[0] = 1.;
  for (unsigned int j = 0; j <= p; ++j)
    if (j != i)
      {
        const double scale  = 1. / (double(i) - double(j));
        const Number factor = (double(p) * x - double(j)) * scale;
        for (int d = order; d > 0; --d)
          f[d] = f[d] * factor + f[d - 1] * (d * p * scale);
        f[0] = f[0] * factor;
      }
  return f;
}

/// Return the index of node @p a of a cube of degree @p p along each axis. Nodes are in
/// tensor-product order, the first coordinate fastest.
template <int dim>
std::array<unsigned int, dim> node_indices(unsigned int p, unsigned int a)
{
  std::array<unsigned int, dim> indices;
  for (int d = 0; d < dim; ++d, a /= p + 1)
    indices[d] = a % (p + 1);
  return indices;
}

/**
 * The (p+1)^dim Lagrange functions of a reference cube [0,1]^dim at one point of the cube. The
 * functions are products of Lagrange functions along the axes (for p <= 2 the functions
 * of dealii::FE_Q).
 */
template <int dim>
struct LagrangePoint
{
  std::vector<double>                 value;    ///< N_a
  std::vector<dealii::Tensor<1, dim>> gradient; ///< dN_a / d xi
  std::vector<dealii::Tensor<2, dim>> hessian;  ///< d^2 N_a / d xi^2
  dealii::Point<dim>                  point;
  double                              weight = 0.; ///< of a quadrature on the reference cube
};

/// Return the functions of degree @p degree at @p point.
template <int dim>
LagrangePoint<dim> lagrange_point(unsigned int degree, const dealii::Point<dim> &point);

/// Return the functions at the (p+1)^dim Gauss points. The weights sum to 1.
template <int dim>
std::vector<LagrangePoint<dim>> lagrange_gauss_points(unsigned int degree);

/// Return the functions at their own nodes, without weights.
template <int dim>
std::vector<LagrangePoint<dim>> lagrange_nodes(unsigned int degree);
} // namespace snug::mesh

#endif
