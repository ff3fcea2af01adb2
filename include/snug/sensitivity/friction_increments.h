#ifndef snug_sensitivity_friction_increments_h
#define snug_sensitivity_friction_increments_h

#include <snug/sensitivity/kkt_vectors.h>
#include <snug/state/state_solver.h>

namespace snug::sensitivity {
/**
 * Return the one-sided derivatives (u', lambda') of a state with Coulomb friction along one column
 * of @p data of data_derivatives(), where some contacts are weakly active. The increments obey the
 * law that is linear in them.
 *
 * A contact between stick and slip along n^
 *  - sticks with n^.lambda_T' <= mu lambda_N',
 *  - or slips with n^.s' >= 0 and n^.lambda_T' = mu lambda_N'.
 *
 * A grazing contact, which has neither force nor gap,
 *  - is open with w_N' <= 0,
 *  - or closed with lambda_N' >= 0 and lambda_T' = mu lambda_N' s/|s|; without a slip s of the
 *    state it sticks or slips along lambda_T'.
 *
 * The sets change until all inequalities hold; each change costs a linear solve. Collective.
 * @throws SolveError if they do not settle, and under the Tresca law, whose bounds are not known
 *   where a slip begins.
 */
template <int dim>
KktVectors friction_increments(const state::StateSolver<dim>  &solver,
                               const state::ContactState<dim> &state,
                               const KktVectors               &data);
} // namespace snug::sensitivity

#endif
