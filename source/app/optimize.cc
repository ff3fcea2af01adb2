#include <snug/app/adaptation.h>
#include <snug/app/interrupt.h>
#include <snug/app/optimize.h>
#include <snug/app/search.h>
#include <snug/base/errors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
    search.log(line.str());
}

/// What is known of a result from elsewhere.
struct Known
{
  bool is_paired = false; ///< contact is, at the last design
  /// of the first design; none (NaN): what the search says, and no error
  double initial = std::numeric_limits<double>::quiet_NaN(), initial_error = initial;
  std::vector<MeshError> errors; ///< of the last; empty: they are estimated
};

/// What the gain is worth, where the error of the objective is estimated. A gain within the error
/// may be one of the mesh. A first design that breaks constraints may have to get worse.
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
  line << " -> " << gain.final << " +- " << error << ", by the estimated errors of the meshes";
  search.log(line.str());
  search.results.summary.optimization->gain = gain;
  const bool is_free = books.first_violation <= problem.scene.optimization.constraint_tolerance;
  if (is_free && !gain.counts)
    search.results.warn({"the gain of the objective is smaller than its estimated error: it may be "
                         "one of the mesh alone; ask for a smaller error in 'Accuracy/Target'"});
}

/// Draw and summarize the design found.
template <int dim>
void finish(Search<dim>              &search,
            const Books<dim>         &books,
            const OptimizationResult &result,
            const Known              &known = {})
{
  auto &problem   = search.problem;
  auto &results   = search.results;
  auto &evaluator = search.evaluator;
  search.finish_first();
  // the last one evaluated may be another, or all were replayed
  if (evaluator.states.empty() || evaluator.design != result.x)
    search.evaluate(result.x);
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

/// A search per entry, on a mesh made for its start with errors of so many times the targets;
/// those that follow are on meshes for the targets.
constexpr std::array<double, 3> phases{{8., 3., 1.}};

/// If the meshes made for the designs found have not agreed by then, they will not.
constexpr unsigned int most_searches = 8;

/// A search need not see changes of the objective below this part of its error.
constexpr double part_of_error = 0.3;

/// Searches of which each begins where the one before has ended, until the mesh it was on is also
/// one for the design found.
template <int dim>
class TargetedSearch
{
public:
  TargetedSearch(RunContext &context, const scene::Scene &scene, bool restart)
    : context(context), scene(scene), restart(restart)
  {}

  /// @return what is wrong with the result; empty: nothing.
  std::string run();

private:
  using Cells = typename Adaptation<dim>::RefinedCells;

  /// The mesh made for a design.
  struct Stage
  {
    scene::Scene scene;
    double       tolerance; ///< of a search from there
    Known        known;
    std::string  complaint;
    bool         is_last;
  };

  RunContext                   &context;
  const scene::Scene           &scene;
  const bool                    restart;
  std::unique_ptr<Results<dim>> results;
  std::unique_ptr<Books<dim>>   books;
  OptimizationResult            result;
  accuracy::Measured            initial;
  Cells                         cells;              ///< of the last mesh
  bool                          has_failed = false; ///< no mesh met the last targets

  unsigned int most_evaluations() const { return scene.optimization.maximum_evaluations; }
  void         begin();
  Stage        adapt(unsigned int n_searches);
  void         search_from_last(Search<dim> &search, double tolerance);
  void         add_meshes(io::Summary::Adaptation of, bool at_targets);
};

/// The first design, at the targets.
template <int dim>
void TargetedSearch<dim>::begin()
{
  context.out() << "the first design:" << std::endl;
  Adaptation<dim> adaptation(context, scene);
  const auto      complaint = adaptation.reach(1.);
  const auto     &problem   = adaptation.problem();
  results                   = std::make_unique<Results<dim>>(problem);
  results->summary.task     = to_text(scene.task);
  results->summary.accuracy = adaptation.summary;
  results->print_header();
  results->warn(adaptation.states());
  // a search may leave it
  if (!complaint.empty())
    results->warn({"of the first design, " + complaint});
  results->add_first(adaptation.states(), {});
  initial  = adaptation.objective();
  result.x = problem.shapes->start();
  books    = std::make_unique<Books<dim>>(*results, problem, scene, restart);
}

/// A mesh for the last design found. Of the first phases each begins with the scene's own mesh:
/// cells refined for other designs are of no use; then cells are only added, to come to an end.
/// What a mesh is too coarse to see its estimates miss as well: the last one has to be verified.
template <int dim>
typename TargetedSearch<dim>::Stage TargetedSearch<dim>::adapt(const unsigned int n_searches)
{
  const bool is_over  = n_searches > 0 && result.evaluations >= most_evaluations();
  const bool is_tuned = n_searches >= phases.size();
  const auto factor   = is_over || is_tuned ? 1. : phases[n_searches];
  context.out() << "the design of iteration " << result.iterations << ", errors of up to " << factor
                << " times the targets:" << std::endl;
  auto adaptation =
    std::make_unique<Adaptation<dim>>(context, scene, result.x, is_tuned ? cells : Cells());
  auto complaint = adaptation->reach(factor);
  bool agrees    = is_tuned && adaptation->cells() == cells;
  if (complaint.empty() && (is_over || agrees))
    complaint = adaptation->verify();
  add_meshes(adaptation->summary, factor == 1.);
  if (!adaptation->finer_cells().empty() && !is_over)
    {
      const Cells finer = adaptation->finer_cells();
      adaptation.reset();
      adaptation = std::make_unique<Adaptation<dim>>(context, scene, result.x, finer);
      complaint  = adaptation->reach(factor);
      agrees     = false;
      add_meshes(adaptation->summary, true);
    }
  cells = adaptation->cells();
  if (complaint.empty() && n_searches == most_searches && !agrees)
    complaint = "the meshes made for the designs found still differ after " +
                std::to_string(most_searches) + " searches; ask for less";
  // a search may leave a design of which no mesh is good enough
  const bool is_last =
    is_over || agrees || n_searches == most_searches || (has_failed && !complaint.empty());
  has_failed           = !complaint.empty();
  const auto objective = adaptation->objective();
  // what is of the geometry alone has no error
  const double tolerance = std::isfinite(objective.error) && objective.value != 0.
                             ? part_of_error * objective.error / std::abs(objective.value)
                             : 0.;
  return {adaptation->adapted_scene(),
          tolerance,
          {true, initial.value, initial.error, adaptation->errors()},
          complaint,
          is_last};
}

template <int dim>
void TargetedSearch<dim>::add_meshes(io::Summary::Adaptation of, const bool at_targets)
{
  auto &all = *results->summary.accuracy;
  of.met    = of.met && at_targets;
  of.meshes.insert(of.meshes.begin(), all.meshes.begin(), all.meshes.end());
  all = of;
}

/// An interruption while a mesh was made ends the search that was to follow.
template <int dim>
void TargetedSearch<dim>::search_from_last(Search<dim> &search, const double tolerance)
{
  try
    {
      result = search.run(result.x, result, tolerance);
    }
  catch (const Interrupted &)
    {
      if (result.evaluations == 0)
        throw;
      result.end         = optimization::End::interrupted;
      result.stop_reason = "interrupted";
    }
}

template <int dim>
std::string TargetedSearch<dim>::run()
{
  begin();
  catch_interrupts();
  for (unsigned int n = 0;; ++n)
    {
      const auto        stage = adapt(n);
      ShapeProblem<dim> problem(context, stage.scene, timed_mesh<dim>(context, stage.scene));
      results->watch(problem);
      // limits that are relative to the first design are so with its pairing
      Search<dim> search(problem, *books);
      if (result.x != problem.shapes->start())
        search.evaluator.pair(result.x);
      if (!stage.is_last)
        search_from_last(search, stage.tolerance);
      const bool is_interrupted = result.end == optimization::End::interrupted;
      if (!stage.is_last && !is_interrupted)
        continue;
      finish(search, *books, result, is_interrupted ? Known() : stage.known);
      results->print_work();
      return stage.complaint.empty() ? optimization::complaint(result, scene.optimization)
                                     : stage.complaint;
    }
}
} // namespace

template <int dim>
std::string optimize(ShapeProblem<dim> &problem, Results<dim> &results, const bool restart)
{
  Books<dim>  books(results, problem, problem.scene, restart);
  Search<dim> search(problem, books);
  const auto  result = search.run(problem.shapes->start());
  finish(search, books, result);
  return optimization::complaint(result, problem.scene.optimization);
}

template <int dim>
std::string optimize_to_targets(RunContext &context, const scene::Scene &scene, const bool restart)
{
  return TargetedSearch<dim>(context, scene, restart).run();
}

template std::string optimize(ShapeProblem<2> &, Results<2> &, bool);
template std::string optimize(ShapeProblem<3> &, Results<3> &, bool);
template std::string optimize_to_targets<2>(RunContext &, const scene::Scene &, bool);
template std::string optimize_to_targets<3>(RunContext &, const scene::Scene &, bool);
} // namespace snug::app
