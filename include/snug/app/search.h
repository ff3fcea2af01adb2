#ifndef snug_app_search_h
#define snug_app_search_h

#include <snug/app/evaluator.h>
#include <snug/app/results.h>
#include <snug/io/history.h>
#include <snug/optimization/journal.h>

namespace snug::app {
/// The results, the history and the journal to which the searches of a run write in turn.
template <int dim>
struct Books
{
  /// Open the files in the output directory of @p scene, and continue them if @p restart. @p
  /// problem may have another mesh than the one that wrote them. Collective. @throws InputError.
  Books(Results<dim>            &results,
        const ShapeProblem<dim> &problem,
        const scene::Scene      &scene,
        bool                     restart);

  Results<dim>         &results;
  double                first_violation = 0.; ///< of constraints, by the first design
  io::History           history;
  optimization::Journal journal;
};

/**
 * Searches for the best design of a shape problem, on its mesh: with contact paired anew where the
 * design has moved slave nodes along the master, with log, history, journal and pictures.
 */
template <int dim>
class Search
{
public:
  /// Arguments must outlive this. May solve the first design, see Evaluator. Collective.
  Search(ShapeProblem<dim> &problem, Books<dim> &books);

  /**
   * Minimize from @p start, until the objective changes by less than @p tolerance, relative, or as
   * little as the scene asks for. Counts and the first objective go on from those of @p before.
   * Collective. @throws SolveError, TangledMesh if the start has no value.
   */
  optimization::OptimizationResult run(const std::vector<double>              &start,
                                       const optimization::OptimizationResult &before    = {},
                                       double                                  tolerance = 0.);

  /// The evaluator's own evaluation. Collective.
  optimization::Evaluation evaluate(const std::vector<double> &design);

  /// The evaluator's own gradients, with warnings. Collective.
  void differentiate(const std::vector<double> &design, optimization::Evaluation &evaluation);

  /// Draw and summarize the first design with its own pairing, if that is
  /// not done: after a replay it has not been solved in this run. Collective.
  void finish_first();

  void log(const std::string &line) const { problem.context.out() << line << std::endl; }

  ShapeProblem<dim> &problem;
  Results<dim>      &results;
  Evaluator<dim>     evaluator;

private:
  using Result = optimization::OptimizationResult;

  void   report(const optimization::Iteration &iteration, unsigned int before);
  Result run_paired(const std::vector<double> &start, const Result &before, double tolerance);
  bool   pair_anew(const Result &result);

  Books<dim> &books;
};
} // namespace snug::app

#endif
