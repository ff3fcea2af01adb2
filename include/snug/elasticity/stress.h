#ifndef snug_elasticity_stress_h
#define snug_elasticity_stress_h

#include <snug/elasticity/material.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace snug
{
  namespace elasticity
  {
    /// Cauchy stress lambda tr(e) I + 2 mu e [force / length^2], e the
    /// symmetric part of the displacement gradient. 2D: the in-plane part in
    /// plane strain.
    template <int dim>
    dealii::SymmetricTensor<2, dim>
    cauchy_stress(const Material               &material,
                  const dealii::Tensor<2, dim> &displacement_gradient);

    /// von Mises stress sqrt(3/2 s:s), s = sigma - tr(sigma)/3 I, in the units
    /// of @p stress. 2D: @p out_of_plane is sigma_zz. 3D ignores it.
    template <int dim>
    double
    von_mises(const dealii::SymmetricTensor<2, dim> &stress,
              double                                 out_of_plane);
  } // namespace elasticity
} // namespace snug

#endif
