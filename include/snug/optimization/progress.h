#ifndef snug_optimization_progress_h
#define snug_optimization_progress_h

#include <snug/optimization/minimize.h>
#include <snug/optimization/scaled_problem.h>

#include <memory>

namespace snug::optimization {
/// A projected gradient above this value is no solution, whatever the tests of NLopt say.
constexpr double steep_gradient = 1e-3;

/**
 * This class keeps the accepted designs of a search and its best evaluated design, and decides
 * whether the search has converged. It does not depend on the algorithm.
 */
class Progress
{
public:
  using Point = std::shared_ptr<const ScaledProblem::Point>;

  /// Begin at the start of the problem. Keep references to all arguments.
  Progress(const ScaledProblem          &problem,
           const OptimizationParameters &parameters,
           const Hooks                  &hooks);

  /// Record an evaluated design, accepted or not.
  void consider(const Point &point);

  /**
   * Count and report an accepted design, unless it is the last one again,
   * and return whether it ends the search: StopReason::gradient, StopReason::objective,
   * StopReason::design, StopReason::none or, if the step was within the design tolerance
   * but did not halve a violation above its tolerance, StopReason::round_off.
   * A small change in a step that is not @p full ends the search only if the change in the step
   * before was small too.
   */
  StopReason accept(const Point &point, bool full);

  /// Call the hook with the last accepted design.
  void report() const;

  /// Begin a run, from which has_gained() and the rule of two small changes count.
  void begin_run();

  /// Return whether the best design has improved since begin_run() by more than the objective
  /// tolerance or, as long as no design is feasible, has halved its violation.
  bool has_gained() const;

  /// Return the design accepted last.
  const Point &iterate() const { return last; }

  /// Return the number of designs accepted after the start.
  unsigned int n_iterations() const { return iterations; }

  /// Return the result of a search that ended by @p end: the last design if a tolerance ended the
  /// search (an earlier design may have a lower objective only by a larger violation within the
  /// tolerance of the constraints), otherwise the best design. If evaluations ran out, or the
  /// search was interrupted, that is the usable design with the lowest objective, see
  /// usable_violation. A best design that was never accepted, as when evaluations run out, is
  /// accepted now, so that the result is one of the reported designs. @p failure is the message of
  /// the evaluation for StopReason::no_value.
  OptimizationResult finish(StopReason end, const std::string &failure);

  /// Return whether a design satisfies the constraints to their tolerance.
  bool is_feasible(const ScaledProblem::Point &point) const
  {
    return point.violation <= parameters.constraint_tolerance;
  }

  /// Return whether @p a has a lower objective than @p b if both are feasible, or else a smaller
  /// violation.
  bool is_better(const ScaledProblem::Point &a, const ScaledProblem::Point &b) const;

private:
  bool        is_usable(const ScaledProblem::Point &point) const;
  bool        has_gradients(const ScaledProblem::Point &point) const;
  std::string stop_reason(StopReason end, const std::string &failure) const;

  const ScaledProblem          &problem;
  const OptimizationParameters &parameters;
  const Hooks                  &hooks;
  Point                         last;
  Point                         best; ///< lowest feasible or least violating
  bool                          best_is_accepted = true;
  Point                         best_before;
  Point                         usable; ///< lowest with a usable violation, or null
  unsigned int                  iterations = 0;
  bool                          was_close  = false;
};
} // namespace snug::optimization

#endif
