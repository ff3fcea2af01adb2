#ifndef snug_app_search_h
#define snug_app_search_h

#include <snug/app/objective.h>
#include <snug/app/results.h>
#include <snug/app/search_progress.h>
#include <snug/io/history.h>
#include <snug/optimization/journal.h>

namespace snug::app {
/// Moves of slave nodes by round-off alone, in faces, with which a new contact search would give
/// the same state.
constexpr double no_drift = 1e-12;

/// This struct holds the journal and the history that the searches of a run write, one after the
/// other.
template <int dim>
struct SearchRecord
{
  /// Open the files in the output directory of @p scene, or continue them if @p restart. The mesh
  /// of @p problem may be another one than that of later searches. Collective. @throws InputError.
  SearchRecord(Results<dim>            &results,
               const ShapeProblem<dim> &problem,
               const scene::Scene      &scene,
               bool                     restart);

  Results<dim> &results;
  double        first_violation = 0.; ///< maximum violation of constraints at the first design
  optimization::Evaluation first;     ///< of the first design, without derivatives
  io::History              history;
  SearchProgress           progress;
  optimization::Journal    journal;
};

/**
 * This class optimizes a shape problem on its mesh, with log, history, journal and pictures. If a
 * search on pressures ends with nodes that are not in contact, a search with the potential energy
 * may follow, see widen_contact(). If the design has moved slave nodes along the master, a new
 * contact search and a further optimization follow.
 */
template <int dim>
class Search
{
public:
  using Design = typename ShapeProblem<dim>::Design;

  /// Keep references to @p problem and @p record. @p paired is the design of the contact search of
  /// @p problem. The first design may be solved, see Objective. Collective.
  Search(ShapeProblem<dim> &problem, SearchRecord<dim> &record, const Design &paired);

  /**
   * Minimize from @p start, until the relative change of the objective is below the larger of
   * @p tolerance and the tolerance of the scene. Counts and the first objective continue those of
   * @p before. Collective. @throws SolveError, TangledMesh if @p start cannot be evaluated.
   */
  optimization::OptimizationResult run(const Design                           &start,
                                       const optimization::OptimizationResult &before    = {},
                                       double                                  tolerance = 0.);

  /// Write fields and summary of the first design, unless they are written. After a replay, the
  /// first design is solved for them. Collective.
  void finish_first();

  /// Warn if the gradients of @p searched at @p design are one-sided, because a contact has neither
  /// a gap nor a force. Collective.
  void warn_of_weak_contacts(Objective<dim> &searched, const Design &design);

  void log(const std::string &line) const { problem.context.out() << line << std::endl; }

  ShapeProblem<dim> &problem;
  SearchRecord<dim> &record;
  Results<dim>      &results;
  Analyses<dim>      analyses;
  Objective<dim>     objective;

private:
  using Result = optimization::OptimizationResult;

  optimization::DesignProblem decorated_problem(Objective<dim> &searched, const Design &start);

  void   report(const optimization::Iteration &iteration, const Result &before);
  void   report_first(const optimization::Iteration &iteration);
  double scene_objective(const optimization::Evaluation &evaluation) const;
  Result run_with_pairing(Objective<dim> &searched,
                          const Design   &start,
                          const Result   &before,
                          double          tolerance,
                          unsigned int most_evaluations = std::numeric_limits<unsigned int>::max());
  Result widen_contact(const Design &start, const Result &result, double tolerance);
  bool   update_pairing(const Result &result);

  unsigned int first_contacts = 0; ///< nodes in contact at the first design of the last search
};
} // namespace snug::app

#endif
