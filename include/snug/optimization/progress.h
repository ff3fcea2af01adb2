#ifndef snug_optimization_progress_h
#define snug_optimization_progress_h

#include <snug/optimization/minimize.h>
#include <snug/optimization/scaled_problem.h>

#include <memory>

namespace snug::optimization {
/// A projected gradient above this value is no solution, whatever the tests of NLopt say.
constexpr double steep_gradient = 1e-3;

/**
 * The accepted designs of a search, the best design it has seen, and
 * whether that is enough. Knows no algorithm.
 */
class Progress
{
public:
  using Point = std::shared_ptr<const ScaledProblem::Point>;

  /// Begins at the problem's start. Keeps references to all three.
  Progress(const ScaledProblem          &problem,
           const OptimizationParameters &parameters,
           const Hooks                  &hooks);

  /// Take note of an evaluated design, accepted or not.
  void consider(const Point &point);

  /**
   * Count and report an accepted design, unless it is the last one again,
   * and say whether it ends the search: StopReason::gradient, StopReason::objective,
   * StopReason::design, StopReason::none or, if the step was within the design tolerance
   * but far from halved a violation beyond its tolerance, StopReason::round_off.
   * Of the size of a step that is not @p full, only two in a row end the
   * search.
   */
  StopReason accept(const Point &point, bool full);

  /// Call the hook with the last accepted design.
  void report() const;

  /// has_gained() and the two-steps rule count from here.
  void begin_run();

  /// Return whether the best design has improved since begin_run() by more than the objective
  /// tolerance or, as long as no design is feasible, has halved its violation.
  bool has_gained() const;

  /// The design accepted last.
  const Point &iterate() const { return last; }

  /// Designs accepted after the start.
  unsigned int n_iterations() const { return iterations; }

  /// The result of a search that ended by @p end: the best design, or the
  /// last one if a tolerance ended it (an earlier one may be lower only by
  /// using up the constraints' tolerance). A best design that was never
  /// accepted, as where evaluations run out, is accepted now, so that
  /// the result is one of the designs reported. @p failure says why the
  /// design of StopReason::no_value has none.
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
  bool        has_gradients(const ScaledProblem::Point &point) const;
  std::string stop_reason(StopReason end, const std::string &failure) const;

  const ScaledProblem          &problem;
  const OptimizationParameters &parameters;
  const Hooks                  &hooks;
  Point                         last;
  Point                         best; ///< lowest feasible or least violating
  bool                          best_is_accepted = true;
  Point                         best_before;
  unsigned int                  iterations = 0;
  bool                          was_close  = false;
};
} // namespace snug::optimization

#endif
