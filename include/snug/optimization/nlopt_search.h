#ifndef snug_optimization_nlopt_search_h
#define snug_optimization_nlopt_search_h

#include <snug/optimization/minimize.h>

namespace snug::optimization {
/// Algorithms of NLopt.
enum class NloptAlgorithm
{
  SLSQP,
  MMA,   ///< no equality constraints
  CCSAQ, ///< no equality constraints
  AUGLAG ///< augmented Lagrangian, with L-BFGS inside
};

/**
 * A search with an algorithm of NLopt, in variables scaled by their bound
 * widths and with objective and constraints scaled to order one
 * (ScaledProblem).
 *
 * SLSQP ends at an accepted design x that meets the constraints to the
 * constraint tolerance when its projected gradient is at most
 * gradient_tolerance or, since the accepted design before, the objective
 * changed by at most objective_tolerance |f(x)| or every variable by at
 * most design_tolerance of its bound width; if the line search shortened
 * that step, the next one must agree. NLopt 2.7.1 has its
 * own tests, but they also report success at designs that violate the
 * constraints, so they are switched off. The other algorithms do not tell
 * their iterations: each design that is better than all before counts as
 * accepted, NLopt's tests end the search with the same tolerances, and a
 * design that violates the constraints is no success.
 *
 * NLopt has no value for "this design cannot be solved" (NaN, infinity and
 * penalties all mislead it). Such a design ends NLopt's run; a new one
 * begins at the last accepted design, its moves limited to half the move
 * that failed, and is re-centred as long as it ends at such a limit. After
 * five failures the search ends. When NLopt ends by round-off, it is
 * begun again as long as that gains anything.
 *
 * Sources: Kraft, A software package for sequential quadratic programming,
 * DFVLR-FB 88-28 (1988); Svanberg, SIAM J. Optim. 12 (2002) for MMA and
 * CCSA; Birgin, Martínez, Optim. Methods Softw. 23 (2008) for AUGLAG;
 * Johnson, The NLopt nonlinear-optimization package.
 */
OptimizationResult nlopt_search(NloptAlgorithm                algorithm,
                                const DesignProblem          &problem,
                                const OptimizationParameters &parameters,
                                const Hooks                  &hooks);
} // namespace snug::optimization

#endif
