#include <snug/base/narrow.h>
#include <snug/sensitivity/data_derivatives.h>
#include <snug/sensitivity/methods.h>
#include <snug/sensitivity/residual_gradient.h>
#include <snug/sensitivity/tangent_system.h>
#include <snug/state/cell_gradients.h>
#include <snug/state/contact_results.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <map>

namespace snug::sensitivity {
using response::Partials;

namespace {
/// Add row i of the products (adjoint, residual derivatives) to @p values.
void add_row(const qp::MultiVector &products, unsigned int i, std::vector<double> &values)
{
  for (unsigned int j = 0; j < values.size(); ++j)
    values[j] += products(i, j);
}
} // namespace

template <int dim>
bool needs_solve(const response::Response<dim> &response, const bool with_friction)
{
  return response.needs_solution() && (with_friction || !response.stationary());
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

namespace {
/// Return dJ/d(slips) of the tangential rows in the units of the dual rows, one column per
/// response.
template <int dim>
qp::MultiVector by_slips(const state::StateSolver<dim>    &solver,
                         const state::ContactState<dim>   &state,
                         const std::vector<Partials<dim>> &partials)
{
  const auto        &gluing     = solver.gluing(state.load_case);
  const auto        &of_contact = gluing.contact_of_row();
  const unsigned int n = gluing.n_contact_rows(), k = narrow<unsigned int>(partials.size());
  qp::MultiVector    result(narrow<unsigned int>(of_contact.size()), k);
  for (unsigned int j = 0; j < k; ++j)
    for (unsigned int i = 0; !partials[j].slips.empty() && i < of_contact.size(); ++i)
      if (of_contact[i] >= n && of_contact[i] < n + partials[j].slips.size())
        // The row of B is divided by its scale.
        result(i, j) =
          partials[j].slips[of_contact[i] - n] * gluing.contact_scales()[of_contact[i]];
  return result;
}
} // namespace

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
          if (of_contact[i] < partials[j].forces.size())
            result.dual(i, j) = partials[j].forces[of_contact[i]] / scales[of_contact[i]];
    }
  if (std::any_of(partials.begin(), partials.end(),
                  [](const auto &of) { return !of.slips.empty(); }))
    {
      const auto through_slips =
        solver.feti(state).linearization().multiply_Bt(by_slips(solver, state, partials));
      for (unsigned int s = 0; s < through_slips.size(); ++s)
        result.primal[s].add(1., through_slips[s]);
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
  return TangentSystem(solver.feti(state), strong_rows(solver, state).transpose(), parameters,
                       solves, state.dual.directions)
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
KktVectors state_derivatives(const GradientProblem<dim> &problem, const KktVectors &data)
{
  const auto &[solver, basis, state, design, widths, parameters] = problem;
  return TangentSystem(solver.feti(state), strong_rows(solver, state), solver.model().solver,
                       parameters.solves, state.dual.directions)
    .solve(data);
}

template <int dim>
std::optional<unsigned int> step_before(const LoadCases<dim> &load_cases, const unsigned int k)
{
  const auto &problem = load_cases[k];
  const auto &after   = problem.solver.model().load_cases[problem.state.load_case].after;
  if (!after)
    return {};
  for (unsigned int other = 0; other < k; ++other)
    if (load_cases[other].state.load_case == *after)
      return other;
  AssertThrow(false, dealii::ExcMessage("the step before a load step is missing"));
  return {};
}

template <int dim>
std::vector<bool> needed_cases(const LoadCases<dim>         &load_cases,
                               const MeasuredResponses<dim> &measured)
{
  std::vector<bool> needed(load_cases.size(), false);
  for (const auto &[response, load_case] : measured)
    needed[load_case] = true;
  for (unsigned int k = narrow<unsigned int>(load_cases.size()); k-- > 0;)
    if (const auto before = step_before(load_cases, k); needed[k] && before)
      needed[*before] = true;
  return needed;
}

namespace {
/// Set the rows of x to zero that are not tangential rows of contact.
void keep_tangents(const feti::LoadedProblem &feti, qp::MultiVector &x)
{
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    for (unsigned int i = 0; i < x.n_rows(); ++i)
      if (!feti.linearization().contact_rows()[i] || feti.bounded()[i])
        x(i, j) = 0.;
}

/// Return the places in @p measured of the responses of load case @p k, and the responses.
template <int dim>
std::pair<std::vector<unsigned int>, Responses<dim>>
responses_of(const MeasuredResponses<dim> &measured, const unsigned int k)
{
  std::pair<std::vector<unsigned int>, Responses<dim>> result;
  for (unsigned int i = 0; i < measured.size(); ++i)
    if (measured[i].load_case == k)
      {
        result.first.push_back(i);
        result.second.push_back(measured[i].response);
      }
  return result;
}

/// The adjoint method at one load case after the other, from the last to the first.
template <int dim>
class AdjointSweep
{
public:
  AdjointSweep(const LoadCases<dim> &load_cases, const MeasuredResponses<dim> &measured)
    : load_cases(load_cases), measured(measured), of_slips(load_cases.size())
  {
    result.of_response.resize(measured.size());
    for (auto &gradient : result.of_response)
      gradient.method = Method::adjoint;
    fields.resize(measured.size());
  }

  Gradients<dim> run()
  {
    const auto needed = needed_cases(load_cases, measured);
    for (unsigned int k = narrow<unsigned int>(load_cases.size()); k-- > 0;)
      if (needed[k])
        add(k);
    for (unsigned int i = 0; i < measured.size(); ++i)
      {
        const auto &basis    = load_cases.front().basis;
        auto       &gradient = result.of_response[i];
        auto        values   = basis.transpose(fields[i]);
        for (unsigned int j = 0; j < gradient.values.size(); ++j)
          values[j] += gradient.values[j];
        gradient.values = values;
        if (load_cases.front().parameters.derivatives == Derivatives::exact)
          gradient.shape = fields[i];
      }
    return std::move(result);
  }

private:
  const LoadCases<dim>         &load_cases;
  const MeasuredResponses<dim> &measured;
  Gradients<dim>                result;
  std::vector<mesh::Field<dim>> fields; ///< dJ/dX
  /// dJ/d(slips) at the end of each load case, by response, as far as later steps depend on them
  std::vector<std::map<unsigned int, qp::MultiVector>> of_slips;

  void add(const unsigned int k)
  {
    const auto &problem = load_cases[k];
    problem.solver.restore(problem.state);
    const auto &feti         = problem.solver.feti(problem.state);
    auto [places, responses] = responses_of(measured, k);
    auto partials            = partials_of(problem, responses);
    // Responses of later load steps depend on this state through its slips.
    for (const auto &[i, slips] : of_slips[k])
      if (std::find(places.begin(), places.end(), i) == places.end())
        {
          places.push_back(i);
          partials.emplace_back();
          partials.back().positions.resize(problem.solver.mesh().n_points());
        }
    const auto      of_step = by_slips(problem.solver, problem.state, partials);
    qp::MultiVector slips(feti.n_owned(), 0); // at the end of the step
    for (const unsigned int i : places)
      slips.append(of_slips[k].count(i) > 0 ? of_slips[k][i] : qp::MultiVector(feti.n_owned()));
    auto       right = state_partials(problem.solver, problem.state, partials);
    const auto B     = feti.linearization().multiply_Bt(slips);
    slips.add(1., of_step);
    for (unsigned int s = 0; s < right.primal.size(); ++s)
      right.primal[s].add(1., B[s]);
    auto adjoint = TangentSystem(feti, strong_rows(problem.solver, problem.state).transpose(),
                                 problem.solver.model().solver, problem.parameters.solves,
                                 problem.state.dual.directions)
                     .solve(right);
    if (const auto before = step_before(load_cases, k))
      for (unsigned int column = 0; column < places.size(); ++column)
        {
          auto eta = adjoint.dual.columns_from(column, 1);
          keep_tangents(feti, eta);
          // The slip of this step is relative to the one before.
          eta.add(-1., of_step.columns_from(column, 1));
          auto &sum = of_slips[*before].try_emplace(places[column], feti.n_owned()).first->second;
          sum.add(1., eta);
        }
    // eta'(g' - B'u) of this step, and slips'(B'u - g') of the next steps
    adjoint.dual.add(-1., slips);
    add_data(problem, adjoint, places, partials);
    of_slips[k].clear();
  }

  void add_data(const GradientProblem<dim>       &problem,
                const KktVectors                 &adjoint,
                const std::vector<unsigned int>  &places,
                const std::vector<Partials<dim>> &partials)
  {
    const bool      exact = problem.parameters.derivatives == Derivatives::exact;
    qp::MultiVector through_state;
    if (!exact)
      through_state =
        products(adjoint, residual_derivatives(problem), problem.solver.context().communicator());
    for (unsigned int column = 0; column < places.size(); ++column)
      {
        const unsigned int i     = places[column];
        auto               field = partials[column].positions;
        if (exact)
          add_residual_gradient(problem.solver, problem.state, adjoint, column, field);
        else
          {
            result.of_response[i].values.resize(problem.basis.n_variables(), 0.);
            add_row(through_state, column, result.of_response[i].values);
          }
        fields[i].resize(field.size());
        for (unsigned int point = 0; point < field.size(); ++point)
          fields[i][point] += field[point];
      }
  }
};
} // namespace

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
      if (needs_solve(*response, problem.solver.has_friction()))
        throw InputError(std::string("entry 'Gradient/Method' = 'energy': the response has no "
                                     "gradient without a solve") +
                         (response->stationary() ? ", because friction has no potential" : "") +
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

template <int dim>
Gradients<dim> adjoint_gradients(const LoadCases<dim>         &load_cases,
                                 const MeasuredResponses<dim> &measured)
{
  return AdjointSweep<dim>(load_cases, measured).run();
}

namespace {
/// Add u' and the derivatives of the normal forces to @p result.
template <int dim>
void add_state_derivatives(const GradientProblem<dim> &problem,
                           const KktVectors           &derivatives,
                           Gradients<dim>             &result)
{
  const auto &gluing = problem.solver.gluing(problem.state.load_case);
  const auto &scales = gluing.contact_scales();
  for (unsigned int j = 0; j < problem.basis.n_variables(); ++j)
    {
      result.displacement.push_back(state::nodal_values(problem.solver, derivatives.primal, j));
      auto forces = gluing.gather_contact(derivatives.dual.column(j));
      forces.resize(gluing.n_contact_rows());
      for (unsigned int i = 0; i < forces.size(); ++i)
        forces[i] = scales[i] == 0. ? 0. : forces[i] / scales[i];
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
  const auto                   needed = needed_cases(load_cases, measured);
  std::vector<qp::MultiVector> slips(load_cases.size()); // derivatives, of tangential rows
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
        data.dual.add(1., slips[*before]);
      const auto derivatives = state_derivatives(problem, data);
      slips[k]               = feti.linearization().multiply_B(derivatives.primal);
      slips[k].add(-1., rates);
      keep_tangents(feti, slips[k]);
      const auto [places, responses] = responses_of(measured, k);
      const auto     partials        = partials_of(problem, responses);
      const MPI_Comm comm            = problem.solver.context().communicator();
      auto           through_state =
        products(state_partials(problem.solver, problem.state, partials), derivatives, comm);
      // The slip of this step is relative to the one before, and changes with B and g.
      through_state.add(-1., qp::inner_products(by_slips(problem.solver, problem.state, partials),
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

#define SNUG_INSTANTIATE(dim)                                                                      \
  template bool                       needs_solve(const response::Response<dim> &, bool);          \
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
  template KktVectors state_derivatives(const GradientProblem<dim> &, const KktVectors &);         \
  template std::optional<unsigned int> step_before(const LoadCases<dim> &, unsigned int);          \
  template std::vector<bool> needed_cases(const LoadCases<dim> &, const MeasuredResponses<dim> &); \
  template Gradients<dim>    energy_gradients(const LoadCases<dim> &,                              \
                                              const MeasuredResponses<dim> &);                     \
  template Gradients<dim>    adjoint_gradients(const LoadCases<dim> &,                             \
                                               const MeasuredResponses<dim> &);                    \
  template Gradients<dim> direct_gradients(const LoadCases<dim> &, const MeasuredResponses<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
