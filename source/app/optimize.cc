#include <snug/app/adaptation.h>
#include <snug/app/conclusion.h>
#include <snug/app/cost_report.h>
#include <snug/app/interrupt.h>
#include <snug/app/optimize.h>
#include <snug/base/errors.h>

#include <array>
#include <cmath>
#include <ostream>

namespace snug::app {
namespace {
using optimization::OptimizationResult;

/// Errors of the meshes of the first searches, relative to the targets. All later searches have
/// meshes with errors of the targets.
constexpr std::array<double, 3> phases{{8., 3., 1.}};

/// Maximum number of searches. If the mesh of a search and the mesh made for the design that it
/// found still differ after so many searches, further searches are not expected to change this.
constexpr unsigned int most_searches = 8;

/// Maximum number of designs for which no mesh meets the targets. After fewer such designs the next
/// search runs on the mesh that misses the targets, because it may find a design whose mesh meets
/// them.
constexpr unsigned int most_failures = 3;

/// Part of the error of the objective below which changes of the objective end a search.
constexpr double part_of_error = 0.3;

/// Search on the mesh of the scene. Return what is wrong with the result; empty: nothing.
/// Collective.
template <int dim>
std::string optimize_on_one_mesh(RunContext &context, const scene::Scene &scene, const bool restart)
{
  auto mesh = timed_mesh<dim>(context, scene);
  print_cost_estimate(context, scene, *mesh, context.n_ranks(), false);
  ShapeProblem<dim> problem(context, scene, std::move(mesh));
  problem.check_overlaps();
  if (!restart)
    io::remove_earlier_results(context, scene);
  catch_interrupts();
  Results<dim> results(problem);
  results.print_header();
  const auto        start = problem.shapes->start();
  SearchRecord<dim> record(results, problem, scene, restart);
  Search<dim>       search(problem, record, start);
  const auto        result = search.run(start);
  report_result(search, result);
  return results.failure_reason(optimization::failure_reason(result, scene.optimization));
}

/// This class searches on meshes that are made for targets. Each search begins where the search
/// before has ended, until the mesh of a search is also good enough for the design found.
template <int dim>
class AdaptiveOptimization
{
public:
  AdaptiveOptimization(RunContext &context, const scene::Scene &scene, bool restart)
    : context(context), scene(scene), restart(restart), adaptation(context, scene)
  {}

  /// Return what is wrong with the result; empty: nothing.
  std::string run();

private:
  /// This struct describes the search on a mesh that was made for the last design. On the last mesh
  /// there is no search, and the design is reported.
  struct Phase
  {
    double       tolerance;      ///< of the search, relative to the objective
    PriorResults prior;          ///< for the report of the design
    std::string  failure_reason; ///< why the targets are not met; empty: they are met
    bool         is_last;
  };

  RunContext                        &context;
  const scene::Scene                &scene;
  const bool                         restart;
  Adaptation<dim>                    adaptation;
  std::unique_ptr<Results<dim>>      results;
  std::unique_ptr<SearchRecord<dim>> record;
  OptimizationResult                 result;
  accuracy::Measured                 initial;        ///< objective of the first design
  Refinement                         refinement;     ///< of the last mesh
  unsigned int                       n_failures = 0; ///< number of meshes that miss the targets

