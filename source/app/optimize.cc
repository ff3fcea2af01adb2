#include <snug/app/evaluator.h>
#include <snug/app/interrupt.h>
#include <snug/app/optimize.h>
#include <snug/base/errors.h>
#include <snug/geometry/imported_mesh.h>
#include <snug/io/history.h>
#include <snug/optimization/journal.h>
#include <snug/scene/read_scene.h>

#include <cmath>
#include <ostream>
#include <sstream>

namespace snug::app {
namespace {
using optimization::Iteration;
using optimization::OptimizationResult;

/// Moves of slave nodes off their pairing below this, in faces, are none.
const double unmoved = 1e-3;

/// Drifts of round-off alone: paired anew, the state is the same.
const double no_drift = 1e-12;

/// Changes of the objective, and violations of constraints, from which on it is
/// said that the pairing matters; both relative.
const double most_change = 1e-3, most_violation = 1e-6;

/// Everything that decides the numbers: the scene but where results go and
/// when to stop, and of mesh files what is in them, wherever they are.
std::string fingerprint(scene::Scene scene)
{
  scene.output_directory = "";
  scene.optimization.maximum_evaluations =
    optimization::OptimizationParameters().maximum_evaluations;
  for (auto &body : scene.bodies)
    if (body.mesh.imported)
      body.mesh.file = "contents " + std::to_string(body.mesh.imported->text_hash);
  std::ostringstream text;
  scene::print(scene, text);
  return text.str();
}

/// Watches evaluations and iterations: log, history, first picture.
template <int dim>
struct Observer
{
  ShapeProblem<dim> &problem;
  Results<dim>      &results;
  Evaluator<dim>     evaluator{problem};
  io::History        history{results.path("history.csv"), problem.shapes->n_variables()};

  /// The evaluator's own evaluation, with warnings.
  optimization::Evaluation evaluate(const std::vector<double> &design);

  /// An iteration of the search that begins after @p before of them.
  void report(const Iteration &iteration, unsigned int before);

  void log(const std::string &line) const { problem.context.out() << line << std::endl; }

