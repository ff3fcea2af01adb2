#include <snug/base/narrow.h>
#include <snug/sensitivity/bound_derivatives.h>
#include <snug/sensitivity/load_steps.h>
#include <snug/sensitivity/methods.h>
#include <snug/sensitivity/residual_gradient.h>
#include <snug/sensitivity/tangent_system.h>
#include <snug/state/point_results.h>

#include <algorithm>
#include <map>

namespace snug::sensitivity {
using response::Partials;

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

namespace {
/// The adjoint method at one load case after the other, from the last to the first.
template <int dim>
class AdjointSweep
{
public:
  AdjointSweep(const LoadCases<dim> &load_cases, const MeasuredResponses<dim> &measured)
    : load_cases(load_cases)
    , measured(measured)
    , of_slips(load_cases.size())
    , of_motions(load_cases.size())
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
  /// the same of motions that later steps lock
  std::vector<std::map<unsigned int, qp::MultiVector>> of_motions;

  void add(const unsigned int k)
  {
    const auto &problem = load_cases[k];
    problem.solver.restore(problem.state);
    const auto &feti         = problem.solver.feti(problem.state);
    auto [places, responses] = responses_of(measured, k);
    auto partials            = partials_of(problem, responses);
    // Responses of later load steps depend on this state through its slips and motions.
    for (const auto &[i, slips] : of_slips[k])
      if (std::find(places.begin(), places.end(), i) == places.end())
        {
          places.push_back(i);
          partials.emplace_back();
          partials.back().positions.resize(problem.solver.mesh().n_points());
        }
    const auto      of_step = slip_partials(problem.solver, problem.state, partials);
    qp::MultiVector slips(feti.n_owned(), 0); // at the end of the step
    auto            motions = state::own_point_motions(problem.solver, feti::PrimalVectors(0));
    const auto      append  = [](const auto &of, const unsigned int i, qp::MultiVector &to) {
      to.append(of.count(i) > 0 ? of.at(i) : qp::MultiVector(to.n_rows()));
    };
    for (const unsigned int i : places)
      {
        append(of_slips[k], i, slips);
        append(of_motions[k], i, motions);
      }
    auto right = state_partials(problem.solver, problem.state, partials);
    right.primal.add(1., feti.linearization().multiply_Bt(slips));
    state::add_point_motions(problem.solver, motions, right.primal);
    slips.add(1., of_step);
    auto adjoint = TangentSystem(feti, strong_rows(problem.solver, problem.state).transpose(),
                                 problem.solver.model().solver, problem.parameters.solves,
                                 problem.state.dual.directions)
                     .solve(right);
    if (const auto before = step_before(load_cases, k))
      for (unsigned int column = 0; column < places.size(); ++column)
        add_before(problem, *before, places[column], adjoint.dual.columns_from(column, 1),
                   of_step.columns_from(column, 1));
    if (has_bounds(problem.solver, problem.state))
      {
        // The change of a bound acts through the response and, as a load, through w.
        adjoint.given = right.dual;
        adjoint.given.add(-1., feti.linearization().multiply_B(adjoint.primal));
      }
    // eta'(g' - B'u) of this step, and slips'(B'u - g') of the next steps
    adjoint.dual.add(-1., slips);
    add_data(problem, adjoint, places, partials);
    of_slips[k].clear();
    of_motions[k].clear();
  }

  /// Add dJ/d(slips) and dJ/d(motions) at the end of the load step before that of @p problem, for
  /// the dual adjoint @p eta and dJ/d(slips) of this step.
  void add_before(const GradientProblem<dim> &problem,
                  const unsigned int          before,
                  const unsigned int          response,
                  qp::MultiVector             eta,
                  const qp::MultiVector      &of_step)
  {
    const auto &solver  = problem.solver;
    auto        motions = state::own_point_motions(solver, feti::PrimalVectors(0));
    motions.append(qp::MultiVector(motions.n_rows()));
    const auto &gluing = solver.gluing(problem.state.load_case);
    const auto  first  = solver.contact(problem.state.load_case).tangents().size();
    for (const auto &[row, place] : gluing.locked_rows(problem.state.load_case))
      motions(place - first, 0) += eta(row);
    of_motions[before].try_emplace(response, motions.n_rows()).first->second.add(1., motions);
    keep_tangents(solver.feti(problem.state), eta);
    // The slip of this step is relative to the one before.
    eta.add(-1., of_step);
    const unsigned int n = solver.gluing(load_cases[before].state.load_case).layout().n_owned();
    of_slips[before].try_emplace(response, n).first->second.add(1., with_rows(eta, n));
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
Gradients<dim> adjoint_gradients(const LoadCases<dim>         &load_cases,
                                 const MeasuredResponses<dim> &measured)
{
  return AdjointSweep<dim>(load_cases, measured).run();
}

#define SNUG_INSTANTIATE(dim)                                                        \
  template KktVectors     adjoint_states(const state::StateSolver<dim> &,            \
                                         const state::ContactState<dim> &,           \
                                         const std::vector<Partials<dim>> &, Solves, \
                                         const qp::SolverParameters &);              \
  template Gradients<dim> adjoint_gradients(const LoadCases<dim> &, const MeasuredResponses<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
