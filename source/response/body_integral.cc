#include <snug/response/body_integral.h>
#include <snug/state/cell_gradients.h>

#include <deal.II/base/mpi.h>

namespace snug::response {
template <int dim>
BodyIntegral<dim>::BodyIntegral(const ResponseParameters &parameters, const Weight weight)
  : body(parameters.body), weight(weight)
{}

/// Density is a constant of the region: it goes with the cell and has no derivative.
template <int dim>
double BodyIntegral<dim>::weight_of(const elasticity::Material &material) const
{
  return weight == Weight::density ? material.density : 1.;
}

template <int dim>
double BodyIntegral<dim>::value(const state::StateSolver<dim>  &solver,
                                const state::ContactState<dim> &state) const
{
  double     integral = 0.;
  const auto add      = [&](unsigned int s, unsigned int i) {
    const auto &assembler = *solver.assemblers()[s];
    integral += weight_of(assembler.material(i)) *
                assembler.element().volume(assembler.cell_field(i, state.positions));
  };
  state::for_each_cell<dim>(solver, body, add);
  // Each cell is on one rank, so that the sum counts it once.
  return dealii::Utilities::MPI::sum(integral, solver.context().communicator());
}

/// u and forces stay empty, which stands for zero.
template <int dim>
Partials<dim> BodyIntegral<dim>::partials(const state::StateSolver<dim>  &solver,
                                          const state::ContactState<dim> &state) const
{
  Partials<dim> result;
  result.positions.resize(solver.mesh().n_local_nodes());
  const auto add = [&](unsigned int s, unsigned int i) {
    const auto                         &assembler = *solver.assemblers()[s];
    const auto                          X         = assembler.cell_field(i, state.positions);
    std::vector<dealii::Tensor<1, dim>> values(X.size());
    // d/dX int dV, det J and, in axisymmetric models, the radius included
    assembler.element().add_volume_gradient(X, weight_of(assembler.material(i)), values);
    state::add_to_cell_nodes(solver, s, i, values, result.positions);
  };
  state::for_each_cell<dim>(solver, body, add);
  return result;
}

template class BodyIntegral<2>;
template class BodyIntegral<3>;
} // namespace snug::response
