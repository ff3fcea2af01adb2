#include <snug/elasticity/stress.h>

#include <cmath>

namespace snug::elasticity {
dealii::SymmetricTensor<2, 3> strain(const mesh::Idealization   &idealization,
                                     const Material             &material,
                                     const dealii::Tensor<2, 3> &displacement_gradient)
{
  dealii::SymmetricTensor<2, 3> result = symmetrize(displacement_gradient);
  if (idealization.kind == mesh::Idealization::Kind::plane_stress)
    result[2][2] =
      // The sheet can change its thickness freely, so this value makes sigma_zz zero.
      -material.poissons_ratio / (1. - material.poissons_ratio) * (result[0][0] + result[1][1]);
  return result;
}

/// Return all components. In plane strain there is a stress across the section without a strain.
dealii::SymmetricTensor<2, 3> cauchy_stress(const Material                      &material,
                                            const dealii::SymmetricTensor<2, 3> &strain)
{
  return material.lame_lambda() * trace(strain) * dealii::unit_symmetric_tensor<3>() +
         2. * material.lame_mu() * strain;
}

/// Return the stress. norm() is sqrt(s:s) with both off-diagonal halves, as the formula requires.
double von_mises(const dealii::SymmetricTensor<2, 3> &stress)
{
  return std::sqrt(1.5) * deviator(stress).norm();
}

/// Return lambda in the plane. cauchy_stress() uses the lambda of 3D, because its strain includes
/// the strain across the sheet. A matrix of in-plane strains needs the lambda after that strain
/// is eliminated.
double lame_lambda(const mesh::Idealization &idealization, const Material &material)
{
  const double nu = material.poissons_ratio;
  return idealization.kind == mesh::Idealization::Kind::plane_stress
           ? material.youngs_modulus * nu / (1. - nu * nu)
           : material.lame_lambda();
}
} // namespace snug::elasticity
