#ifndef snug_optimization_starts_h
#define snug_optimization_starts_h

#include <snug/optimization/minimize.h>

namespace snug::optimization {
/// Return whether @p a satisfies the constraints and @p b does not, or, if both satisfy them, has
/// the lower objective, or, if none does, the lower violation.
bool is_better(const OptimizationResult     &a,
               const OptimizationResult     &b,
               const OptimizationParameters &parameters);

/**
 * Minimize from the start of @p problem and from `parameters.starts` - 1 random designs, one after
 * the other, and return the best result: that with the lowest objective among those that satisfy
 * the constraints, or, if there is none, that with the lowest violation. The variables of a random
 * design are independent and uniform between their bounds; design number k has the seed k.
 *
 * Iterations and evaluations are counted through all searches, whose evaluations together do not
 * exceed the maximum. A random design that cannot be evaluated is reported and left out. An
 * interruption ends all searches. Ranks, errors and the rest are those of minimize().
 */
OptimizationResult minimize_from_starts(const DesignProblem          &problem,
                                        const OptimizationParameters &parameters,
                                        const Hooks                  &hooks = Hooks());
} // namespace snug::optimization

#endif
