#include <snug/elasticity/cell_point.h>
#include <snug/state/cell_gradients.h>
#include <snug/state/thermal.h>

#include <deal.II/base/mpi.h>

namespace snug::state {
template <int dim>
elasticity::ThermalStrain<dim> thermal_strain(const BodyLoads<dim>                      &loads,
                                              const elasticity::Material                &material,
                                              const std::vector<dealii::Tensor<1, dim>> &X_0)
{
  if (!loads.temperature || material.expansion == 0.)
    return {};
  return [&loads, &material, X_0](const mesh::LagrangePoint<dim> &shape) {
    return material.expansion *
           loads.temperature(dealii::Point<dim>(elasticity::value(shape, X_0)));
  };
}

template <int dim>
bool has_temperature(const StateSolver<dim> &solver, const ContactState<dim> &state)
{
  for (const auto &body : solver.model().load_cases[state.load_case].bodies)
    if (body.temperature)
      return true;
  return false;
}

template <int dim>
feti::PrimalVectors thermal_loads(const StateSolver<dim> &solver, const ContactState<dim> &state)
{
  feti::PrimalVectors f;
  for (const auto &assembler : solver.assemblers())
    {
      f.emplace_back(assembler->n_dofs());
      for (unsigned int i = 0; i < assembler->cells().size(); ++i)
        if (const auto strain = assembler->thermal_strain(i, state.load_case))
          {
            std::vector<dealii::Tensor<1, dim>> r;
            assembler->element().thermal_force(assembler->cell_field(i, state.positions),
                                               assembler->material(i), strain, r);
            assembler->add_cell_vector(i, 1., r, f.back().column(0));
          }
    }
  return f;
}

template <int dim>
double thermal_energy(const StateSolver<dim> &solver, const ContactState<dim> &state)
{
  double sum = 0.;
  for (const auto &assembler : solver.assemblers())
    for (unsigned int i = 0; i < assembler->cells().size(); ++i)
      if (const auto strain = assembler->thermal_strain(i, state.load_case))
        sum += assembler->element().thermal_energy(assembler->cell_field(i, state.positions),
                                                   assembler->material(i), strain);
  return dealii::Utilities::MPI::sum(sum, solver.context().communicator());
}

template <int dim>
void add_thermal_gradient(const StateSolver<dim>              &solver,
                          const ContactState<dim>             &state,
                          const double                         work,
                          const double                         energy,
                          typename mesh::BodyMesh<dim>::Field &gradient)
{
  for_each_cell<dim>(solver, "", [&](unsigned int s, unsigned int i) {
    const auto &assembler = *solver.assemblers()[s];
    const auto  strain    = assembler.thermal_strain(i, state.load_case);
    if (!strain)
      return;
    const auto                          X = assembler.cell_field(i, state.positions);
    std::vector<dealii::Tensor<1, dim>> values(X.size());
    assembler.element().add_thermal_force_gradient(X, assembler.material(i), strain,
                                                   assembler.cell_values(i, state.u[s].column(0)),
                                                   work, values);
    assembler.element().add_thermal_energy_gradient(X, assembler.material(i), strain, energy,
                                                    values);
    add_to_cell_nodes(solver, s, i, values, gradient);
  });
}

#define SNUG_INSTANTIATE(dim)                                                                        \
  template elasticity::ThermalStrain<dim> thermal_strain(                                            \
    const BodyLoads<dim> &, const elasticity::Material &,                                            \
    const std::vector<dealii::Tensor<1, dim>> &);                                                    \
  template bool                has_temperature(const StateSolver<dim> &, const ContactState<dim> &); \
  template feti::PrimalVectors thermal_loads(const StateSolver<dim> &, const ContactState<dim> &);   \
  template double              thermal_energy(const StateSolver<dim> &, const ContactState<dim> &);  \
  template void add_thermal_gradient(const StateSolver<dim> &, const ContactState<dim> &, double,    \
                                     double, mesh::BodyMesh<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
