#include <snug/sensitivity/friction_increments.h>
#include <snug/sensitivity/methods.h>
#include <snug/sensitivity/one_sided.h>
#include <snug/sensitivity/sensitivity_qp.h>
#include <snug/sensitivity/tangent_system.h>

namespace snug::sensitivity {
namespace {
KktVectors column_of(const KktVectors &x, unsigned int j)
{
  KktVectors column;
  column.primal = x.primal.columns_from(j, 1);
  column.dual   = x.dual.columns_from(j, 1);
  if (x.given.n_columns() > 0)
    column.given = x.given.columns_from(j, 1);
  return column;
}

/// Compute x <- [x, -x].
template <typename Vectors>
void append_negative(Vectors &x)
{
  auto negative = x;
  negative.add(-2., x);
  x.append(negative);
}

template <int dim>
qp::RowSet weak_rows(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state)
{
  qp::RowSet  rows       = solver.feti(state).bounded();
  const auto &of_contact = solver.gluing(state.load_case).contact_of_row();
  for (unsigned int i = 0; i < rows.size(); ++i)
    rows[i] = rows[i] && state.contact[of_contact[i]].weak;
  return rows;
}

/// Return the solution of @p problem. The solver starts from @p linear, the
/// derivative with open weak contacts.
KktVectors solve_from(const SensitivityQp        &problem,
                      const feti::LoadedProblem  &feti,
                      const qp::SolverParameters &parameters,
                      const KktVectors           &data,
                      const KktVectors           &linear)
{
  auto closing = feti.linearization().multiply_B(linear.primal);
  closing.add(-1., data.dual);
  closing = problem.restricted(closing);
  qp::WarmStart start{problem.restricted(linear.dual), {}};
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    start.active.push_back(!problem.bounded()[i] || closing(i) > 0.);
  const auto solved =
    choose(qp::solver_table(), parameters.method).make(parameters)->solve(problem, start);
  KktVectors result;
  result.dual   = problem.extended(solved.lambda);
  result.primal = feti.linearization().recover(data.primal, result.dual, solved.amplitudes);
  return result;
}
} // namespace

template <int dim>
KktVectors directional_derivatives(const state::StateSolver<dim>  &solver,
                                   const state::ContactState<dim> &state,
                                   const KktVectors               &data)
{
  const auto &feti       = solver.feti(state);
  const auto &parameters = solver.model().solver;
  const auto  strong     = strong_rows(solver, state);
  const auto  weak       = weak_rows(solver, state);
  auto        linear =
    TangentSystem(feti, strong, parameters, Solves::block, state.dual.directions).solve(data);
  if (state.weak_contacts == 0)
    return linear;
  KktVectors result;
  result.dual   = qp::MultiVector(feti.n_owned(), 0);
  result.primal = data.primal.columns_from(0, 0);
  for (unsigned int j = 0; j < data.dual.n_columns(); ++j)
    {
      const auto data_j = column_of(data, j);
      const auto column = [&] {
        if (solver.has_friction())
          return friction_increments(solver, state, data_j);
        const SensitivityQp problem(feti, strong.rows(), weak, data_j);
        return solve_from(problem, feti, parameters, data_j, column_of(linear, j));
      }();
      result.dual.append(column.dual);
      result.primal.append(column.primal);
    }
  return result;
}

template <int dim>
std::vector<OneSided> one_sided_gradients(const GradientProblem<dim> &problem,
                                          const Responses<dim>       &responses)
{
  const unsigned int k    = problem.basis.n_variables();
  auto               both = residual_derivatives(problem);
  append_negative(both.dual);
  append_negative(both.given);
  append_negative(both.primal);
  const auto partials      = partials_of(problem, responses);
  const auto through_state = products(state_partials(problem.solver, problem.state, partials),
                                      directional_derivatives(problem.solver, problem.state, both),
                                      problem.solver.context().communicator());
  std::vector<OneSided> result;
  for (unsigned int i = 0; i < responses.size(); ++i)
    {
      const auto at_fixed_state = problem.basis.transpose(partials[i].positions);
      result.push_back({at_fixed_state, at_fixed_state});
      for (unsigned int j = 0; j < k; ++j)
        {
          result[i].increasing[j] += through_state(i, j);
          result[i].decreasing[j] -= through_state(i, k + j);
        }
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                              \
  template KktVectors            directional_derivatives(const state::StateSolver<dim> &,  \
                                                         const state::ContactState<dim> &, \
                                                         const KktVectors &);              \
  template std::vector<OneSided> one_sided_gradients(const GradientProblem<dim> &,         \
                                                     const Responses<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
