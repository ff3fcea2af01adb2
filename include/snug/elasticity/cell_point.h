#ifndef snug_elasticity_cell_point_h
#define snug_elasticity_cell_point_h

#include <snug/elasticity/lagrange.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace snug
{
  namespace elasticity
  {
    /// J = sum_a X_a (x) dN_a/d xi [length].
    template <int dim>
    dealii::Tensor<2, dim>
    jacobian(const LagrangePoint<dim>                  &shape,
             const std::vector<dealii::Tensor<1, dim>> &X);

    /// A point of a cell with nodes X: g_a = J^-T dN_a/d xi.
    template <int dim>
    struct CellPoint
    {
      using Nodes = std::vector<dealii::Tensor<1, dim>>;

      /// The shape must outlive this object; J must be regular.
      CellPoint(const LagrangePoint<dim> &shape, const Nodes &X);

      /// sum_a u_a (x) g_a.
      dealii::Tensor<2, dim>
      gradient(const Nodes &u) const;

      /// sum_a N_a u_a.
      dealii::Tensor<1, dim>
      value(const Nodes &u) const;

      const LagrangePoint<dim> &shape;
      double                    dV; ///< weight times det J [length^dim]
      std::array<dealii::Tensor<1, dim>, 27> gradients; ///< g_a [1/length]
    };
  } // namespace elasticity
} // namespace snug

#endif
