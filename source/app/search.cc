#include <snug/app/interrupt.h>
#include <snug/app/search.h>
#include <snug/geometry/imported_mesh.h>
#include <snug/optimization/linear_limits.h>
#include <snug/optimization/starts.h>
#include <snug/scene/read_scene.h>

#include <algorithm>
#include <ostream>
#include <sstream>

namespace snug::app {
using optimization::Iteration;
using optimization::OptimizationResult;

namespace {
/// Moves of slave nodes off their pairing below this value, in faces, need no new contact search.
const double unmoved = 1e-3;

/// Return everything that decides the numbers of a run: the scene without the output directory and
/// the maximum of evaluations, and the contents of mesh files instead of their paths.
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
/// Return the names of the values of an evaluation: those of the shape problem, then the limits.
template <int dim>
std::vector<std::string> columns(const ShapeProblem<dim> &problem, const scene::Scene &scene)
{
  auto names = problem.value_names();
  for (const auto &[name, limit] : scene.optimization.constraints)
    names.push_back(optimization::constraint_text(name, limit));
  return names;
}

/// Return the name of the constraint that the @p values of an infeasible design violate most. If
/// they violate none, the design violates a limit of its shape, whose entry is returned.
template <int dim>
std::string violated(const Objective<dim>      &objective,
                     const ShapeProblem<dim>   &problem,
                     const std::vector<double> &values,
                     const std::vector<double> &design)
{
  const auto name = objective.most_violated(values).second;
  return name.empty() ? problem.shapes->most_violated_limit(design) : name;
}
} // namespace

template <int dim>
SearchRecord<dim>::SearchRecord(Results<dim>            &results,
                                const ShapeProblem<dim> &problem,
                                const scene::Scene      &scene,
                                const bool               restart)
  : results(results)
  , history(results.path("history.csv"), problem.shapes->n_variables(), columns(problem, scene))
  , progress(scene.optimization.objective,
             scene::unit_after_number(scene, scene.optimization.objective),
             scene.optimization.maximum_evaluations,
             scene.optimization.constraint_tolerance)
  , journal({scene.output_directory, fingerprint(scene), restart, problem.context.communicator(),
             [&context = problem.context](const std::string &line) {
               context.out() << line << std::endl;
             }})
{}

template <int dim>
Search<dim>::Search(ShapeProblem<dim> &problem, SearchRecord<dim> &record, const Design &paired)
  : problem(problem)
  , record(record)
  , results(record.results)
  , analyses(problem)
  , objective(problem, analyses, paired)
{}

template <int dim>
void Search<dim>::warn_of_weak_contacts(Objective<dim> &searched, const Design &design)
{
  for (const auto &gradient : searched.gradients(design).of_response)
    if (!gradient.differentiable)
      results.warn_of_weak_contacts(analyses.at(design).states,
                                    "; continuing with those of the strongly active contacts");
}

namespace {
/// Return whether prescribed displacements, positions and overlaps alone load the bodies, so that
/// forces fall if faces retreat.
bool has_no_force(const scene::Scene &scene)
{
  const auto is_free = [](const scene::LoadParameters &loads) {
    return loads.pressure.empty() && loads.traction.empty() && loads.force.empty() &&
           loads.moment.empty() && loads.point_forces.empty() && loads.line_forces.empty();
  };
  const bool no_point = std::all_of(scene.points.begin(), scene.points.end(), [](const auto &of) {
    return of.force.empty() && of.moment.empty();
  });
  return scene.gravity.empty() && no_point && scene.bolts.empty() &&
         std::all_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const auto &body) {
                       return is_free(body.loads) && body.body_force.empty() &&
                              body.temperature.empty();
                     }) &&
         std::all_of(scene.load_cases.begin(), scene.load_cases.end(), [&](const auto &load_case) {
           return is_free(load_case.loads) && load_case.temperatures.empty() &&
                  load_case.gravity.empty();
         });
}

