#ifndef snug_app_search_h
#define snug_app_search_h

#include <snug/app/evaluator.h>
#include <snug/app/results.h>
#include <snug/io/history.h>
#include <snug/optimization/journal.h>

namespace snug::app {
/// The journal and the history that the searches of a run write, one after the other.
template <int dim>
struct SearchRecord
{
  /// Open the files in the output directory of @p scene, or continue them if @p restart. The
  /// problem of @p scene may have another mesh. Collective. @throws InputError.
  SearchRecord(Results<dim>            &results,
               const ShapeProblem<dim> &problem,
               const scene::Scene      &scene,
               bool                     restart);

  Results<dim>         &results;
  double                first_violation = 0.; ///< of constraints, by the first design
  io::History           history;
  optimization::Journal journal;
};

/**
 * A search for the best design of a shape problem, on its mesh, with a new contact search where the
 * design has moved slave nodes along the master, and with log, history, journal and pictures.
 */
template <int dim>
class Search
{
public:
  using Design = typename ShapeProblem<dim>::Design;

  /// Arguments must outlive this object. @p paired is the design of the contact search of
  /// @p problem. May solve the first design, see Evaluator. Collective.
  Search(ShapeProblem<dim> &problem, SearchRecord<dim> &record, const Design &paired);

  /**
   * Minimize from @p start, until the objective changes by less than @p tolerance, relative, or as
   * little as the scene asks for. Counts and the first objective continue those of @p before.
   * Collective. @throws SolveError, TangledMesh if the start has no value.
   */
  optimization::OptimizationResult run(const Design                           &start,
                                       const optimization::OptimizationResult &before    = {},
                                       double                                  tolerance = 0.);

  /// Draw and summarize the first design with its own contact search, unless that is done. After a
  /// replay, the first design has not been solved in this run. Collective.
  void finish_first();

  /// Warn if the gradients at @p design are one-sided. Collective.
  void warn_of_weak_contacts(const Design &design);

  void log(const std::string &line) const { problem.context.out() << line << std::endl; }

  ShapeProblem<dim> &problem;
  SearchRecord<dim> &record;
  Results<dim>      &results;
  Evaluator<dim>     evaluator;

private:
  using Result = optimization::OptimizationResult;

  void   report(const optimization::Iteration &iteration, unsigned int before);
  void   report_first(const optimization::Iteration &iteration);
  Result run_with_pairing(const Design &start, const Result &before, double tolerance);
  bool   update_pairing(const Result &result);
};
} // namespace snug::app

#endif
