#include <snug/elasticity/element.h>

namespace snug::elasticity {
namespace {
const dealii::SymmetricTensor<2, 3> unit_strain = dealii::unit_symmetric_tensor<3>();

bool is_sheet(const mesh::Idealization &idealization)
{
  return idealization.kind == mesh::Idealization::Kind::plane_stress;
}

/// Return beta, the stress that holds a unit thermal strain: E / (1 - nu) in a sheet, where the
/// stress across it is zero, else E / (1 - 2 nu).
double stress_per_strain(const mesh::Idealization &idealization, const Material &material)
{
  const double nu = material.poissons_ratio;
  return material.youngs_modulus / (1. - (is_sheet(idealization) ? nu : 2. * nu));
}
} // namespace

/// Project the strains like the dilatation div u, from which 3 alpha dT is subtracted.
template <int dim>
std::vector<double> Element<dim>::thermal_strains(const std::vector<CellPoint<dim>> &points,
                                                  const ThermalStrain<dim>          &thermal) const
{
  std::vector<double> strains;
  for (const auto &point : points)
    strains.push_back(thermal(point.shape));
  take_dilatation(points, strains);
  return strains;
}

template <int dim>
void Element<dim>::subtract_thermal(const std::vector<CellPoint<dim>>          &points,
                                    const Material                             &material,
                                    const ThermalStrain<dim>                   &thermal,
                                    std::vector<dealii::SymmetricTensor<2, 3>> &stresses) const
{
  auto held = unit_strain;
  if (is_sheet(idealization))
    held[2][2] = 0.;
  const auto   strains = thermal_strains(points, thermal);
  const double beta    = stress_per_strain(idealization, material);
  for (unsigned int i = 0; i < stresses.size(); ++i)
    // The points with stresses are the last ones.
    stresses[i] -= beta * strains[strains.size() - stresses.size() + i] * held;
}

template <int dim>
void Element<dim>::thermal_force(const Nodes              &X,
                                 const Material           &material,
                                 const ThermalStrain<dim> &thermal,
                                 Nodes                    &f) const
{
  f.assign(n_nodes(), {});
  const auto   points  = gauss_points(X);
  const auto   strains = thermal_strains(points, thermal);
  const double beta    = stress_per_strain(idealization, material);
  for (unsigned int q = 0; q < points.size(); ++q)
    points[q].add_flux(beta * strains[q] * unit_strain, f);
}

template <int dim>
void Element<dim>::thermal_force_derivative(const Nodes              &X,
                                            const Nodes              &V,
                                            const Material           &material,
                                            const ThermalStrain<dim> &thermal,
                                            Nodes                    &f) const
{
  f.assign(n_nodes(), {});
  const auto                        points  = gauss_points(X);
  const auto                        strains = thermal_strains(points, thermal);
  const double                      beta    = stress_per_strain(idealization, material);
  std::vector<dealii::Tensor<2, 3>> grad_V;
  // (pi e)' = -pi ((pi e - e) div V), because e is fixed to the material, as in
  // internal_force_derivatives().
  std::vector<double> change;
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      grad_V.push_back(points[q].gradient(V));
      change.push_back(-(strains[q] - thermal(points[q].shape)) * trace(grad_V[q]));
    }
  take_dilatation(points, change);
  for (unsigned int q = 0; q < points.size(); ++q)
    points[q].add_flux(beta * ((change[q] + strains[q] * trace(grad_V[q])) *
                                 dealii::Tensor<2, 3>(unit_strain) -
                               strains[q] * transpose(grad_V[q])),
                       f);
}

/// Differentiate the stationary value int beta (pi e div w + e p - pi e p) dV over p = pi div w.
template <int dim>
void Element<dim>::add_thermal_force_gradient(const Nodes              &X,
                                              const Material           &material,
                                              const ThermalStrain<dim> &thermal,
                                              const Nodes              &w,
                                              const double              factor,
                                              Nodes                    &gradient) const
{
  const auto                        points  = gauss_points(X);
  const auto                        strains = thermal_strains(points, thermal);
  const double                      beta    = stress_per_strain(idealization, material);
  std::vector<dealii::Tensor<2, 3>> grad_w;
  std::vector<double>               dilatation;
  for (const auto &point : points)
    {
      grad_w.push_back(point.gradient(w));
      dilatation.push_back(trace(grad_w.back()));
    }
  take_dilatation(points, dilatation);
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      const double density =
        strains[q] * trace(grad_w[q]) - (strains[q] - thermal(points[q].shape)) * dilatation[q];
      points[q].add_flux(factor * beta *
                           (density * dealii::Tensor<2, 3>(unit_strain) -
                            strains[q] * transpose(grad_w[q])),
                         gradient);
    }
}

template <int dim>
double Element<dim>::thermal_energy(const Nodes              &X,
                                    const Material           &material,
                                    const ThermalStrain<dim> &thermal) const
{
  const auto   points  = gauss_points(X);
  const auto   strains = thermal_strains(points, thermal);
  const double beta    = stress_per_strain(idealization, material);
  double       sum     = 0.;
  for (unsigned int q = 0; q < points.size(); ++q)
    sum += strains[q] * strains[q] * points[q].dV;
  return 0.5 * (is_sheet(idealization) ? 2. : 3.) * beta * sum;
}

/// Differentiate the stationary value int (2 e p - p^2) dV over p = pi e.
template <int dim>
void Element<dim>::add_thermal_energy_gradient(const Nodes              &X,
                                               const Material           &material,
                                               const ThermalStrain<dim> &thermal,
                                               const double              factor,
                                               Nodes                    &gradient) const
{
  const auto   points  = gauss_points(X);
  const auto   strains = thermal_strains(points, thermal);
  const double beta    = stress_per_strain(idealization, material);
  for (unsigned int q = 0; q < points.size(); ++q)
    points[q].add_flux(factor * 0.5 * (is_sheet(idealization) ? 2. : 3.) * beta *
                         (2. * thermal(points[q].shape) - strains[q]) * strains[q] * unit_strain,
                       gradient);
}

#define SNUG_INSTANTIATE(dim)                                                                               \
  template std::vector<double> Element<dim>::thermal_strains(const std::vector<CellPoint<dim>> &,           \
                                                             const ThermalStrain<dim> &) const;             \
  template void                Element<dim>::subtract_thermal(const std::vector<CellPoint<dim>> &,          \
                                                              const Material &, const ThermalStrain<dim> &, \
                                                              std::vector<dealii::SymmetricTensor<2, 3>> &) \
    const;                                                                                                  \
  template void   Element<dim>::thermal_force(const Nodes &, const Material &,                              \
                                              const ThermalStrain<dim> &, Nodes &) const;                   \
  template void   Element<dim>::thermal_force_derivative(const Nodes &, const Nodes &,                      \
                                                         const Material &,                                  \
                                                         const ThermalStrain<dim> &, Nodes &) const;        \
  template void   Element<dim>::add_thermal_force_gradient(const Nodes &, const Material &,                 \
                                                           const ThermalStrain<dim> &,                      \
                                                           const Nodes &, double, Nodes &) const;           \
  template double Element<dim>::thermal_energy(const Nodes &, const Material &,                             \
                                               const ThermalStrain<dim> &) const;                           \
  template void   Element<dim>::add_thermal_energy_gradient(const Nodes &, const Material &,                \
                                                            const ThermalStrain<dim> &, double,             \
                                                            Nodes &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::elasticity
