#include <snug/elasticity/stress.h>
#include <snug/elasticity/von_mises_power.h>

#include <algorithm>
#include <cmath>

namespace snug::elasticity {
template <int dim>
VonMisesPower<dim>::VonMisesPower(const unsigned int        degree,
                                  const mesh::Idealization &idealization,
                                  const double              p)
  : idealization(idealization), p(p), gauss(mesh::lagrange_gauss_points<dim>(degree))
{}

/// Return s = 2 mu dev e.
template <int dim>
dealii::SymmetricTensor<2, 3>
VonMisesPower<dim>::deviator_at(const CellPoint<dim>     &point,
                                const Material           &material,
                                const Nodes              &u,
                                const ThermalStrain<dim> &thermal) const
{
  auto gradient = point.gradient(u);
  if (thermal)
    gradient -= thermal(point.shape) * dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
  return 2. * material.lame_mu() * deviator(strain(idealization, material, gradient));
}

/// Return the maximum stress. It is not smooth in u and X, so use it for scales and reports, not
/// for gradients.
template <int dim>
double VonMisesPower<dim>::largest(const Nodes              &X,
                                   const Material           &material,
                                   const Nodes              &u,
                                   const ThermalStrain<dim> &thermal) const
{
  double result = 0.;
  for (const auto &shape : gauss)
    {
      const CellPoint<dim> point(shape, X, idealization);
      result = std::max(result, von_mises(deviator_at(point, material, u, thermal)));
    }
  return result;
}

/// Divide stresses by @p scale before the power is taken, because otherwise large p would overflow.
template <int dim>
double VonMisesPower<dim>::value(const Nodes              &X,
                                 const Material           &material,
                                 const Nodes              &u,
                                 const double              scale,
                                 const ThermalStrain<dim> &thermal) const
{
  double result = 0.;
  for (const auto &shape : gauss)
    {
      const CellPoint<dim> point(shape, X, idealization);
      result += std::pow(von_mises(deviator_at(point, material, u, thermal)) / scale, p) * point.dV;
    }
  return result;
}

template <int dim>
void VonMisesPower<dim>::add_gradients(const Nodes              &X,
                                       const Material           &material,
                                       const Nodes              &u,
                                       const double              scale,
                                       const double              factor,
                                       Nodes                    &by_u,
                                       Nodes                    &by_X,
                                       const ThermalStrain<dim> &thermal) const
{
  const auto identity = dealii::unit_symmetric_tensor<3>();
  for (const auto &shape : gauss)
    {
      const CellPoint<dim> point(shape, X, idealization);
      const auto           s      = deviator_at(point, material, u, thermal);
      const double         stress = von_mises(s) / scale;
      // The gradient is zero here, but stress^(p - 2) would be infinite for p < 2.
      if (stress == 0.)
        continue;
      // dS = dV of_strain : de
      // d sigma_vM^p = p sigma_vM^(p-2) 3/2 s : ds with ds = 2 mu dev de, and s : dev de = s : de
      // as s is deviatoric.
      dealii::SymmetricTensor<2, 3> of_strain =
        p * std::pow(stress, p - 2.) * 3. * material.lame_mu() / (scale * scale) * s;
      if (idealization.kind == mesh::Idealization::Kind::plane_stress)
        {
          // In plane stress e_zz depends on e_xx + e_yy, so its share of the flux goes to these
          // two.
          const double across =
            -material.poissons_ratio / (1. - material.poissons_ratio) * of_strain[2][2];
          of_strain[0][0] += across;
          of_strain[1][1] += across;
          of_strain[2][2] = 0.;
        }
      const dealii::Tensor<2, 3> flux = factor * of_strain;
      point.add_flux(flux, by_u);
      // (grad u)' = -grad u grad V at fixed u, and dV' = dV div V.
      point.add_flux(factor * std::pow(stress, p) * identity - transpose(point.gradient(u)) * flux,
                     by_X);
    }
}

template class VonMisesPower<2>;
template class VonMisesPower<3>;
} // namespace snug::elasticity
