#ifndef snug_sensitivity_tangent_system_h
#define snug_sensitivity_tangent_system_h

#include <snug/sensitivity/gradient_parameters.h>
#include <snug/sensitivity/kkt_vectors.h>
#include <snug/state/state_solver.h>

namespace snug::sensitivity {
/// Return the equality rows and the strongly active contact rows of a state. Contacts with friction
/// stick or slip as in the state, with D = |s| / b at the slips s of the state. Collective.
template <int dim>
qp::FreeRows strong_rows(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state);

/**
 * The tangent of the optimality conditions on a set M of rows,
 * @f[ \begin{pmatrix} K & B_M^T \\ B_M & 0 \end{pmatrix}
 *     \begin{pmatrix} z \\ \mu \end{pmatrix} =
 *     \begin{pmatrix} b \\ c_M \end{pmatrix},
 *     \qquad \mu = 0 \text{ off } M. @f]
 * The system is symmetric. The same solve therefore gives derivatives of the state,
 * with b = f' - K'u - B'^T lambda and c = g' - B'u, and adjoint states, with the
 * partial derivatives of a response.
 *
 * Where contacts slip, mu = Z y and the rows are Z_0'(B z - c) = D y, see qp::FreeRows: the
 * friction force changes with the normal force. Adjoint states solve the transposed system. Both
 * are solved by qp::FaceKrylov. Given parts of the multipliers are added to Z y.
 *
 * The dual of the system, min 1/2 mu'F mu - mu'(B K^+ b - c) with G mu = R'b, is solved by PCPG.
 * PCPG uses the factorizations of the state and needs no other one. It first minimizes in the
 * F-orthonormal directions recorded in the solve of the state.
 */
class TangentSystem
{
public:
  /// @p feti must outlive this object. Solves begin in the directions @p known of
  /// the state's solver. Collective.
  TangentSystem(const feti::LoadedProblem  &feti,
                const qp::FreeRows         &rows,
                const qp::SolverParameters &parameters,
                Solves                      solves,
                const qp::DirectionBasis   &known);

  /**
   * Return z and mu for every column. Collective.
   * @throws SolveError if the residual of a column does not fall below the relative tolerance.
   */
  KktVectors solve(const KktVectors &right_hand_sides) const;

private:
  qp::MultiVector start_residual(const KktVectors      &right_hand_sides,
                                 const qp::MultiVector &mu) const;
  bool            minimize(qp::MultiVector           &mu,
                           qp::MultiVector           &residual,
                           const std::vector<double> &tolerances,
                           bool                       deflates) const;
  bool            balanced(const feti::PrimalVectors &b, const qp::MultiVector &mu) const;

  const feti::LoadedProblem         &feti;
  const qp::SolverParameters         parameters;
  const Solves                       solves;
  const std::unique_ptr<qp::FreeSet> free_set;
  const qp::DirectionBasis           known;
};
} // namespace snug::sensitivity

#endif
