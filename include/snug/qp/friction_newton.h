#ifndef snug_qp_friction_newton_h
#define snug_qp_friction_newton_h

#include <snug/qp/solver.h>

namespace snug::qp {
/**
 * Semismooth Newton method for contact with Coulomb or Tresca friction, in one loop. Each contact
 * is open, sticks or slips. On given sets the problem is linear: friction forces of slipping
 * contacts are eliminated (FreeRows), and ProjectedGcr solves it to a part of the last KKT
 * residual. The next sets follow from x = lambda_T + w_T / F_TT and the limit b of FrictionCone:
 *
 * | set   | condition                                                                            |
 * |-------|--------------------------------------------------------------------------------------|
 * | open  | closed with lambda_N < 0, or open with w_N <= 0                                      |
 * | stick | closed with |x| <= b, and a slip in the plane that turns round                       |
 * | slip  | closed with |x| > b, along n^ = x / |x|; D = min((|x| - b) / b, 1e6) F_TT across it  |
 *
 * A slip that turns round sticks first, because the reversed slip would turn back in the next step.
 * The start is that of ActiveSet, where all contacts stick.
 *
 * Sets on which nothing holds a body that is loaded, or that only slipping contacts hold, are
 * changed before the linear problem is solved: slips against the free motion turn round and one
 * contact sticks, or open contacts close that close in this motion.
 *
 * Source: Hüeber, Stadler, Wohlmuth, A primal-dual active set algorithm for three-dimensional
 * contact problems with Coulomb friction, SIAM J. Sci. Comput. 30 (2008), for the sets; the
 * elimination of friction forces and the changes for free motions are Snug's own.
 *
 * @throws SolveError "no equilibrium", "slides" with the body and the load that friction cannot
 *   hold, or "does not converge". Collective.
 */
DualSolution friction_newton(const DualProblem      &problem,
                             const SolverParameters &parameters,
                             const WarmStart        &start);
} // namespace snug::qp

#endif
