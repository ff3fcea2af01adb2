#ifndef snug_optimization_mma_search_h
#define snug_optimization_mma_search_h

#include <snug/optimization/progress.h>

#include <exception>
#include <limits>
#include <nlopt.hpp>

namespace snug::optimization {
/**
 * This class minimizes a problem with inequality constraints by the MMA of NLopt, from the iterate
 * of a Progress on.
 *
 * NLopt reports no iterations: a design that is better than all designs before counts as accepted.
 * The tests of NLopt end the search by the same tolerances as those of other searches. MMA is of
 * first order: a run that gains less than 1 % of the objective in 30 evaluations has stalled, and
 * so has a run that ends at an infeasible design or at a large projected gradient.
 *
 * NLopt takes no value for a design whose evaluation fails, because NaN, infinity and penalties all
 * mislead it. Such a design ends the run of NLopt. The next run begins at the last accepted design,
 * with moves of at most half the move that failed, and further runs follow as long as they end at
 * these limits. The search ends after five failures in a row without a gain.
 *
 * Sources: Svanberg, SIAM J. Optim. 12 (2002); Johnson, The NLopt nonlinear-optimization package.
 */
class MmaSearch
{
public:
  /// Keep references to all arguments.
  MmaSearch(ScaledProblem                &problem,
            Progress                     &progress,
            const OptimizationParameters &parameters,
            const Hooks                  &hooks);

  /// Run the search. @return why it ended: StopReason::round_off if it stalled. Exceptions of
  /// evaluate() and of hooks other than SolveErrors of evaluate() pass through.
  StopReason run();

  /// The message of the last failed evaluation, for StopReason::no_value.
  std::string failure;

private:
  void run_nlopt();
  bool shall_continue();
  bool reduce_moves();
  bool is_at_move_limit() const;

  double            objective(const double *y, double *gradient);
  void              constraints(double *values, const double *y, double *jacobian);
  Progress::Point   values_at(const std::vector<double> &y, bool with_gradient);
  void              stop_if_stalled();
  [[noreturn]] void stop(StopReason reason);
  template <typename Function>
  void guarded(const Function &work);

  static double call_objective(unsigned int, const double *y, double *gradient, void *search);
  static void   call_constraints(unsigned int,
                                 double *values,
                                 unsigned int,
                                 const double *y,
                                 double       *jacobian,
                                 void         *search);

  ScaledProblem                &problem;
  Progress                     &progress;
  const OptimizationParameters &parameters;
  const Hooks                  &hooks;
  StopReason                    end = StopReason::round_off; ///< of the last run of NLopt
  std::exception_ptr            error; ///< thrown in a callback, in which NLopt would lose it
  std::vector<double>           failed_design;
  unsigned int                  failures = 0; ///< in a row
  std::vector<double>           centre;       ///< of the limits of moves
  double                        reach      = std::numeric_limits<double>::max(); ///< of moves, in y
  unsigned int                  n_repeated = 0;     ///< callbacks in a row without an evaluation
  Progress::Point               milestone;          ///< the last accepted design that was a gain
  unsigned int                  n_at_milestone = 0; ///< evaluations until the milestone
};
} // namespace snug::optimization

#endif
