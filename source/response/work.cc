#include <snug/response/work.h>
#include <snug/state/cell_gradients.h>

namespace snug::response {
template <int dim>
Work<dim>::Work(double State::*value, double stiffness, double load)
  : member(value), stiffness(stiffness), load(load)
{}

template <int dim>
bool Work<dim>::stationary() const
{
  return stiffness == 1. && load == -1.;
}

template <int dim>
double Work<dim>::value(const state::StateSolver<dim> &, const State &state) const
{
  return state.*member;
}

template <int dim>
Partials<dim> Work<dim>::partials(const state::StateSolver<dim> &solver, const State &state) const
{
  Partials<dim> result;
  result.positions.resize(solver.mesh().n_local_nodes());
  const auto f = solver.loads(state.positions, state.load_case);
  for (unsigned int s = 0; s < state.u.size(); ++s)
    {
      result.u.emplace_back(state.u[s].n_rows());
      result.u.back().add(load, f[s]);
      if (stiffness != 0.)
        solver.feti().subdomains()[s].K.multiply_add(stiffness, state.u[s], result.u.back());
    }
  if (stiffness != 0.)
    state::add_stiffness_gradient(solver, state, state.u, stiffness / 2., result.positions);
  if (load != 0.)
    state::add_load_gradient(solver, state, state.u, load, result.positions);
  return result;
}

template class Work<2>;
template class Work<3>;
} // namespace snug::response
