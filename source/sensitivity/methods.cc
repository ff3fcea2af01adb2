#include <snug/sensitivity/data_derivatives.h>
#include <snug/sensitivity/methods.h>
#include <snug/sensitivity/residual_gradient.h>
#include <snug/sensitivity/tangent_system.h>
#include <snug/state/cell_gradients.h>
#include <snug/state/contact_results.h>

namespace snug::sensitivity {
using response::Partials;

namespace {
template <int dim>
TangentSystem tangent_system(const state::StateSolver<dim>  &solver,
                             const state::ContactState<dim> &state,
                             const Solves                    solves,
                             const qp::SolverParameters     &parameters)
{
  return TangentSystem(solver.feti(state), strong_rows(solver, state), parameters, solves,
                       state.dual.directions);
}

/// Add row i of the products (adjoint, residual derivatives) to @p values.
void add_row(const qp::MultiVector &products, unsigned int i, std::vector<double> &values)
{
  for (unsigned int j = 0; j < values.size(); ++j)
    values[j] += products(i, j);
}
} // namespace

template <int dim>
bool needs_solve(const response::Response<dim> &response)
{
  return response.needs_solution() && !response.stationary();
}

template <int dim>
std::vector<Partials<dim>> partials_of(const GradientProblem<dim> &problem,
                                       const Responses<dim>       &responses)
{
  std::vector<Partials<dim>> partials;
  for (const auto *response : responses)
    partials.push_back(response->partials(problem.solver, problem.state));
  return partials;
}

template <int dim>
KktVectors state_partials(const state::StateSolver<dim>    &solver,
                          const state::ContactState<dim>   &state,
                          const std::vector<Partials<dim>> &partials)
{
  const auto  &of_contact = solver.gluing(state.load_case).contact_of_row();
  const auto  &scales     = solver.gluing(state.load_case).contact_scales();
  KktVectors   result;
  unsigned int k = partials.size();
  result.dual    = qp::MultiVector(state.dual.lambda.n_rows(), k);
  for (const auto &u : state.u)
    result.primal.emplace_back(u.n_rows(), k);
  for (unsigned int j = 0; j < k; ++j)
    {
      for (unsigned int s = 0; s < partials[j].u.size(); ++s)
        std::copy_n(partials[j].u[s].column(0), partials[j].u[s].n_rows(),
                    result.primal[s].column(j));
      if (!partials[j].forces.empty())
        for (unsigned int i = 0; i < of_contact.size(); ++i)
          if (of_contact[i] < scales.size())
            result.dual(i, j) = partials[j].forces[of_contact[i]] / scales[of_contact[i]];
    }
  return result;
}

template <int dim>
KktVectors adjoint_states(const state::StateSolver<dim>    &solver,
                          const state::ContactState<dim>   &state,
                          const std::vector<Partials<dim>> &partials,
                          const Solves                      solves,
                          const qp::SolverParameters       &parameters)
{
  return tangent_system(solver, state, solves, parameters)
    .solve(state_partials(solver, state, partials));
}

template <int dim>
KktVectors residual_derivatives(const GradientProblem<dim> &problem)
{
  std::vector<mesh::Field<dim>> velocities;
  for (unsigned int j = 0; j < problem.basis.n_variables(); ++j)
    velocities.push_back(problem.basis.column(j));
  return data_derivatives(problem.solver, problem.state, velocities, problem.parameters);
}

template <int dim>
KktVectors state_derivatives(const GradientProblem<dim> &problem)
{
  return tangent_system(problem.solver, problem.state, problem.parameters.solves,
                        problem.solver.model().solver)
    .solve(residual_derivatives(problem));
}

template <int dim>
Gradients<dim> energy_gradients(const GradientProblem<dim> &problem,
                                const Responses<dim>       &responses)
{
  const bool     exact = problem.parameters.derivatives == Derivatives::exact;
  Gradients<dim> result;
  for (const auto *response : responses)
    {
      if (needs_solve(*response))
        throw InputError("entry 'Gradient/Method' = 'energy': the "
                         "response has no gradient without a solve; use "
                         "'adjoint' or 'direct'");
      auto field = response->partials(problem.solver, problem.state).positions;
      if (response->stationary() && exact)
        state::add_constraint_gradient(problem.solver, problem.state, field);
      Gradient<dim> gradient{Method::energy, "", problem.basis.transpose(field)};
      if (response->stationary() && !exact)
        {
          KktVectors adjoint; // w = 0, eta = -lambda
          adjoint.dual = qp::MultiVector(problem.state.dual.lambda.n_rows());
          adjoint.dual.add(-1., problem.state.dual.lambda);
          add_row(products(adjoint, residual_derivatives(problem),
                           problem.solver.context().communicator()),
                  0, gradient.values);
        }
      else
        gradient.shape = field;
      result.of_response.push_back(gradient);
    }
  return result;
}

template <int dim>
Gradients<dim> adjoint_gradients(const GradientProblem<dim> &problem,
                                 const Responses<dim>       &responses)
{
  auto            partials = partials_of(problem, responses);
  const auto      adjoint  = adjoint_states(problem.solver, problem.state, partials,
                                            problem.parameters.solves, problem.solver.model().solver);
  const bool      exact    = problem.parameters.derivatives == Derivatives::exact;
  qp::MultiVector through_state;
  if (!exact)
    through_state =
      products(adjoint, residual_derivatives(problem), problem.solver.context().communicator());
  Gradients<dim> result;
  for (unsigned int i = 0; i < responses.size(); ++i)
    {
      auto &field = partials[i].positions;
      if (exact)
        add_residual_gradient(problem.solver, problem.state, adjoint, i, field);
      Gradient<dim> gradient{Method::adjoint, "", problem.basis.transpose(field)};
      if (exact)
        gradient.shape = field;
      else
        add_row(through_state, i, gradient.values);
      result.of_response.push_back(gradient);
    }
  return result;
}

template <int dim>
Gradients<dim> direct_gradients(const GradientProblem<dim> &problem,
                                const Responses<dim>       &responses)
{
  const auto     partials      = partials_of(problem, responses);
  const auto     derivatives   = state_derivatives(problem);
  const auto     through_state = products(state_partials(problem.solver, problem.state, partials),
                                          derivatives, problem.solver.context().communicator());
  Gradients<dim> result;
  for (unsigned int i = 0; i < responses.size(); ++i)
    {
      result.of_response.push_back(
        {Method::direct, "", problem.basis.transpose(partials[i].positions)});
      add_row(through_state, i, result.of_response[i].values);
    }
  for (unsigned int j = 0; j < problem.basis.n_variables(); ++j)
    result.displacement.push_back(state::nodal_values(problem.solver, derivatives.primal, j));
  const auto &gluing = problem.solver.gluing(problem.state.load_case);
  const auto &scales = gluing.contact_scales();
  for (unsigned int j = 0; j < problem.basis.n_variables(); ++j)
    {
      auto forces = gluing.gather_contact(derivatives.dual.column(j));
      for (unsigned int i = 0; i < forces.size(); ++i)
        forces[i] = scales[i] == 0. ? 0. : forces[i] / scales[i];
      result.forces.push_back(std::move(forces));
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template bool                       needs_solve(const response::Response<dim> &);                \
  template std::vector<Partials<dim>> partials_of(const GradientProblem<dim> &,                    \
                                                  const Responses<dim> &);                         \
  template KktVectors                 state_partials(const state::StateSolver<dim> &,              \
                                                     const state::ContactState<dim> &,             \
                                                     const std::vector<Partials<dim>> &);          \
  template KktVectors                 adjoint_states(const state::StateSolver<dim> &,              \
                                                     const state::ContactState<dim> &,             \
                                                     const std::vector<Partials<dim>> &, Solves,   \
                                                     const qp::SolverParameters &);                \
  template KktVectors                 residual_derivatives(const GradientProblem<dim> &);          \
  template KktVectors                 state_derivatives(const GradientProblem<dim> &);             \
  template Gradients<dim> energy_gradients(const GradientProblem<dim> &, const Responses<dim> &);  \
  template Gradients<dim> adjoint_gradients(const GradientProblem<dim> &, const Responses<dim> &); \
  template Gradients<dim> direct_gradients(const GradientProblem<dim> &, const Responses<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
