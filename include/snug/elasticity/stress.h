#ifndef snug_elasticity_stress_h
#define snug_elasticity_stress_h

#include <snug/elasticity/material.h>
#include <snug/mesh/idealization.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace snug::elasticity {
/// Return the strain of a displacement gradient in space (see CellPoint): its symmetric part and,
/// in plane stress, the strain across the sheet, -nu/(1-nu) (e_xx + e_yy), which gives
/// sigma_zz = 0.
dealii::SymmetricTensor<2, 3> strain(const mesh::Idealization   &idealization,
                                     const Material             &material,
                                     const dealii::Tensor<2, 3> &displacement_gradient);

/// Return the Cauchy stress lambda tr(e) I + 2 mu e [force / length^2].
dealii::SymmetricTensor<2, 3> cauchy_stress(const Material                      &material,
                                            const dealii::SymmetricTensor<2, 3> &strain);

/// Return the von Mises stress sqrt(3/2 s:s), s = sigma - tr(sigma)/3 I, in the units of @p stress.
double von_mises(const dealii::SymmetricTensor<2, 3> &stress);

/// Return lambda of the stiffness in the plane: E nu / (1 - nu^2) in plane stress.
double lame_lambda(const mesh::Idealization &idealization, const Material &material);
} // namespace snug::elasticity

#endif
