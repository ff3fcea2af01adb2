#ifndef snug_qp_active_set_h
#define snug_qp_active_set_h

#include <snug/qp/solver.h>

namespace snug::qp {
/// Accuracy of inner solves, and limits for repeated sets and stalled residuals.
struct ActiveSetOptions
{
  /// Tolerance of inner solves, as a part of the KKT residual. Rough solutions show which rows
  /// leave as well as exact solutions do, and the directions found on the way are kept. Measured on
  /// contact problems: 0.7 takes up to a third fewer F-mults than 0.1.
  double forcing = 0.7;
  /// Number of visits of one set after which the inner problems are solved more exactly. After one
  /// more visit, only one row changes per step.
  unsigned int visits = 3;
  /// Number of steps that change one row each, before the fall-back to SMALSE-M.
  unsigned int single_steps = 50;
  /// Number of steps with entering rows and without a KKT residual a tenth below all previous ones,
  /// after which SMALSE-M takes over. Contact problems that are solved take 5 to 30 steps in all.
  unsigned int patience = 30;
};

/**
 * Inexact primal-dual active set method (a semismooth Newton method). The rows of the active set M
 * are equations, and the other rows carry no force. Pcpg solves the linear problem on M only as
 * exactly as the set is known: to a part of the last KKT residual. The next set is
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
 * Source: Hintermüller, Ito, Kunisch, The primal-dual active set strategy as a semismooth Newton
 * method, SIAM J. Optim. 13 (2003); Hüeber, Wohlmuth, A primal-dual active set strategy for
 * non-linear multibody contact problems, Comput. Methods Appl. Mech. Engrg. 194 (2005).
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
