#include <snug/accuracy/surface_residual.h>
#include <snug/accuracy/transfer.h>
#include <snug/accuracy/underresolved_contact.h>
#include <snug/app/adaptation.h>
#include <snug/base/errors.h>
#include <snug/state/validity_checks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>

namespace snug::app {
template <int dim>
void Adaptation<dim>::start(const Design &design, const Refinement &refinement)
{
  solved.reset();
  finer_problem.reset();
  finer           = {};
  finer_is_enough = true;
  n_underresolved = 0;
  summary         = {};
  unresolved_gaps.clear();
  given_design    = design;
  last_refinement = refinement;
  solved          = make_problem(meshes.first(last_refinement), first_tolerance(refinement));
  if (refinement.empty())
    solved->problem->check_overlaps();
  set_demands();
  solve(*solved, {});
}

/// Return the solver tolerance on the first mesh. Cells that were refined for the targets have
/// errors of the size of the targets, from which the tolerance then follows.
template <int dim>
double Adaptation<dim>::first_tolerance(const Refinement &refinement) const
{
  double result = accuracy::maximum_tolerance;
  if (!refinement.empty())
    for (const auto &target : scene.accuracy.targets)
      result = std::min(result, accuracy::step_tolerance(accuracy::read_target(target.second).value,
                                                         false, minimum_tolerance()));
  return result;
}

template <int dim>
void Adaptation<dim>::set_demands()
{
  demands.clear();
  const auto &targets = scene.accuracy.targets;
  for (unsigned int j = 0; j < targets.size(); ++j)
    for (unsigned int c = 0; c < solved->problem->n_load_cases(); ++c)
      demands.push_back(
        {(scene.load_cases.size() > 1 ? scene.load_cases[c].name + "." : "") + targets[j].first, c,
         j, accuracy::read_target(targets[j].second),
         solved->problem->make_response(targets[j].first)->stationary(),
         solved->problem->make_response(targets[j].first)->reads_pressure()});
}

template <int dim>
typename Adaptation<dim>::Design Adaptation<dim>::design(const Adapted &adapted) const
{
  return given_design.empty() ? adapted.problem->shapes->start() : given_design;
}

template <int dim>
AdaptedProblem<dim> Adaptation<dim>::release()
{
  auto &solver = *solved->problem->solver;
  solver.set_tolerance(solver.model().solver.relative_tolerance);
  auto result = std::move(*solved);
  solved.reset();
  return result;
}

template <int dim>
accuracy::Measured Adaptation<dim>::objective() const
{
  const auto combined = solved->problem->combined_objective(solved->states);
  return {combined.value, objective_error(scene, combined.factors, solved->errors)};
}

/// Return the problem on a mesh, with a contact search at the design. Collective.
template <int dim>
std::unique_ptr<AdaptedProblem<dim>> Adaptation<dim>::make_problem(Mesh         mesh,
                                                                   const double tolerance) const
{
  auto result = std::make_unique<Adapted>(
    Adapted{std::make_unique<ShapeProblem<dim>>(context, scene, std::move(mesh))});
  result->problem->solver->set_tolerance(tolerance);
  if (!given_design.empty() && given_design != result->problem->shapes->start())
    result->problem->solver->pair(result->problem->positions(given_design));
  return result;
}

/// Solve the states of an adapted problem from @p starts, and measure the responses of the targets.
/// Collective.
template <int dim>
void Adaptation<dim>::solve(Adapted &adapted, const std::vector<qp::WarmStart> &starts) const
{
  auto &problem = *adapted.problem;
  context.progress("solving the contact problem ...");
  adapted.states = problem.solve(design(adapted), starts);
  for (const auto &target : scene.accuracy.targets)
    adapted.responses.push_back(problem.make_response(target.first));
  measure(adapted);
}

/// Set the values of the targets, without errors. Collective.
template <int dim>
void Adaptation<dim>::measure(Adapted &adapted) const
{
  adapted.measured.clear();
  for (const auto &demand : demands)
    adapted.measured.push_back(
      {adapted.responses[demand.place]->value(*adapted.problem->solver,
                                              adapted.states[demand.load_case]),
       std::numeric_limits<double>::infinity()});
}

/// Set the values of the targets with their estimated errors. The mesh must resolve the contact,
/// otherwise the estimates have no meaning. States that are not accurate enough for an estimate are
/// solved to smaller tolerances. Collective. @throws SolveError.
template <int dim>
void Adaptation<dim>::estimate(Adapted &adapted) const
{
  const RunContext::Timer                      timer(context, "accuracy");
  const auto                                  &targets = scene.accuracy.targets;
  std::vector<const response::Response<dim> *> responses;
  for (const auto &response : adapted.responses)
    responses.push_back(response.get());
  adapted.errors.clear();
  for (auto &state : adapted.states)
    {
      std::optional<state::ContactState<dim>> solved_on;
      auto estimates = accuracy::estimate(*adapted.problem->solver, state, responses,
                                          scene.gradient.solves, solved_on);
      if (solved_on)
        state = std::move(*solved_on);
      MeshError error{state.load_case, std::move(estimates.energy), {}};
      for (unsigned int j = 0; j < targets.size(); ++j)
        error.responses.emplace_back(targets[j].first, std::move(estimates.responses[j]));
      adapted.errors.push_back(std::move(error));
    }
  measure(adapted);
  for (unsigned int d = 0; d < demands.size(); ++d)
    adapted.measured[d].error =
      adapted.errors[demands[d].load_case].responses[demands[d].place].second.error();
}

/// Return the problem on another mesh, solved from the states on the last mesh, or cold if that
/// fails. Collective. @throws SolveError.
template <int dim>
std::unique_ptr<AdaptedProblem<dim>> Adaptation<dim>::solve_next(Mesh mesh)
{
  auto                       next = make_problem(std::move(mesh), next_tolerance());
  std::vector<qp::WarmStart> starts;
  for (const auto &state : solved->states)
    starts.push_back(accuracy::transferred(*solved->problem->solver, state, *next->problem->solver,
                                           next->problem->positions(design(*next))));
  try
    {
      solve(*next, starts);
    }
  catch (const SolveError &)
    {
      // The forces of a coarse mesh may be a bad start.
      solve(*next, {});
    }
  return next;
}

/// Return whether all states are at rest. Without loads, states are round-off, of which nothing can
/// be estimated.
template <int dim>
bool Adaptation<dim>::is_at_rest() const
{
  return std::all_of(solved->states.begin(), solved->states.end(), state::is_at_rest<dim>);
}

template <int dim>
bool Adaptation<dim>::is_met(const unsigned int demand) const
{
  const auto &estimate = solved->measured[demand];
  return is_at_rest() || estimate.error <= demands[demand].allowed(estimate);
}

/// Return the minimum tolerance of states: that of the scene, or else the default of the solver.
template <int dim>
double Adaptation<dim>::minimum_tolerance() const
{
  return scene.state_tolerance.value_or(qp::SolverParameters().relative_tolerance);
}

template <int dim>
double Adaptation<dim>::next_tolerance() const
{
  double tolerance = std::max(minimum_tolerance(), accuracy::maximum_tolerance);
  for (unsigned int d = 0; d < demands.size(); ++d)
    tolerance = std::min(tolerance, demands[d].tolerance(solved->measured[d], minimum_tolerance()));
  return tolerance;
}

/// Return the maximum tolerance of all states of an adapted problem.
template <int dim>
double Adaptation<dim>::tolerance(const Adapted &adapted)
{
  double largest = 0.;
  for (const auto &state : adapted.states)
    largest = std::max(largest, state.tolerance);
  return largest;
}

/// Return whether the states are less accurate than their errors require, as they are if the first
/// mesh is finer than needed.
template <int dim>
bool Adaptation<dim>::is_solver_too_inexact() const
{
  return tolerance(*solved) > 10. * next_tolerance();
}

template <int dim>
std::string Adaptation<dim>::reach(const double factor)
{
  for (auto &demand : demands)
    demand.factor = factor;
  while (true)
    {
      Refinement next             = last_refinement;
      const bool is_underresolved = !is_at_rest() && add_underresolved(next);
      n_underresolved             = is_underresolved ? n_underresolved + 1 : 0;
      std::string why;
      if (!is_underresolved)
        {
          estimate(*solved);
          why = failure_reason();
        }
      else
        for (unsigned int d = 0; d < demands.size(); ++d)
          demands[d].pass(solved->measured[d].value);
      report(*solved);
      if (!why.empty())
        return why;
      if (!is_underresolved)
        {
          add_marked(next);
          summary.met = true;
          for (unsigned int d = 0; d < demands.size(); ++d)
            summary.met = summary.met && is_met(d);
          if (summary.met && !is_solver_too_inexact())
            {
              context.warn("unresolved data", unresolved_gaps);
              return "";
            }
        }
      else if (n_underresolved > 1)
        add_marked_despite_narrow_contact(next);
      if (next == last_refinement && !is_solver_too_inexact())
        return missed_targets("increase 'Maximum levels', or relax 'Target'");
      why = next == last_refinement ? solve_on() : solve_refined(next);
      if (!why.empty())
        return missed_targets(why);
    }
}

/// Solve on the last mesh to the tolerance that its errors require. Return why there is no
/// solution; empty: there is one. Collective.
template <int dim>
std::string Adaptation<dim>::solve_on()
{
  meshes.begin();
  auto &solver = *solved->problem->solver;
  solver.set_tolerance(next_tolerance());
  try
    {
      for (auto &state : solved->states)
        {
          const auto before = state.f_mults;
          state             = solver.solve_on(state, solver.tolerance());
          state.f_mults -= before; // they are in the report before
        }
    }
  catch (const SolveError &error)
    {
      return std::string("the analysis to a smaller tolerance failed: ") + error.what();
    }
  measure(*solved);
  return "";
}

/// Solve on the mesh with the refinement @p next. Return why there is no solution; empty: there is
/// one. Collective.
template <int dim>
std::string Adaptation<dim>::solve_refined(Refinement &next)
{
  try
    {
      auto mesh = meshes.make(next);
      if (!meshes.is_affordable(*mesh))
        return "the next mesh has " + std::to_string(meshes.unknowns(*mesh)) +
               " unknowns: increase 'Maximum unknowns', or relax 'Target'";
      // The mesh that is solved from goes only when the next one is solved.
      auto adapted    = solve_next(std::move(mesh));
      solved          = std::move(adapted);
      last_refinement = next;
      return "";
    }
  // The scene is right, as the meshes before were solved.
  catch (const InputError &error)
    {
      return std::string("the analysis on the next mesh failed: ") + error.what();
    }
  catch (const SolveError &error)
    {
      return std::string("the analysis on the next mesh failed: ") + error.what();
    }
}

template class Adaptation<2>;
template class Adaptation<3>;
} // namespace snug::app
