#ifndef snug_elasticity_cell_point_h
#define snug_elasticity_cell_point_h

#include <snug/mesh/idealization.h>
#include <snug/mesh/lagrange.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace snug::elasticity {
/// J = sum_a X_a (x) dN_a/d xi [length].
template <int dim>
dealii::Tensor<2, dim> jacobian(const mesh::LagrangePoint<dim>            &shape,
                                const std::vector<dealii::Tensor<1, dim>> &X);

/// sum_a N_a u_a.
template <int dim>
dealii::Tensor<1, dim> value(const mesh::LagrangePoint<dim>            &shape,
                             const std::vector<dealii::Tensor<1, dim>> &u);

/// CellPoint::gradient() of @p u by itself, at a fraction of the cost.
template <int dim>
dealii::Tensor<2, 3> gradient(const mesh::LagrangePoint<dim>            &shape,
                              const std::vector<dealii::Tensor<1, dim>> &X,
                              const std::vector<dealii::Tensor<1, dim>> &u,
                              const mesh::Idealization                  &idealization);

/**
 * A point of a cell with nodes X: g_a = J^-T dN_a/d xi.
 *
 * Gradients are those of fields in space, sections or not, so that the
 * formulas of a solid hold for all idealizations: in an axisymmetric one,
 * the entry (2,2) of the gradient of u is u_r / r. Other entries out of
 * the plane are zero.
 */
template <int dim>
struct CellPoint
{
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  /// The shape must outlive this object; J must be regular.
  CellPoint(const mesh::LagrangePoint<dim> &shape,
            const Nodes                    &X,
            const mesh::Idealization       &idealization);

  /// sum_a u_a (x) g_a, and sum_a N_a/r u_a,r.
  dealii::Tensor<2, 3> gradient(const Nodes &u) const;

  /// f_a += dV flux : d gradient() / d u_a = dV (flux g_a + flux_22 N_a/r).
  void add_flux(const dealii::Tensor<2, 3> &flux, Nodes &f) const;

  /// f_a += dV N_a source.
  void add_source(const dealii::Tensor<1, dim> &source, Nodes &f) const;

  const mesh::LagrangePoint<dim> &shape;
  double                          dV; ///< weight times det J times that of the section [length^3]
  std::array<dealii::Tensor<1, dim>, 27> gradients;      ///< g_a [1/length]
  double                                 inverse_radius; ///< or 0
};
} // namespace snug::elasticity

#endif