  void  analyse_first_design();
  bool  agrees_with_search() const;
  Phase adapt(unsigned int n_searches);
  void  search(Search<dim> &search, double tolerance);
  void  add_meshes(bool at_targets);
};

/// Analyse the first design on a mesh that meets the targets, because the gain is the difference
/// between the first and the last objective, both with errors below the target. The first search
/// runs on a coarser mesh for the same design, see adapt().
template <int dim>
void AdaptiveOptimization<dim>::analyse_first_design()
{
  context.out() << "adapting the mesh to the initial design:" << std::endl;
  adaptation.start();
  if (!restart)
    io::remove_earlier_results(context, scene);
  const auto  failure_reason = adaptation.reach(1.);
  const auto &problem        = adaptation.problem();
  results                    = std::make_unique<Results<dim>>(problem);
  results->summary.accuracy  = adaptation.summary;
  results->print_header();
  results->warn(adaptation.states());
  // A search may leave a design for which no mesh meets the targets.
  if (!failure_reason.empty())
    context.warn({"target", "initial design: " + failure_reason});
  results->add_first(adaptation.states(), {});
  initial  = adaptation.objective();
  result.x = problem.shapes->start();
  record   = std::make_unique<SearchRecord<dim>>(*results, problem, scene, restart);
}

/// Return whether the mesh of the last search, with cells added only to match contact faces, meets
/// the targets at once and changes the objective by less than the estimated error of the objective.
/// Collective.
template <int dim>
bool AdaptiveOptimization<dim>::agrees_with_search() const
{
  const auto objective = adaptation.objective();
  return adaptation.summary.met && adaptation.summary.meshes.size() == 1 &&
         std::isfinite(objective.error) &&
         std::abs(objective.value - result.objective_final) <= objective.error;
}

/// Make a mesh for the last design found. The first phases begin with the mesh of the scene,
/// because cells refined for other designs are of no use. Later phases only add cells, because
/// otherwise the searches might not end. The last mesh is verified, because its estimates miss the
/// details that the mesh misses. Collective.
template <int dim>
typename AdaptiveOptimization<dim>::Phase
AdaptiveOptimization<dim>::adapt(const unsigned int n_searches)
{
  const bool is_over =
    n_searches > 0 && result.evaluations >= scene.optimization.maximum_evaluations;
  const bool phases_are_over = n_searches >= phases.size();
  const auto factor          = is_over || phases_are_over ? 1. : phases[n_searches];
  context.out() << "adapting the mesh to the design of iteration " << result.iterations
                << ", factor of the targets " << factor << ":" << std::endl;
  adaptation.start(result.x, phases_are_over ? refinement : Refinement());
  auto failure_reason = adaptation.reach(factor);
  bool agrees = phases_are_over && (adaptation.refinement() == refinement || agrees_with_search());
  if (failure_reason.empty() && (is_over || agrees))
    failure_reason = adaptation.verify();
  add_meshes(factor == 1.);
  if (!adaptation.finer_refinement().empty() && !is_over)
    {
      const Refinement finer = adaptation.finer_refinement();
      adaptation.start(result.x, finer);
      failure_reason = adaptation.reach(factor);
      agrees         = false;
      add_meshes(true);
    }
  refinement = adaptation.refinement();
  if (failure_reason.empty() && n_searches == most_searches && !agrees)
    failure_reason = "the meshes of successive designs still differ after " +
                     std::to_string(most_searches) + " searches; relax 'Target'";
  n_failures += !failure_reason.empty();
  const bool is_last =
    is_over || agrees || n_searches == most_searches || n_failures == most_failures;
  const auto objective = adaptation.objective();
  // A response of the geometry alone has no error.
  const double tolerance = std::isfinite(objective.error) && objective.value != 0.
                             ? part_of_error * objective.error / std::abs(objective.value)
                             : 0.;
  return {tolerance,
          {true, initial.value, initial.error, adaptation.errors()},
          failure_reason,
          is_last};
}

/// Add the meshes of the last adaptation to the summary.
template <int dim>
void AdaptiveOptimization<dim>::add_meshes(const bool at_targets)
{
  auto &all = *results->summary.accuracy;
  auto  of  = adaptation.summary;
  of.met    = of.met && at_targets;
  of.meshes.insert(of.meshes.begin(), all.meshes.begin(), all.meshes.end());
  all = of;
}

/// Search from the last design. An interruption while the mesh was made ends the search at once.
template <int dim>
void AdaptiveOptimization<dim>::search(Search<dim> &search, const double tolerance)
{
  try
    {
      result = search.run(result.x, result, tolerance);
    }
  catch (const Interrupted &)
    {
      if (result.evaluations == 0)
        throw;
      result.end         = optimization::StopReason::interrupted;
      result.stop_reason = "interrupted";
    }
}

template <int dim>
std::string AdaptiveOptimization<dim>::run()
{
  analyse_first_design();
  catch_interrupts();
  for (unsigned int n = 0;; ++n)
    {
      const auto phase   = adapt(n);
      auto       adapted = adaptation.release();
      results->watch(*adapted.problem);
      Search<dim>                  on_mesh(*adapted.problem, *record, result.x);
      std::vector<qp::MultiVector> forces;
      for (const auto &state : adapted.states)
        forces.push_back(state.dual.lambda);
      on_mesh.analyses.start_from(result.x, forces);
      if (!phase.is_last)
        search(on_mesh, phase.tolerance);
      const bool is_interrupted = result.end == optimization::StopReason::interrupted;
      if (!phase.is_last && !is_interrupted)
        continue;
      report_result(on_mesh, result, is_interrupted ? PriorResults() : phase.prior);
      results->print_work();
      return results->failure_reason(phase.failure_reason.empty()
                                       ? optimization::failure_reason(result, scene.optimization)
                                       : phase.failure_reason);
    }
}
} // namespace

template <int dim>
std::string optimize(RunContext &context, const scene::Scene &scene, const bool restart)
{
  return scene.accuracy.targets.empty() ? optimize_on_one_mesh<dim>(context, scene, restart)
                                        : AdaptiveOptimization<dim>(context, scene, restart).run();
}

template std::string optimize<2>(RunContext &, const scene::Scene &, bool);
template std::string optimize<3>(RunContext &, const scene::Scene &, bool);
} // namespace snug::app
