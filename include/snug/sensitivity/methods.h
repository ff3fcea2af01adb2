#ifndef snug_sensitivity_methods_h
#define snug_sensitivity_methods_h

#include <snug/sensitivity/gradient_problem.h>
#include <snug/sensitivity/kkt_vectors.h>

namespace snug::sensitivity {
/// Return whether dJ/dalpha needs a linear solve. It does not if the state makes J stationary or if
/// J depends on the geometry alone. Without @p has_potential (StateSolver::has_potential()) the
/// state makes no J stationary.
template <int dim>
bool needs_solve(const response::Response<dim> &response, bool has_potential);

/// Return the partial derivatives of all responses. Collective.
template <int dim>
std::vector<response::Partials<dim>> partials_of(const GradientProblem<dim> &problem,
                                                 const Responses<dim>       &responses);

/// Return (dJ/du, dJ/dlambda), one column per response.
template <int dim>
KktVectors state_partials(const state::StateSolver<dim>              &solver,
                          const state::ContactState<dim>             &state,
                          const std::vector<response::Partials<dim>> &partials);

/// Compute the adjoint states K w + B_s' eta = dJ/du, B_s w = dJ/dlambda_s of the
/// responses, one column each. One block solve on the strongly active set s uses
/// the factorizations of the state and the tolerance of @p parameters. Collective.
/// @throws SolveError.
template <int dim>
KktVectors adjoint_states(const state::StateSolver<dim>              &solver,
                          const state::ContactState<dim>             &state,
                          const std::vector<response::Partials<dim>> &partials,
                          Solves                                      solves,
                          const qp::SolverParameters                 &parameters);

/// Return ft and ct of data_derivatives(), one column per variable. Collective.
template <int dim>
KktVectors residual_derivatives(const GradientProblem<dim> &problem);

/**
 * Compute u'_j (per subdomain) and lambda'_j (owned rows), one column per variable,
 * by the direct method on the strongly active set, for the residual_derivatives() @p data. All
 * columns use the factorizations of the state. Collective. @throws SolveError.
 */
template <int dim>
KktVectors state_derivatives(const GradientProblem<dim> &problem, const KktVectors &data);

/**
 * @name Methods
 * Each of the following functions is one method for any responses of any load cases. All of them
 * are collective and throw SolveError. With exact derivatives of the data, the first two functions
 * compute dJ/dX. The last two functions compute u'.
 *
 * In a sequence of load steps, the slips s_k = B_T (u_k - u_k-1) refer to the step before, so that
 * ct_k has the term B_T u'_k-1 + B_T' u_k-1 - g' in its tangential rows. The direct method computes
 * the derivatives of the steps forward. The adjoint method computes adjoint states backward: the
 * multipliers eta_k of tangential rows add eta_k (B_T u_k-1 - g) to the response, as a function of
 * step k - 1.
 * @{
 */

/**
 * Compute J' = dJ/dX . V - lambda'(g' - B'u) for responses that need no solve:
 * their adjoint state is w = 0, eta = -lambda or zero.
 * @throws InputError for other responses.
 */
template <int dim>
Gradients<dim> energy_gradients(const LoadCases<dim>         &load_cases,
                                const MeasuredResponses<dim> &measured);

/**
 * Compute J'_j = dJ/dX . V_j + w'ft_j + eta'ct_j with the adjoint_states() of all responses.
 */
template <int dim>
Gradients<dim> adjoint_gradients(const LoadCases<dim>         &load_cases,
                                 const MeasuredResponses<dim> &measured);

/// Compute J'_j = dJ/dX . V_j + dJ/du . u'_j + dJ/dlambda . lambda'_j.
template <int dim>
Gradients<dim> direct_gradients(const LoadCases<dim>         &load_cases,
                                const MeasuredResponses<dim> &measured);

/// Compute differences of states solved from a cold start, by parameters.differences. The solver is
/// left at a geometry other than that of the states.
template <int dim>
Gradients<dim> difference_gradients(const LoadCases<dim>         &load_cases,
                                    const MeasuredResponses<dim> &measured);
/// @}
} // namespace snug::sensitivity

#endif
