#ifndef snug_optimization_minimize_h
#define snug_optimization_minimize_h

#include <snug/optimization/design_problem.h>
#include <snug/optimization/optimization_parameters.h>

#include <functional>
#include <string>
#include <vector>

namespace snug::optimization {
/**
 * This struct holds a design that the optimizer has accepted; number 0 is the start.
 *
 * Both measures are free of units. With the lengths w of the variables and the scales s of the
 * constraints (ScaledProblem), the scaled gradients g_i = w_i df/dx_i and A_ji = w_i dc_j/dx_i /
 * s_j,
 * @f[ \text{violation} = \max_j |c_j| / s_j
 *     \;(c_j^+ \text{ for inequalities}), \qquad
 *     \text{projected gradient} = \min_\mu \|P(g + A^T\mu)\|_2 \,/\,
 *     \max(\|g\|_2, \|g_{start}\|_2), @f]
 * where A holds equalities and active inequalities (c_j / s_j above -1e-6), the latter with
 * mu_j >= 0. P keeps the entries of variables between their bounds, the negative entries of
 * variables at a lower bound and the positive entries of variables at an upper bound (a variable
 * within 1e-8 of its length is at its bound). The projected gradient is zero exactly at the points
 * of Karush, Kuhn and Tucker.
 */
struct Iteration
{
  unsigned int        number = 0;
  std::vector<double> x;
  Evaluation          evaluation;
  double              constraint_violation = 0.;
  double              projected_gradient   = 0.;
  unsigned int        evaluations          = 0; ///< so far
};

/// This struct holds functions by which the optimizer reports what it does. Each may be empty.
struct Hooks
{
  /// Receive an accepted design, once per design and before the next one is evaluated.
  std::function<void(const Iteration &)> on_iteration;
  /// Receive a line of the log, without its end.
  std::function<void(const std::string &)> log;
};

/// Reason why a search, or one of its runs, has ended.
enum class StopReason
{
  none,
  gradient,
  objective,
  design,
  evaluations,
  round_off,
  no_value,
  interrupted
};

/**
 * This struct holds the design found and how the search for it ended. It is the last accepted
 * design if a tolerance was met, otherwise the best evaluated design: that with the lowest
 * objective among the designs that satisfy the constraints or, if there is none, that with the
 * smallest violation.
 */
struct OptimizationResult
{
  std::vector<double> x;
  Algorithm           algorithm = Algorithm::SQP; ///< of the end of the search
  Evaluation          evaluation;                 ///< at x
  unsigned int        iterations           = 0;   ///< accepted designs after the start
  unsigned int        evaluations          = 0;   ///< calls of the design problem
  double              objective_initial    = 0.;
  double              objective_final      = 0.;
  double              constraint_violation = 0.; ///< as in Iteration
  double              projected_gradient   = 0.; ///< as in Iteration
  /// name of the constraint with this violation, for messages; whoever calls minimize() sets it
  std::string violated;
  StopReason  end = StopReason::none;
  /// "gradient tolerance", "objective tolerance", "design tolerance",
  /// "maximum evaluations", "round-off", "constraints violated",
  /// "interrupted", "the gradient of a constraint vanishes at the initial design..." (if the search
  /// came back to this design) or "failed evaluations (...)" with the message of the last one
  std::string stop_reason;
  /// whether the search stopped by a tolerance at a design that satisfies the constraints, or by
  /// round-off at such a design where the projected gradient is at most the square root of the
  /// objective tolerance (the objective is then within about that tolerance of its minimum)
  bool success = false;
};

/// Violation of constraints, relative to their limits, up to which a design is a result if a search
/// is cut short. Searches follow curved constraints, and their designs violate them by the square
/// of a step.
constexpr double usable_violation = 1e-5;

/// Return why @p result is not usable. The text is empty if the search converged, or if it ran out
/// of evaluations or was interrupted at a design that satisfies the constraints, up to
/// usable_violation.
std::string failure_reason(const OptimizationResult     &result,
                           const OptimizationParameters &parameters);

/// Return whether an algorithm supports equality constraints.
bool takes_equalities(Algorithm algorithm);

/**
 * Minimize with the algorithm that the parameters name. All ranks that share evaluate() of the
 * problem must call this function with the same numbers.
 *
 * The start is moved into the bounds. A design without a value (SolveError,
 * TangledMesh, a number that is not finite) ends the step to this design, see TrustRegion and
 * MmaSearch. An Interrupted thrown by evaluate() or a hook ends the search with the stop reason
 * "interrupted". Other exceptions of evaluate() and of hooks pass through unchanged.
 *
 * @throws InputError if a lower bound is above its upper bound, a bound or
 *   the start is not finite, a tolerance is not positive, no evaluation is
 *   allowed, the algorithm does not support equalities, or there are more
 *   equalities than variables.
 * @throws SolveError, TangledMesh or Interrupted if the first evaluation
 *   throws it, because there is no design to return.
 */
OptimizationResult minimize(const DesignProblem          &problem,
                            const OptimizationParameters &parameters,
                            const Hooks                  &hooks = Hooks());
} // namespace snug::optimization

#endif
