#ifndef snug_elasticity_cell_point_h
#define snug_elasticity_cell_point_h

#include <snug/mesh/idealization.h>
#include <snug/mesh/lagrange.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace snug::elasticity {
/// Return J = sum_a X_a (x) dN_a/d xi [length].
template <int dim>
dealii::Tensor<2, dim> jacobian(const mesh::LagrangePoint<dim>            &shape,
                                const std::vector<dealii::Tensor<1, dim>> &X);

/// Return sum_a N_a u_a.
template <int dim>
dealii::Tensor<1, dim> value(const mesh::LagrangePoint<dim>            &shape,
                             const std::vector<dealii::Tensor<1, dim>> &u);

/// This struct holds the part of a CellPoint from which gradients follow, at a fraction of the
/// cost.
template <int dim>
struct InverseJacobian
{
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  /// The shape must outlive this object; J must be regular.
  InverseJacobian(const mesh::LagrangePoint<dim> &shape,
                  const Nodes                    &X,
                  const mesh::Idealization       &idealization);

  /// Return CellPoint::gradient().
  dealii::Tensor<2, 3> gradient(const Nodes &u) const;

  const mesh::LagrangePoint<dim> &shape;
  dealii::Tensor<2, dim>          inverse; ///< J^-1 [1/length]
  double                          radius;  ///< 0 unless axisymmetric
};

/**
 * A point of a cell with nodes X: g_a = J^-T dN_a/d xi.
 *
 * Gradients are gradients of fields in space, also for sections, so that the formulas of a solid
 * hold for all idealizations. In an axisymmetric one, the entry (2,2) of the gradient of u is u_r
 * / r. All other out-of-plane entries are zero.
 */
template <int dim>
struct CellPoint
{
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  /// The shape must outlive this object; J must be regular.
  CellPoint(const mesh::LagrangePoint<dim> &shape,
            const Nodes                    &X,
            const mesh::Idealization       &idealization);

  /// Return sum_a u_a (x) g_a, plus sum_a N_a/r u_a,r in axisymmetric models.
  dealii::Tensor<2, 3> gradient(const Nodes &u) const;

  /// Compute f_a += dV flux : d gradient() / d u_a = dV (flux g_a + flux_22 N_a/r).
  void add_flux(const dealii::Tensor<2, 3> &flux, Nodes &f) const;

  /// Compute f_a += dV N_a source.
  void add_source(const dealii::Tensor<1, dim> &source, Nodes &f) const;

  const mesh::LagrangePoint<dim>        &shape;
  double                                 dV; ///< weight * det J * weight of the section [length^3]
  std::array<dealii::Tensor<1, dim>, 27> gradients;      ///< g_a [1/length]
  double                                 inverse_radius; ///< or 0
};
} // namespace snug::elasticity

#endif
