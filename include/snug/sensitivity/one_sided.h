#ifndef snug_sensitivity_one_sided_h
#define snug_sensitivity_one_sided_h

#include <snug/sensitivity/gradient_problem.h>
#include <snug/sensitivity/kkt_vectors.h>

namespace snug::sensitivity {
/**
 * u'(alpha; beta) and lambda'(alpha; beta), the derivatives of the state
 * on moving from the design in the directions beta, for any directions
 * (ft and ct of data_derivatives() along them, one column each): the QP of
 * equation (14) where contacts are weakly active, started from the solution
 * on the strongly active set. They are not linear in beta. Collective.
 * @throws SolveError.
 */
template <int dim>
KktVectors directional_derivatives(const state::StateSolver<dim>  &solver,
                                   const state::ContactState<dim> &state,
                                   const KktVectors               &data);

/// Derivatives of a response by each variable, seen from both sides.
struct OneSided
{
  std::vector<double> increasing; ///< lim (J(a + t e_j) - J(a)) / t
  std::vector<double> decreasing; ///< lim (J(a) - J(a - t e_j)) / t
};

/// The one-sided derivatives of every response. Collective.
/// @throws SolveError.
template <int dim>
std::vector<OneSided> one_sided_gradients(const GradientProblem<dim> &problem,
                                          const Responses<dim>       &responses);
} // namespace snug::sensitivity

#endif
