#include <snug/app/conclusion.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

namespace snug::app {
namespace {
using optimization::OptimizationResult;

/// Drifts of round-off alone: paired anew, the state is the same.
const double no_drift = 1e-12;

/// Changes of the objective, and violations of constraints, from which on it is
/// said that the pairing matters; both relative.
const double most_change = 1e-3, most_violation = 1e-6;

template <int dim>
void print_end(const ShapeProblem<dim>                  &problem,
               const OptimizationResult                 &result,
               const std::vector<io::Summary::State>    &first,
               const typename ShapeProblem<dim>::States &last)
{
  auto &out = problem.context.out(Verbosity::quiet);
  out << (result.success ? "converged: " : "stopped: ") << result.stop_reason << " after "
      << counted(result.iterations, "iteration") << " and "
      << counted(result.evaluations, "evaluation") << '\n'
      << problem.scene.optimization.objective << ' ' << result.objective_initial << " -> "
      << result.objective_final;
  for (unsigned int c = 0; c < last.size(); ++c)
    out << (last.size() == 1 ? "" : ", load case " + problem.scene.load_cases[c].name)
        << ", peak pressure " << first[c].max_pressure << " -> " << last[c].max_pressure
        << ", active contacts " << first[c].active_contacts << " -> " << last[c].active_contacts;
  out << std::endl;
}

/// The design found is the best for the pairing it was searched with: say what it is worth where
/// contact is paired anew. Ends all states.
template <int dim>
void measure_paired_anew(Search<dim>              &search,
                         const OptimizationResult &result,
                         const bool                is_paired)
{
  auto &problem   = search.problem;
  auto &results   = search.results;
  auto &evaluator = search.evaluator;
  if (result.end == optimization::End::interrupted ||
      (!is_paired && problem.drift(result.x) < no_drift))
    return;
  if (!is_paired)
    evaluator.pair(result.x);
  typename Evaluator<dim>::Values values;
  try
    {
      values = evaluator.values(is_paired ? evaluator.states : problem.solve(result.x));
    }
  catch (const SolveError &no_state)
    {
      results.warn({"after a new contact search, the analysis of the final design fails: " +
                    std::string(no_state.what())});
      return;
    }
  auto &summary                            = *results.summary.optimization;
  summary.objective_paired_anew            = values.objective;
  summary.constraint_violation_paired_anew = values.violation;
  const double       change                = std::abs(values.objective - result.objective_final);
  std::ostringstream line;
  line << "after a new contact search, the final design has "
       << problem.scene.optimization.objective << ' ' << values.objective << " instead of "
       << result.objective_final;
  const bool breaks = values.violation > std::max(most_violation, result.constraint_violation) &&
                      values.violation > problem.scene.optimization.constraint_tolerance;
  if (breaks)
    line << " and violates a constraint by " << values.violation << " of its limit instead of "
         << result.constraint_violation;
  if (breaks || change > most_change * std::abs(result.objective_final))
    results.warn({line.str() + "; 'Contact/Update pairing' can continue from there"});
  else
    search.log(line.str());
}

/// Compare the gain with the estimated error of the objective. A gain below the error may be an
/// effect of the mesh. A first design that violates constraints may have a lower objective than
/// every feasible design.
template <int dim>
void measure_gain(Search<dim>              &search,
                  const Books<dim>         &books,
                  const OptimizationResult &result,
                  const Known              &known)
{
  auto        &problem  = search.problem;
  const auto   combined = problem.combined_objective(search.evaluator.states);
  const double error    = objective_error(problem.scene, combined.factors, search.results.errors());
  if (!std::isfinite(error))
    return;
  io::Summary::Gain gain;
  gain.initial       = std::isfinite(known.initial) ? known.initial : result.objective_initial;
  gain.initial_error = known.initial_error;
  gain.final         = combined.value;
  gain.final_error   = error;
  gain.counts        = gain.initial - gain.final > error;

  std::ostringstream line;
  line << problem.scene.optimization.objective << ' ' << gain.initial;
  if (std::isfinite(gain.initial_error))
    line << " +- " << gain.initial_error;
  line << " -> " << gain.final << " +- " << error << " (estimated discretization errors)";
  problem.context.out(Verbosity::quiet) << line.str() << std::endl;
  search.results.summary.optimization->gain = gain;
  const bool is_free = books.first_violation <= problem.scene.optimization.constraint_tolerance;
  if (is_free && !gain.counts)
    search.results.warn({"the gain of the objective is smaller than its estimated error and may be "
                         "an effect of the mesh; set a smaller error in 'Accuracy/Target'"});
}
} // namespace

template <int dim>
void conclude(Search<dim>                            &search,
              const Books<dim>                       &books,
              const optimization::OptimizationResult &result,
              const Known                            &known)
{
  auto &problem   = search.problem;
  auto &results   = search.results;
  auto &evaluator = search.evaluator;
  search.finish_first();
  // the last one evaluated may be another, or all were replayed
  if (evaluator.gradients.of_response.empty() || evaluator.design != result.x)
    {
      auto evaluation = result.evaluation;
      search.differentiate(result.x, evaluation);
    }
  auto       &states       = evaluator.states;
  const auto &of_objective = evaluator.gradients.of_response.front();
  if (problem.scene.report_linear_reference)
    for (auto &state : states)
      state.linear_f_mults = problem.solver->linear_f_mults(state);
  results.warn(states);
  results.add_last(result.iterations, states, of_objective.shape, known.errors);
  results.export_shape(result.x);

  results.summary.gradient     = io::Summary::Gradient();
  auto &gradient               = *results.summary.gradient;
  gradient.method              = to_text(of_objective.method);
  gradient.reason              = of_objective.reason;
  gradient.differentiable      = of_objective.differentiable;
  gradient.f_mults             = evaluator.gradients.f_mults;
  gradient.seconds             = evaluator.gradients.seconds;
  gradient.values              = result.evaluation.gradient;
  results.summary.optimization = {{result}, to_text(result.algorithm)};
  print_end(problem, result, results.first(), states);
  measure_gain(search, books, result, known);
  measure_paired_anew(search, result, known.is_paired);
  results.write_summary();
}

template void
conclude(Search<2> &, const Books<2> &, const optimization::OptimizationResult &, const Known &);
template void
conclude(Search<3> &, const Books<3> &, const optimization::OptimizationResult &, const Known &);
} // namespace snug::app
