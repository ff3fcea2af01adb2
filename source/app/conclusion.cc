#include <snug/app/conclusion.h>
#include <snug/app/result_table.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

namespace snug::app {
namespace {
using optimization::OptimizationResult;

/// Relative changes of the objective and relative violations of constraints from which on a new
/// contact search is said to matter.
const double most_change = 1e-3, most_violation = 1e-6;

template <int dim>
void print_end(const Search<dim>                        &search,
               const OptimizationResult                 &result,
               const typename ShapeProblem<dim>::States &states)
{
  search.problem.context.out(Verbosity::quiet)
    << (result.success ? "converged: " : "stopped: ") << result.stop_reason << " after "
    << counted(result.iterations, "iteration") << " and "
    << counted(result.evaluations, "evaluation") << std::endl;
  auto first      = search.record.first;
  first.objective = result.objective_initial;
  print_result_table(search, first, result.evaluation, states);
}

/// Return the values of the design found after a new contact search, or nothing if the states are
/// those of a new contact search to round-off, or if there is no state, which is a warning.
/// All states become invalid. Collective.
template <int dim>
std::optional<DesignValues>
values_paired_anew(Search<dim> &search, const OptimizationResult &result, const bool is_paired)
{
  auto &problem = search.problem;
  if (result.end == optimization::StopReason::interrupted ||
      (!is_paired && problem.drift(result.x) < no_drift))
    return {};
  if (is_paired)
    return search.objective.values(search.analyses.at(result.x).states);
  search.analyses.pair(result.x);
  try
    {
      return search.objective.values(problem.solve(result.x));
    }
  catch (const SolveError &no_state)
    {
      problem.context.warn(
        {"pairing drift", "after a new contact search, the analysis of the final "
                          "design fails: " +
                            std::string(no_state.what())});
      return {};
    }
}

/// Report the values of the design found after a new contact search, because the design is the best
/// one only for the contact search of its optimization. All states become invalid. Collective.
template <int dim>
void report_paired_anew(Search<dim> &search, const OptimizationResult &result, const bool is_paired)
{
  const auto values = values_paired_anew(search, result, is_paired);
  if (!values)
    return;
  const auto &scene                                 = search.problem.scene;
  auto       &summary                               = *search.results.summary.optimization;
  summary.objective_after_contact_update            = values->objective;
  summary.constraint_violation_after_contact_update = values->violation;
  const double change = std::abs(values->objective - result.objective_final);
  if (change <= most_change * std::abs(result.objective_final))
    search.log("a new contact search at the final design changes the objective by less than " +
               to_text(100. * most_change) + " %");
  std::ostringstream line;
  line << "after a new contact search, the final design has " << scene.optimization.objective << ' '
       << values->objective << " instead of " << result.objective_final
       << scene::unit_after_number(scene, scene.optimization.objective);
  const bool breaks = values->violation > std::max(most_violation, result.constraint_violation) &&
                      values->violation > scene.optimization.constraint_tolerance;
  if (breaks)
    line << " and violates '" << values->violated << "' by " << values->violation
         << " of its limit instead of " << result.constraint_violation;
  if (breaks || change > most_change * std::abs(result.objective_final))
    search.problem.context.warn(
      {"pairing drift", line.str() + "; 'Contact/Update pairing' can continue from there"});
}

/// Report the gain of the objective where its error is estimated. A gain below the error may be
/// a change of the discretization error. The objective of a first design that violates constraints
/// may have to increase.
template <int dim>
void report_gain(Search<dim>                              &search,
                 const OptimizationResult                 &result,
                 const typename ShapeProblem<dim>::States &states,
                 const PriorResults                       &prior)
{
  const auto  &scene    = search.problem.scene;
  const auto   combined = search.problem.combined_objective(states);
  const double error    = objective_error(scene, combined.factors, search.results.errors());
  if (!std::isfinite(error))
    return;
  io::Summary::Gain gain;
  gain.initial       = std::isfinite(prior.initial) ? prior.initial : result.objective_initial;
  gain.initial_error = prior.initial_error;
  gain.final         = combined.value;
  gain.final_error   = error;
  gain.counts        = gain.initial - gain.final > error;

  std::ostringstream line;
  line << scene.optimization.objective << ' ' << gain.initial;
  if (std::isfinite(gain.initial_error))
    line << " +- " << gain.initial_error;
  line << " -> " << gain.final << " +- " << error
       << scene::unit_after_number(scene, scene.optimization.objective)
       << " (estimated discretization errors)";
  search.problem.context.out(Verbosity::quiet) << line.str() << std::endl;
  search.results.summary.optimization->gain = gain;
  const bool is_free = search.record.first_violation <= scene.optimization.constraint_tolerance;
  if (is_free && !gain.counts)
    search.problem.context.warn(
      {"small gain",
       "the gain of the objective is smaller than its estimated error and may be an effect of the "
       "mesh; set a smaller error in 'Accuracy/Target'",
       gain.initial - gain.final, error});
}
/// Print the warnings of the run once more, because those from before a search are far above.
void repeat_warnings(RunContext &context)
{
  auto &out = context.out(Verbosity::quiet);
  if (!context.warnings().empty())
    out << "warnings of this run:\n";
  for (const auto &warning : context.warnings())
    out << "  " << warning.text << '\n';
  out << std::flush;
}

/// Add the constraints and their values to the summary.
template <int dim>
void add_constraints(Search<dim> &search, const OptimizationResult &result)
{
  using Side = optimization::Limit::Side;
  for (const auto &constraint :
       search.objective.constraint_values(search.record.first.reported, result.evaluation.reported))
    search.results.summary.optimization->constraints.push_back(
      {constraint.name, constraint.initial, constraint.value, constraint.limit,
       constraint.side == Side::at_most ? "<="
       : constraint.side == Side::equal ? "="
                                        : ">=",
       constraint.violation, constraint.is_active});
}
} // namespace

template <int dim>
void report_result(Search<dim>                            &search,
                   const optimization::OptimizationResult &result,
                   const PriorResults                     &prior)
{
  auto &problem = search.problem;
  auto &results = search.results;
  search.finish_first();
  search.warn_of_weak_contacts(search.objective, result.x);
  const auto &gradients    = search.objective.gradients(result.x);
  const auto &of_objective = gradients.of_response.front();
  auto       &states       = search.analyses.at(result.x).states;
  if (problem.scene.report_linear_reference)
    for (auto &state : states)
      state.linear_f_mults = problem.solver->linear_f_mults(state);
  results.warn(states);
  results.add_last(result.iterations, states, of_objective.shape, prior.errors);
  results.export_shape(result.x);

  results.summary.gradient             = io::Summary::Gradient();
  auto &gradient                       = *results.summary.gradient;
  gradient.method                      = to_text(of_objective.method);
  gradient.reason                      = of_objective.reason;
  gradient.differentiable              = of_objective.differentiable;
  gradient.f_mults                     = gradients.f_mults;
  gradient.seconds                     = gradients.seconds;
  gradient.values                      = result.evaluation.gradient;
  results.summary.optimization         = {{result}, to_text(result.algorithm)};
  results.summary.optimization->shapes = problem.shapes->by_shape(result.x);
  add_constraints(search, result);
  print_end(search, result, states);
  report_gain(search, result, states, prior);
  report_paired_anew(search, result, prior.is_paired);
  repeat_warnings(problem.context);
  results.write_summary();
}

template void
report_result(Search<2> &, const optimization::OptimizationResult &, const PriorResults &);
template void
report_result(Search<3> &, const optimization::OptimizationResult &, const PriorResults &);
} // namespace snug::app
