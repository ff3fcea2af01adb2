#include <snug/app/interrupt.h>
#include <snug/app/search.h>
#include <snug/geometry/imported_mesh.h>
#include <snug/scene/read_scene.h>

#include <algorithm>
#include <ostream>
#include <sstream>

namespace snug::app {
using optimization::Iteration;
using optimization::OptimizationResult;

namespace {
/// Moves of slave nodes off their pairing below this, in faces, are none.
const double unmoved = 1e-3;

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
} // namespace

template <int dim>
Books<dim>::Books(Results<dim>            &results,
                  const ShapeProblem<dim> &problem,
                  const scene::Scene      &scene,
                  const bool               restart)
  : results(results)
  , history(results.path("history.csv"), problem.shapes->n_variables())
  , journal({scene.output_directory, fingerprint(scene), restart, problem.context.communicator(),
             [&context = problem.context](const std::string &line) {
               context.out() << line << std::endl;
             }})
{}

template <int dim>
Search<dim>::Search(ShapeProblem<dim> &problem, Books<dim> &books)
  : problem(problem), results(books.results), evaluator(problem), books(books)
{}

template <int dim>
optimization::Evaluation Search<dim>::evaluate(const std::vector<double> &design)
{
  problem.context.progress("solving the contact problem ...");
  return evaluator.evaluate(design);
}

template <int dim>
void Search<dim>::differentiate(const std::vector<double> &design,
                                optimization::Evaluation  &evaluation)
{
  evaluator.differentiate(design, evaluation);
  for (const auto &gradient : evaluator.gradients.of_response)
    if (!gradient.differentiable)
      results.warn_of_weak_contacts(evaluator.states,
                                    "; continuing with those of the strongly active contacts");
}

/// An iteration of the search that begins after @p before of them.
template <int dim>
void Search<dim>::report(const Iteration &iteration, const unsigned int before)
{
  auto &out = problem.context.out();
  if (before + iteration.number == 0)
    {
      books.first_violation = iteration.constraint_violation;
      if (results.first().empty() && evaluator.design == iteration.x)
        {
          const auto &of_objective = evaluator.gradients.of_response.front();
          if (!of_objective.reason.empty())
            out << "gradient method: " << to_text(of_objective.method) << " (auto; "
                << of_objective.reason << ")" << std::endl;
          results.add_first(evaluator.states, of_objective.shape);
        }
      if (problem.scene.optimization.algorithm == optimization::Algorithm::SLSQP)
        out << "initial trust region: node displacements of at most half a cell edge"
            << (evaluator.is_predicted() ? "; contact pressures are predicted from derivatives"
                                         : "")
            << std::endl;
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
      books.history.add(line);
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
void Search<dim>::finish_first()
{
  if (results.first().empty())
    results.add_first(evaluator.first_states(), {});
}

/// With the pairing as it is.
template <int dim>
OptimizationResult Search<dim>::run_paired(const std::vector<double> &start,
                                           const OptimizationResult  &before,
                                           const double               tolerance)
{
  auto design_problem     = evaluator.design_problem(start);
  design_problem.evaluate = [&](const std::vector<double> &x) {
    check_interrupts(problem.context.communicator());
    return evaluate(x);
  };
  // Interrupted, a search goes on to the end of its evaluation, and needs the gradient of its best.
  design_problem.differentiate = [&](const std::vector<double> &x, optimization::Evaluation &at) {
    differentiate(x, at);
  };
  optimization::Hooks hooks;
  hooks.on_iteration = [&](const Iteration &i) { report(i, before.iterations); };
  hooks.log          = [&](const std::string &line) { log(line); };
  auto parameters    = problem.scene.optimization;
  parameters.maximum_evaluations -= before.evaluations;
  parameters.objective_tolerance = std::max(parameters.objective_tolerance, tolerance);

  auto result = optimization::minimize(books.journal.journaled(design_problem), parameters, hooks);
  result.iterations += before.iterations;
  result.evaluations += before.evaluations;
  if (before.evaluations > 0)
    result.objective_initial = before.objective_initial;
  return result;
}

/// Pair contact anew at the result of a search. @return false if slave
/// nodes are where they were paired, or no other search may follow.
template <int dim>
bool Search<dim>::pair_anew(const OptimizationResult &result)
{
  const auto &most = problem.scene.optimization.maximum_evaluations;
  if (!result.success || result.evaluations >= most)
    return false;
  const double drift = problem.drift(result.x);
  if (drift < unmoved)
    return false;
  finish_first();
  problem.context.out()
    << "new contact search: the design moved slave nodes away from their paired "
       "points by up to "
    << drift << " of a face" << std::endl;
  evaluator.pair(result.x);
  return true;
}

template <int dim>
OptimizationResult Search<dim>::run(const std::vector<double> &start,
                                    const OptimizationResult  &before,
                                    const double               tolerance)
{
  auto result = run_paired(start, before, tolerance);
  // rows of B belong to a pairing: it changes between searches only
  for (unsigned int round = 0; round < problem.scene.contact.update_pairing; ++round)
    {
      if (!pair_anew(result))
        break;
      result = run_paired(result.x, result, tolerance);
    }
  return result;
}

template struct Books<2>;
template struct Books<3>;
template class Search<2>;
template class Search<3>;
} // namespace snug::app
