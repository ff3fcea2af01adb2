#ifndef snug_elasticity_lagrange_h
#define snug_elasticity_lagrange_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace snug::elasticity {
/**
 * The (p+1)^dim Lagrange functions of a reference cube [0,1]^dim at one of
 * its points. Nodes are equidistant, in tensor-product order, the first
 * coordinate fastest (for p <= 2 the functions of dealii::FE_Q).
 */
template <int dim>
struct LagrangePoint
{
  std::vector<double>                 values;    ///< N_a
  std::vector<dealii::Tensor<1, dim>> gradients; ///< dN_a / d xi
  dealii::Point<dim>                  point;
  double                              weight = 0.; ///< of a quadrature on the reference cube
};

/// The functions of degree @p degree at @p point.
template <int dim>
LagrangePoint<dim> lagrange_point(unsigned int degree, const dealii::Point<dim> &point);

/// The functions at the (p+1)^dim Gauss points; the weights sum to 1.
template <int dim>
std::vector<LagrangePoint<dim>> lagrange_gauss_points(unsigned int degree);

/// The functions at their own nodes, without weights.
template <int dim>
std::vector<LagrangePoint<dim>> lagrange_nodes(unsigned int degree);
} // namespace snug::elasticity

#endif
