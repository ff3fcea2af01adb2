#include <snug/app/adaptation.h>
#include <snug/app/conclusion.h>
#include <snug/app/interrupt.h>
#include <snug/app/optimize.h>
#include <snug/base/errors.h>

#include <array>
#include <cmath>
#include <ostream>

namespace snug::app {
namespace {
using optimization::OptimizationResult;

/// A search per entry, on a mesh made for its start with errors of so many times the targets;
/// those that follow are on meshes for the targets.
constexpr std::array<double, 3> phases{{8., 3., 1.}};

/// If the meshes made for the designs found have not agreed by then, they will not.
constexpr unsigned int most_searches = 8;

/// Designs of which no mesh is good enough: a search on the mesh that failed leaves them, where
/// others are better.
constexpr unsigned int most_failures = 3;

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
  Cells                         cells;          ///< of the last mesh
  unsigned int                  n_failures = 0; ///< how often no mesh met the targets

  unsigned int most_evaluations() const { return scene.optimization.maximum_evaluations; }
  void         begin();
  bool         says_the_same(Adaptation<dim> &adaptation) const;
  Stage        adapt(unsigned int n_searches);
  void         search_from_last(Search<dim> &search, double tolerance);
  void         add_meshes(io::Summary::Adaptation of, bool at_targets);
};

/// The first design, at the targets.
template <int dim>
void TargetedSearch<dim>::begin()
{
  context.out() << "adapting the mesh to the initial design:" << std::endl;
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
    results->warn({"initial design: " + complaint});
  results->add_first(adaptation.states(), {});
  initial  = adaptation.objective();
  result.x = problem.shapes->start();
  books    = std::make_unique<Books<dim>>(*results, problem, scene, restart);
}

/// The mesh that the search was on with cells added for matching alone meets the targets at once,
/// and changes the objective by less than its error.
template <int dim>
bool TargetedSearch<dim>::says_the_same(Adaptation<dim> &adaptation) const
{
  const auto objective = adaptation.objective();
  return adaptation.summary.met && adaptation.summary.meshes.size() == 1 &&
         std::isfinite(objective.error) &&
         std::abs(objective.value - result.objective_final) <= objective.error;
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
  context.out() << "adapting the mesh to the design of iteration " << result.iterations
                << ", factor of the targets " << factor << ":" << std::endl;
  auto adaptation =
    std::make_unique<Adaptation<dim>>(context, scene, result.x, is_tuned ? cells : Cells());
  auto complaint = adaptation->reach(factor);
  bool agrees    = is_tuned && (adaptation->cells() == cells || says_the_same(*adaptation));
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
    complaint = "the meshes of successive designs still differ after " +
                std::to_string(most_searches) + " searches; relax 'Target'";
  n_failures += !complaint.empty();
  const bool is_last =
    is_over || agrees || n_searches == most_searches || n_failures == most_failures;
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
      conclude(search, *books, result, is_interrupted ? Known() : stage.known);
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
  conclude(search, books, result);
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
