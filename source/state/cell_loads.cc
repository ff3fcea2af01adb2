#include <snug/state/assembler.h>
#include <snug/state/thermal.h>

namespace snug::state {
template <int dim>
elasticity::ThermalStrain<dim> Assembler<dim>::thermal_strain(unsigned int i,
                                                              unsigned int load_case) const
{
  return state::thermal_strain<dim>(loads(load_case), material(i),
                                    cell_field(i, mesh.reference_positions()));
}

/// Check only whether the load case has a body force, because formulas are not evaluated.
template <int dim>
bool Assembler<dim>::has_body_force(unsigned int load_case) const
{
  return loads(load_case).has_force_per_volume();
}

template <int dim>
typename Assembler<dim>::Nodes Assembler<dim>::body_force(unsigned int i,
                                                          unsigned int load_case) const
{
  // The formula depends on the reference position, so the value moves with the material point.
  auto b = the_element.quadrature_points(cell_field(i, mesh.reference_positions()));
  for (auto &at : b)
    at = loads(load_case).force_per_volume(material(i), at);
  return b;
}

template <int dim>
bool Assembler<dim>::has_cell_loads(unsigned int load_case) const
{
  return !is_point() && (has_body_force(load_case) || loads(load_case).temperature);
}

template <int dim>
typename Assembler<dim>::Nodes
Assembler<dim>::cell_load(unsigned int i, const Nodes &X, unsigned int load_case) const
{
  Nodes f(X.size()), thermal(X.size());
  if (has_body_force(load_case))
    the_element.body_force(X, body_force(i, load_case), f);
  if (const auto strain = thermal_strain(i, load_case))
    the_element.thermal_force(X, material(i), strain, thermal);
  for (unsigned int a = 0; a < f.size(); ++a)
    f[a] += thermal[a];
  return f;
}

template <int dim>
typename Assembler<dim>::Nodes Assembler<dim>::cell_load_derivative(unsigned int i,
                                                                    const Nodes &X,
                                                                    const Nodes &V,
                                                                    unsigned int load_case) const
{
  Nodes f(X.size()), thermal(X.size());
  if (has_body_force(load_case))
    the_element.body_force_derivative(X, V, body_force(i, load_case), f);
  if (const auto strain = thermal_strain(i, load_case))
    the_element.thermal_force_derivative(X, V, material(i), strain, thermal);
  for (unsigned int a = 0; a < f.size(); ++a)
    f[a] += thermal[a];
  return f;
}

template <int dim>
void Assembler<dim>::add_cell_load_gradient(unsigned int i,
                                            const Nodes &X,
                                            unsigned int load_case,
                                            const Nodes &w,
                                            double       factor,
                                            Nodes       &gradient) const
{
  if (has_body_force(load_case))
    the_element.add_body_force_gradient(X, body_force(i, load_case), w, factor, gradient);
  if (const auto strain = thermal_strain(i, load_case))
    the_element.add_thermal_force_gradient(X, material(i), strain, w, factor, gradient);
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template elasticity::ThermalStrain<dim> Assembler<dim>::thermal_strain(unsigned int,             \
                                                                         unsigned int) const;      \
  template bool                           Assembler<dim>::has_cell_loads(unsigned int) const;      \
  template Assembler<dim>::Nodes          Assembler<dim>::cell_load(unsigned int, const Nodes &,   \
                                                                    unsigned int) const;           \
  template Assembler<dim>::Nodes Assembler<dim>::cell_load_derivative(unsigned int, const Nodes &, \
                                                                      const Nodes &, unsigned int) \
    const;                                                                                         \
  template void Assembler<dim>::add_cell_load_gradient(unsigned int, const Nodes &, unsigned int,  \
                                                       const Nodes &, double, Nodes &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
