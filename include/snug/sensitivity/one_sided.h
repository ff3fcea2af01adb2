#ifndef snug_sensitivity_one_sided_h
#define snug_sensitivity_one_sided_h

#include <snug/sensitivity/gradient_problem.h>
#include <snug/sensitivity/kkt_vectors.h>

namespace snug::sensitivity {
/**
 * Compute u'(alpha; beta) and lambda'(alpha; beta), the derivatives of the state when the design
 * moves in the directions beta. @p data contains ft and ct of data_derivatives() along any number
 * of directions, one column each. If contacts are weakly active, each column is the solution of the
 * QP of equation (14), or with friction that of friction_increments(). The QP solver starts from
 * the solution on the strongly active set. The derivatives are not linear in beta. Collective.
 * @throws SolveError.
 */
template <int dim>
KktVectors directional_derivatives(const state::StateSolver<dim>  &solver,
                                   const state::ContactState<dim> &state,
                                   const KktVectors               &data);

/// One-sided derivatives of a response with respect to each variable.
struct OneSided
{
  std::vector<double> increasing; ///< lim (J(a + t e_j) - J(a)) / t
  std::vector<double> decreasing; ///< lim (J(a) - J(a - t e_j)) / t
};

/// Compute the one-sided derivatives of every response. Collective.
/// @throws SolveError.
template <int dim>
std::vector<OneSided> one_sided_gradients(const GradientProblem<dim> &problem,
                                          const Responses<dim>       &responses);
} // namespace snug::sensitivity

#endif
