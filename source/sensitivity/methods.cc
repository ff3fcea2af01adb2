#include <snug/sensitivity/data_derivatives.h>
#include <snug/sensitivity/load_steps.h>
#include <snug/sensitivity/methods.h>
#include <snug/sensitivity/tangent_system.h>
#include <snug/state/cell_gradients.h>
#include <snug/state/contact_results.h>
#include <snug/state/point_results.h>

#include <algorithm>

namespace snug::sensitivity {
using response::Partials;

template <int dim>
bool needs_solve(const response::Response<dim> &response, const bool has_potential)
{
  return response.needs_solution() && (!has_potential || !response.stationary());
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
  result.primal  = feti::PrimalVectors(k);
  for (const auto &u : state.u)
    result.primal.emplace_back(u.n_rows());
  for (unsigned int j = 0; j < k; ++j)
    {
      for (unsigned int s = 0; s < partials[j].u.size(); ++s)
        std::copy_n(partials[j].u[s].column(0), partials[j].u[s].n_rows(),
                    result.primal[s].column(j));
      if (!partials[j].forces.empty())
        for (unsigned int i = 0; i < of_contact.size(); ++i)
          if (of_contact[i] < partials[j].forces.size())
            result.dual(i, j) = partials[j].forces[of_contact[i]] / scales[of_contact[i]];
    }
  if (std::any_of(partials.begin(), partials.end(),
                  [](const auto &of) { return !of.slips.empty(); }))
    result.primal.add(1., solver.feti(state).linearization().multiply_Bt(
                            slip_partials(solver, state, partials)));
  return result;
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
KktVectors state_derivatives(const GradientProblem<dim> &problem, const KktVectors &data)
{
  const auto &[solver, basis, state, design, widths, parameters] = problem;
  auto linear                                                    = solver.model().solver;
  linear.relative_tolerance = std::max(linear.relative_tolerance, parameters.state_tolerance);
  return TangentSystem(solver.feti(state), strong_rows(solver, state), linear, parameters.solves,
                       state.dual.directions)
    .solve(data);
}

template <int dim>
Gradients<dim> energy_gradients(const LoadCases<dim>         &load_cases,
                                const MeasuredResponses<dim> &measured)
{
  Gradients<dim> result;
  for (const auto &[response, load_case] : measured)
    {
      const auto &problem = load_cases[load_case];
      problem.solver.restore(problem.state);
      const bool exact = problem.parameters.derivatives == Derivatives::exact;
      if (needs_solve(*response, problem.solver.has_potential()))
        throw bad_entry("Gradient/Method", "energy",
                        std::string("the response has no gradient without a solve") +
                          (response->stationary()
                             ? ", because friction and locked bolts have no potential"
                             : "") +
                          "; use 'adjoint' or 'direct'");
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

namespace {
/// Add u' and the derivatives of the normal forces to @p result.
template <int dim>
void add_state_derivatives(const GradientProblem<dim> &problem,
                           const KktVectors           &derivatives,
                           Gradients<dim>             &result)
{
  const auto &gluing = problem.solver.gluing(problem.state.load_case);
  for (unsigned int j = 0; j < problem.basis.n_variables(); ++j)
    result.displacement.push_back(state::nodal_values(problem.solver, derivatives.primal, j));
  for (auto &forces : gluing.contact_forces(derivatives.dual))
    {
      forces.resize(gluing.n_contact_rows());
      result.forces.push_back(std::move(forces));
    }
}
} // namespace

template <int dim>
Gradients<dim> direct_gradients(const LoadCases<dim>         &load_cases,
                                const MeasuredResponses<dim> &measured)
{
  Gradients<dim> result;
  result.of_response.resize(measured.size());
  const auto needed = needed_cases(load_cases, measured);
  // derivatives, of tangential rows and of the motions of reference points
  std::vector<qp::MultiVector> slips(load_cases.size()), motions(load_cases.size());
  for (unsigned int k = 0; k < load_cases.size(); ++k)
    {
      if (!needed[k])
        continue;
      const auto &problem = load_cases[k];
      problem.solver.restore(problem.state);
      const auto &feti  = problem.solver.feti(problem.state);
      auto        data  = residual_derivatives(problem);
      auto        rates = data.dual; // B_T u' + B_T' u - g'
      if (const auto before = step_before(load_cases, k))
        {
          data.dual.add(1., with_rows(slips[*before], feti.n_owned()));
          const auto c     = problem.state.load_case;
          const auto first = problem.solver.contact(c).tangents().size();
          for (const auto &[row, place] : problem.solver.gluing(c).locked_rows(c))
            for (unsigned int j = 0; j < data.dual.n_columns(); ++j)
              data.dual(row, j) += motions[*before](place - first, j);
        }
      const auto derivatives = state_derivatives(problem, data);
      motions[k]             = state::own_point_motions(problem.solver, derivatives.primal);
      slips[k]               = feti.linearization().multiply_B(derivatives.primal);
      slips[k].add(-1., rates);
      keep_tangents(feti, slips[k]);
      const auto [places, responses] = responses_of(measured, k);
      const auto     partials        = partials_of(problem, responses);
      const MPI_Comm comm            = problem.solver.context().communicator();
      auto           through_state =
        products(state_partials(problem.solver, problem.state, partials), derivatives, comm);
      // The slip of this step is relative to the one before, and changes with B and g.
      through_state.add(-1.,
                        qp::inner_products(slip_partials(problem.solver, problem.state, partials),
                                           data.dual, comm));
      for (unsigned int i = 0; i < places.size(); ++i)
        {
          auto &gradient = result.of_response[places[i]];
          gradient       = {Method::direct, "", problem.basis.transpose(partials[i].positions)};
          add_row(through_state, i, gradient.values);
        }
      add_state_derivatives(problem, derivatives, result);
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                                  \
  template bool                       needs_solve(const response::Response<dim> &, bool);      \
  template std::vector<Partials<dim>> partials_of(const GradientProblem<dim> &,                \
                                                  const Responses<dim> &);                     \
  template KktVectors                 state_partials(const state::StateSolver<dim> &,          \
                                                     const state::ContactState<dim> &,         \
                                                     const std::vector<Partials<dim>> &);      \
  template KktVectors                 residual_derivatives(const GradientProblem<dim> &);      \
  template KktVectors     state_derivatives(const GradientProblem<dim> &, const KktVectors &); \
  template Gradients<dim> energy_gradients(const LoadCases<dim> &,                             \
                                           const MeasuredResponses<dim> &);                    \
  template Gradients<dim> direct_gradients(const LoadCases<dim> &, const MeasuredResponses<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
