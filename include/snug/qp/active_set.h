#ifndef snug_qp_active_set_h
#define snug_qp_active_set_h

#include <snug/qp/set_rules.h>
#include <snug/qp/solver.h>

namespace snug::qp {
/**
 * Inexact primal-dual active set method (a semismooth Newton method). The rows of the active set M
 * are equations, and the other rows carry no force. FaceKrylov solves the linear problem on M only
 * as exactly as the set is known: to a part of the last KKT residual. The next set is
 * @f[ M \leftarrow E \cup \{ i : i \in M \text{ and } \lambda_i > 0, \text{ or }
 *     i \notin M \text{ and } w_i > 0 \}, @f]
 * where zero means zero up to rounding (force_rounding()). This is the set
 * @f$\lambda_i + c w_i > 0@f$ in the limit of c to 0. For exact solutions every c > 0 gives the
 * same set, because @f$\lambda_i w_i = 0@f$. For rough solutions @f$w_i@f$ on the active rows is
 * the error of the inner solve, which does not affect the set in this form.
 *
 * The start is lambda_Im on DualProblem::initial_active_set(), or the WarmStart. A set too small to
 * balance the loads gains the contacts that close in the motion that the set leaves free. There is
 * no proof of convergence for elasticity. Repeated sets therefore lead to more exact inner solves,
 * then to changes of one row (the one with the largest number), then to SMALSE-M. A KKT residual
 * that stalls also leads to SMALSE-M.
 *
 * With Coulomb or Tresca friction each closed contact sticks or slips, and friction forces of
 * slipping contacts are eliminated (FreeRows). FrictionSets decides the next sets in the same loop.
 * Where only slipping contacts hold a loaded body, HeldSets changes them before the linear problem
 * is solved. Where the sets do not settle, the method starts again with limits of friction forces
 * from the last step.
 *
 * Source: Hintermüller, Ito, Kunisch, The primal-dual active set strategy as a semismooth Newton
 * method, SIAM J. Optim. 13 (2003); Hüeber, Wohlmuth, A primal-dual active set strategy for
 * non-linear multibody contact problems, Comput. Methods Appl. Mech. Engrg. 194 (2005); with
 * friction Hüeber, Stadler, Wohlmuth, SIAM J. Sci. Comput. 30 (2008), for the sets; the elimination
 * of friction forces and the changes for free motions are Snug's own.
 */
class ActiveSet : public Solver
{
public:
  /// @p rules hold without friction.
  explicit ActiveSet(const SolverParameters &parameters, const SetRules &rules = SetRules());

  /// @throws SolveError also "no equilibrium", and "slides" with the body and the load that
  /// friction cannot hold.
  DualSolution solve(const DualProblem &problem, const WarmStart &start) const override;

private:
  DualSolution solve_with_friction(const DualProblem &problem, const WarmStart &start) const;

  SolverParameters parameters;
  SetRules         rules;
};
} // namespace snug::qp

#endif
