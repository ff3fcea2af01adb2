#ifndef snug_elasticity_von_mises_power_h
#define snug_elasticity_von_mises_power_h

#include <snug/elasticity/cell_point.h>
#include <snug/elasticity/material.h>
#include <snug/elasticity/thermal_strain.h>

#include <vector>

#include <deal.II/base/symmetric_tensor.h>

namespace snug::elasticity {
/**
 * This class computes integrals of powers of the von Mises stress over cells like those of
 * Element, at the same Gauss points:
 * S = int (sigma_vM / scale)^p dV [length^3],
 * sigma_vM = sqrt(3/2 s:s), s = 2 mu dev e.
 * All formulations share s, because it does not depend on the dilatation. A thermal strain, which
 * is subtracted from e, changes s in plane stress alone, through the strain across the sheet.
 *
 * Along du and the velocities V, with the flux
 * H = p (sigma_vM / scale)^(p-2) 3/2 (2 mu s) / scale^2 and grad u =: g,
 * S' = int H : (grad du - g grad V) + (sigma_vM / scale)^p div V dV.
 */
template <int dim>
class VonMisesPower
{
public:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  /// p >= 1.
  VonMisesPower(unsigned int degree, const mesh::Idealization &idealization, double p);

  /// Return the maximum sigma_vM at the Gauss points.
  double largest(const Nodes              &X,
                 const Material           &material,
                 const Nodes              &u,
                 const ThermalStrain<dim> &thermal = {}) const;

  /// Return S, with a scale > 0 [force / length^2].
  double value(const Nodes              &X,
               const Material           &material,
               const Nodes              &u,
               double                    scale,
               const ThermalStrain<dim> &thermal = {}) const;

  /// Add factor * dS/du_a and factor * dS/dX_a to the gradients.
  void add_gradients(const Nodes              &X,
                     const Material           &material,
                     const Nodes              &u,
                     double                    scale,
                     double                    factor,
                     Nodes                    &by_u,
                     Nodes                    &by_X,
                     const ThermalStrain<dim> &thermal = {}) const;

private:
  dealii::SymmetricTensor<2, 3> deviator_at(const CellPoint<dim>     &point,
                                            const Material           &material,
                                            const Nodes              &u,
                                            const ThermalStrain<dim> &thermal) const;

  const mesh::Idealization                    idealization;
  const double                                p;
  const std::vector<mesh::LagrangePoint<dim>> gauss;
};
} // namespace snug::elasticity

#endif