/// Return what a search may do that its user does not want, as warnings.
std::vector<Warning> search_warnings(const scene::Scene                                &scene,
                                     const std::vector<std::pair<std::string, double>> &initial)
{
  std::vector<Warning> result;
  for (unsigned int i = 0; i < initial.size(); ++i)
    if (initial[i].second < 0. &&
        optimization::read_limit(scene.optimization.constraints[i].second).of_initial)
      result.push_back({"negative limit",
                        "the constraint '" + initial[i].first +
                          "' refers to a negative value: above it the amount is smaller",
                        initial[i].second, 0.});
  const auto quantity_of = [&](const std::string &name) {
    return scene::response_called(scene, name)->quantity;
  };
  const auto of_objective = quantity_of(scene.optimization.objective);
  const bool is_pressure  = of_objective.find("pressure") != std::string::npos;
  const bool is_limited =
    std::any_of(scene.optimization.constraints.begin(), scene.optimization.constraints.end(),
                [&](const auto &constraint) {
                  const auto of =
                    quantity_of(scene::constraint_name(scene, constraint.first).response);
                  return of.find("force") != std::string::npos ||
                         of.find("energy") != std::string::npos ||
                         of.find("reaction") != std::string::npos ||
                         of.find("moment") != std::string::npos || of == "compliance";
                });
  if (is_pressure && !is_limited && has_no_force(scene))
    result.push_back({"retreat", "displacements alone load the bodies, and no constraint limits a "
                                 "force: the " +
                                   of_objective +
                                   " also falls if the face retreats; limit the contact force, as "
                                   "in 'force: >= initial'"});
  return result;
}
} // namespace

/// Summarize the first design of all searches, and print the header of the table of iterations.
template <int dim>
void Search<dim>::report_first(const Iteration &iteration)
{
  auto &out              = problem.context.out();
  record.first_violation = iteration.constraint_violation;
  record.first.objective = iteration.evaluation.objective;
  record.first.reported  = iteration.evaluation.reported;
  std::vector<std::pair<std::string, double>> initial;
  for (const auto &constraint :
       objective.constraint_values(record.first.reported, record.first.reported))
    initial.emplace_back(constraint.name, constraint.value);
  for (const auto &warning : search_warnings(problem.scene, initial))
    problem.context.warn(warning);
  if (const auto *analysis = analyses.last(iteration.x); analysis && results.first().empty())
    {
      const auto &of_objective = objective.gradients(iteration.x).of_response.front();
      if (!of_objective.reason.empty())
        out << "gradient method: " << to_text(of_objective.method) << " (auto; "
            << of_objective.reason << ")" << std::endl;
      results.add_first(analysis->states, of_objective.shape);
    }
  if (problem.scene.optimization.algorithm == optimization::Algorithm::SQP)
    out << "initial trust region: node displacements of at most half a cell edge"
        << (objective.is_predicted() ? "; contact pressures are predicted from derivatives" : "")
        << std::endl;
  out << io::log_header() << (initial.empty() ? "" : "  most violated") << std::endl;
}

/// Report an iteration of the search that continues the search @p before.
template <int dim>
void Search<dim>::report(const Iteration &iteration, const OptimizationResult &before)
{
  if (iteration.number == 0)
    first_contacts = iteration.evaluation.active_contacts;
  if (before.evaluations + iteration.number == 0)
    report_first(iteration);
  io::HistoryLine line;
  line.iteration            = before.iterations + iteration.number;
  line.evaluations          = before.evaluations + iteration.evaluations;
  line.objective            = scene_objective(iteration.evaluation);
  line.constraint_violation = iteration.constraint_violation;
  line.projected_gradient   = iteration.projected_gradient;
  line.active_contacts      = iteration.evaluation.active_contacts;
  line.f_mults              = iteration.evaluation.f_mults;
  line.scaled_jacobian      = iteration.evaluation.least_scaled_jacobian;
  line.seconds              = iteration.evaluation.seconds;
  line.design               = iteration.x;
  line.values               = iteration.evaluation.reported;
  if (line.constraint_violation > problem.scene.optimization.constraint_tolerance)
    line.violated = violated(objective, problem, line.values, iteration.x);
  log(io::log_line(line));
  throw_collectively(problem.context.communicator(), [&]() {
    if (problem.context.rank() == 0)
      record.history.add(line);
  });
  // A replay solves nothing that could be drawn.
  const unsigned int every = problem.scene.optimization.draw_every;
  if (every == 0 || line.iteration == 0 || line.iteration % every != 0 ||
      !analyses.last(iteration.x))
    return;
  finish_first();
  if (const auto *analysis = analyses.last(iteration.x))
    results.draw(line.iteration, analysis->states,
                 objective.gradients(iteration.x).of_response.front().shape);
}

template <int dim>
void Search<dim>::finish_first()
{
  if (results.first().empty())
    results.add_first(analyses.first_states(), {});
}

