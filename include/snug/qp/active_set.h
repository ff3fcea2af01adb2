#ifndef snug_qp_active_set_h
#define snug_qp_active_set_h

#include <snug/qp/solver.h>

namespace snug::qp {
/// How exact inner solves are, and when a set met before is a cycle.
struct ActiveSetOptions
{
  /// The inner residual is this part of the KKT residual. Rough solutions
  /// tell which rows leave as well as exact ones do, and directions found
  /// on the way are kept: 0.7 takes up to a third fewer F-mults than 0.1 on
  /// contact problems.
  double forcing = 0.7;
  /// Visits of one set after which the inner problems are solved more
  /// exactly; one more, and only one row changes per step.
  unsigned int visits = 3;
  /// Steps of one row each before the fall-back to SMALSE-M.
  unsigned int single_steps = 50;
  /// Steps in which rows enter, without a KKT residual a tenth smaller than
  /// all before, after which SMALSE-M takes over. Contact problems that are solved take 5 to
  /// 30 steps in all.
  unsigned int patience = 30;
};

/**
 * Inexact primal-dual active set method (a semismooth Newton method):
 * rows of the active set M are equations, the others carry no force, and
 * the linear problem on M is solved by Pcpg only as exactly as the set is
 * known: to a part of the last KKT residual. Then
 * @f[ M \leftarrow E \cup \{ i : i \in M \text{ and } \lambda_i > 0, \text{ or }
 *     i \notin M \text{ and } w_i > 0 \}, @f]
 * zero being meant up to rounding (force_rounding()): the set @f$\lambda_i + c w_i > 0@f$ as c goes
 * to 0. Exact solutions give the same for every c > 0, as @f$\lambda_i w_i = 0@f$; of rough ones
 * @f$w_i@f$ on the active rows is the error of the inner solve, which has
 * no say this way.
 * The start is lambda_Im on DualProblem::expected_rows(), or what WarmStart gives. A set too small
 * to balance the loads gains the contacts that close in the motion it leaves free. There is no
 * proof of convergence for elasticity: sets met again lead to more exact inner solves, then to
 * changes of one row (the one with the largest number), then to SMALSE-M, as does a KKT residual
 * that no longer falls.
 *
 * Source: Hintermüller, Ito, Kunisch, The primal-dual active set strategy
 * as a semismooth Newton method, SIAM J. Optim. 13 (2003); Hüeber,
 * Wohlmuth, A primal-dual active set strategy for non-linear multibody
 * contact problems, Comput. Methods Appl. Mech. Engrg. 194 (2005).
 */
class ActiveSet : public Solver
{
public:
  explicit ActiveSet(const SolverParameters &parameters,
                     const ActiveSetOptions &options = ActiveSetOptions());

  DualSolution solve(const DualProblem &problem, const WarmStart &start) const override;

private:
  SolverParameters parameters;
  ActiveSetOptions options;
};
} // namespace snug::qp

#endif