  /// Draw and summarize the first design with its own pairing, if that is
  /// not done: after a replay it has not been solved in this run.
  void finish_first()
  {
    if (results.first().empty())
      results.add_first(evaluator.first_states(), {});
  }
};

template <int dim>
optimization::Evaluation Observer<dim>::evaluate(const std::vector<double> &design)
{
  problem.context.progress("solving the contact problem ...");
  auto evaluation = evaluator.evaluate(design);
  for (const auto &gradient : evaluator.gradients.of_response)
    if (!gradient.differentiable)
      results.warn_of_weak_contacts(evaluator.states,
                                    "; going on with those of the strongly active ones");
  return evaluation;
}

template <int dim>
void Observer<dim>::report(const Iteration &iteration, const unsigned int before)
{
  auto &out = problem.context.out();
  if (before + iteration.number == 0)
    {
      if (results.first().empty() && evaluator.design == iteration.x)
        {
          const auto &of_objective = evaluator.gradients.of_response.front();
          if (!of_objective.reason.empty())
            out << "auto takes " << to_text(of_objective.method)
                << " for the objective: " << of_objective.reason << std::endl;
          results.add_first(evaluator.states, of_objective.shape);
        }
      out << io::log_header() << std::endl;
    }
  io::HistoryLine line;
  line.iteration            = before + iteration.number;
  line.objective            = iteration.evaluation.objective;
  line.constraint_violation = iteration.constraint_violation;
  line.projected_gradient   = iteration.projected_gradient;
  line.active_contacts      = iteration.evaluation.active_contacts;
  line.f_mults              = iteration.evaluation.f_mults;
  line.scaled_jacobian      = iteration.evaluation.least_scaled_jacobian;
  line.seconds              = iteration.evaluation.seconds;
  line.design               = iteration.x;
  out << io::log_line(line) << std::endl;
  everywhere(problem.context.communicator(), [&]() {
    if (problem.context.rank() == 0)
      history.add(line);
  });
  // a replay solves nothing that could be drawn
  const unsigned int every = problem.scene.optimization.draw_every;
  if (every > 0 && line.iteration > 0 && line.iteration % every == 0 &&
      evaluator.design == iteration.x)
    {
      finish_first();
      results.draw(line.iteration, evaluator.states, evaluator.gradients.of_response.front().shape);
    }
}

template <int dim>
void print_end(const ShapeProblem<dim>                  &problem,
               const OptimizationResult                 &result,
               const std::vector<io::Summary::State>    &first,
               const typename ShapeProblem<dim>::States &last)
{
  auto &out = problem.context.out();
  out << "stopped: " << result.stop_reason << " after " << result.iterations << " iterations and "
      << result.evaluations << " evaluations\n"
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
void measure_paired_anew(Observer<dim> &observer, const OptimizationResult &result)
{
  auto &[problem, results, evaluator, history] = observer;
  if (result.end == optimization::End::interrupted || problem.drift(result.x) < no_drift)
    return;
  evaluator.pair(result.x);
  typename Evaluator<dim>::Values values;
  try
    {
      values = evaluator.values(problem.solve(result.x));
    }
  catch (const SolveError &no_state)
    {
      results.warn({"with contact paired anew, the final design has no state: " +
                    std::string(no_state.what())});
      return;
    }
  auto &summary                            = *results.summary.optimization;
  summary.objective_paired_anew            = values.objective;
  summary.constraint_violation_paired_anew = values.violation;
  const double       change                = std::abs(values.objective - result.objective_final);
  std::ostringstream line;
  line << "with contact paired anew, the final design has " << problem.scene.optimization.objective
       << ' ' << values.objective << " instead of " << result.objective_final;
  const bool breaks = values.violation > std::max(most_violation, result.constraint_violation) &&
                      values.violation > problem.scene.optimization.constraint_tolerance;
  if (breaks)
    line << " and violates a constraint by " << values.violation << " of its limit instead of "
         << result.constraint_violation;
  if (breaks || change > most_change * std::abs(result.objective_final))
    results.warn({line.str() + "; 'Contact/Update pairing' goes on from there"});
  else
    observer.log(line.str());
}

/// Draw and summarize the design found.
template <int dim>
void finish(Observer<dim> &observer, const OptimizationResult &result)
{
  auto &[problem, results, evaluator, history] = observer;
  observer.finish_first();
  // the last one evaluated may be another, or all were replayed
  if (evaluator.states.empty() || evaluator.design != result.x)
    observer.evaluate(result.x);
  auto       &states       = evaluator.states;
  const auto &of_objective = evaluator.gradients.of_response.front();
  if (problem.scene.report_linear_reference)
    for (auto &state : states)
      state.linear_f_mults = problem.solver->linear_f_mults(state);
  results.warn(states);
  results.add_last(result.iterations, states, of_objective.shape);
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
  measure_paired_anew(observer, result);
  results.write_summary();
}

/// One search from @p start; counts and the first objective go on from
/// those of @p before.
template <int dim>
OptimizationResult search(Observer<dim>             &observer,
                          optimization::Journal     &journal,
                          const std::vector<double> &start,
                          const OptimizationResult  &before)
{
  auto design_problem     = observer.evaluator.design_problem(start);
  design_problem.evaluate = [&](const std::vector<double> &x) {
    check_interrupts(observer.problem.context.communicator());
    return observer.evaluate(x);
  };
  optimization::Hooks hooks;
  hooks.on_iteration = [&](const Iteration &i) { observer.report(i, before.iterations); };
  hooks.log          = [&](const std::string &line) { observer.log(line); };
  auto parameters    = observer.problem.scene.optimization;
  parameters.maximum_evaluations -= before.evaluations;

  auto result = optimization::minimize(journal.journaled(design_problem), parameters, hooks);
  result.iterations += before.iterations;
  result.evaluations += before.evaluations;
  if (before.evaluations > 0)
    result.objective_initial = before.objective_initial;
  return result;
}

/// Pair contact anew at the result of a search. @return false if slave
/// nodes are where they were paired, or no other search may follow.
template <int dim>
bool pair_anew(Observer<dim> &observer, const OptimizationResult &result)
{
  const auto &most = observer.problem.scene.optimization.maximum_evaluations;
  if (!result.success || result.evaluations >= most)
    return false;
  const double drift = observer.problem.drift(result.x);
  if (drift < unmoved)
    return false;
  observer.finish_first();
  observer.problem.context.out() << "contact is paired anew: the design moved slave nodes off the "
                                    "points they were paired with by up to "
                                 << drift << " of a face" << std::endl;
  observer.evaluator.pair(result.x);
  return true;
}

template <int dim>
std::string run(ShapeProblem<dim> &problem, Results<dim> &results, const bool restart)
{
  Observer<dim>         observer{problem, results};
  optimization::Journal journal({problem.scene.output_directory, fingerprint(problem.scene),
                                 restart, problem.context.communicator(),
                                 [&](const std::string &line) { observer.log(line); }});

  auto result = search(observer, journal, problem.shapes->start(), {});
  // rows of B belong to a pairing: it changes between searches only
  for (unsigned int round = 0; round < problem.scene.contact.update_pairing; ++round)
    {
      if (!pair_anew(observer, result))
        break;
      result = search(observer, journal, result.x, result);
    }
  finish(observer, result);
  return optimization::complaint(result, problem.scene.optimization);
}
} // namespace

template <int dim>
std::string optimize(ShapeProblem<dim> &problem, Results<dim> &results, const bool restart)
{
  return run(problem, results, restart);
}

template std::string optimize(ShapeProblem<2> &, Results<2> &, bool);
template std::string optimize(ShapeProblem<3> &, Results<3> &, bool);
} // namespace snug::app
