#include <snug/elasticity/stress.h>

#include <cmath>

namespace snug
{
  namespace elasticity
  {
    template <int dim>
    dealii::SymmetricTensor<2, dim>
    cauchy_stress(const Material               &material,
                  const dealii::Tensor<2, dim> &displacement_gradient)
    {
      return material.lame_lambda() * trace(displacement_gradient) *
               dealii::unit_symmetric_tensor<dim>() +
             2. * material.lame_mu() * symmetrize(displacement_gradient);
    }

    template <int dim>
    double
    von_mises(const dealii::SymmetricTensor<2, dim> &stress,
              const double                           out_of_plane)
    {
      dealii::SymmetricTensor<2, 3> full;
      if (dim == 2)
        full[2][2] = out_of_plane;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          full[i][j] = stress[i][j];
      return std::sqrt(1.5) * deviator(full).norm();
    }

    template dealii::SymmetricTensor<2, 2>
    cauchy_stress(const Material &, const dealii::Tensor<2, 2> &);
    template dealii::SymmetricTensor<2, 3>
    cauchy_stress(const Material &, const dealii::Tensor<2, 3> &);
    template double
    von_mises(const dealii::SymmetricTensor<2, 2> &, double);
    template double
    von_mises(const dealii::SymmetricTensor<2, 3> &, double);
  } // namespace elasticity
} // namespace snug