/// Return the problem that the optimizer sees. Each step wraps the one before it.
template <int dim>
optimization::DesignProblem Search<dim>::decorated_problem(Objective<dim> &searched,
                                                           const Design   &start)
{
  auto result = searched.design_problem(start);
  // An interrupted search continues to the end of its evaluation, and needs the gradient of its
  // best design.
  result.evaluate = [this, evaluate = result.evaluate](const Design &x) {
    check_interrupts(problem.context.communicator());
    problem.context.progress(record.progress.text());
    auto evaluation = evaluate(x);
    record.progress.end(scene_objective(evaluation),
                        objective.most_violated(evaluation.reported).first, evaluation.seconds);
    return evaluation;
  };
  result.differentiate =
    [this, &searched, differentiate = result.differentiate](const Design             &x,
                                                            optimization::Evaluation &evaluation) {
      differentiate(x, evaluation);
      warn_of_weak_contacts(searched, x);
    };
  std::vector<optimization::LinearLimit> limits;
  for (const auto &limit : problem.shapes->limits())
    limits.push_back({limit.row, limit.bound});
  result = record.journal.journaled(optimization::with_limits(std::move(result), limits));
  // The evaluations that a restart repeats from the journal are counted as well.
  result.evaluate = [this, evaluate = result.evaluate](const Design &x) {
    record.progress.begin();
    return evaluate(x);
  };
  return result;
}

/// Return the objective of the scene for values of a search that may have another objective.
template <int dim>
double Search<dim>::scene_objective(const optimization::Evaluation &evaluation) const
{
  const std::size_t   n_values = problem.value_names().size() / problem.n_load_cases();
  std::vector<double> values, weights;
  for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
    {
      values.push_back(evaluation.reported[c * n_values]);
      weights.push_back(problem.weight(c));
    }
  return optimization::combined(problem.scene.optimization.combine, values, weights).value;
}

/// Minimize without a new contact search.
template <int dim>
OptimizationResult Search<dim>::run_with_pairing(Objective<dim>           &searched,
                                                 const Design             &start,
                                                 const OptimizationResult &before,
                                                 const double              tolerance,
                                                 const unsigned int        most_evaluations)
{
  optimization::Hooks hooks;
  hooks.on_iteration = [&](const Iteration &i) { report(i, before); };
  hooks.log          = [&](const std::string &line) { log(line); };
  auto parameters    = problem.scene.optimization;
  parameters.maximum_evaluations =
    std::min(parameters.maximum_evaluations, most_evaluations) - before.evaluations;
  parameters.objective_tolerance = std::max(parameters.objective_tolerance, tolerance);

  if (before.evaluations > 0)
    parameters.starts = 1;

  auto result =
    optimization::minimize_from_starts(decorated_problem(searched, start), parameters, hooks);
  if (result.constraint_violation > parameters.constraint_tolerance)
    result.violated = violated(objective, problem, result.evaluation.reported, result.x);
  result.iterations += before.iterations;
  result.evaluations += before.evaluations;
  if (before.evaluations > 0)
    result.objective_initial = before.objective_initial;
  return result;
}

/// Run a new contact search at the result of a search. Return false if slave nodes are where the
/// last contact search found them, or no further search may follow.
template <int dim>
bool Search<dim>::update_pairing(const OptimizationResult &result)
{
  const auto &most = problem.scene.optimization.maximum_evaluations;
  // A search also ends where the master side has moved away from slave nodes.
  const bool has_failed = result.end == optimization::StopReason::no_value;
  if ((!result.success && !has_failed) || result.evaluations >= most)
    return false;
  const double drift = problem.drift(result.x);
  if (drift < (has_failed ? no_drift : unmoved))
    return false;
  finish_first();
  problem.context.out() << "new contact search: the design moved slave nodes away from their "
                           "paired points by up to "
                        << drift << " of a face" << std::endl;
  analyses.pair(result.x);
  return true;
}

template <int dim>
OptimizationResult
Search<dim>::run(const Design &start, const OptimizationResult &before, const double tolerance)
{
  auto result = run_with_pairing(objective, start, before, tolerance);
  if (before.evaluations == 0)
    result = widen_contact(start, result, tolerance);
  // The rows of B belong to a contact search, so a new one separates two searches.
  for (unsigned int round = 0; round < problem.scene.contact.update_pairing; ++round)
    {
      if (!update_pairing(result))
        break;
      result = run_with_pairing(objective, result.x, result, tolerance);
    }
  return result;
}

template struct SearchRecord<2>;
template struct SearchRecord<3>;
template class Search<2>;
template class Search<3>;
} // namespace snug::app
