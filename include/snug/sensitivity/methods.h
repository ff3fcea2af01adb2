#ifndef snug_sensitivity_methods_h
#define snug_sensitivity_methods_h

#include <snug/sensitivity/gradient_problem.h>
#include <snug/sensitivity/kkt_vectors.h>

namespace snug::sensitivity {
/// Whether dJ/dalpha takes a linear solve: not if the state makes J
/// stationary or J depends on the geometry alone.
template <int dim>
bool needs_solve(const response::Response<dim> &response);

/// The partial derivatives of all responses. Collective.
template <int dim>
std::vector<response::Partials<dim>> partials_of(const GradientProblem<dim> &problem,
                                                 const Responses<dim>       &responses);

/// (dJ/du, dJ/dlambda), a column per response.
template <int dim>
KktVectors state_partials(const state::StateSolver<dim>              &solver,
                          const state::ContactState<dim>             &state,
                          const std::vector<response::Partials<dim>> &partials);

/// The adjoint states K w + B_s' eta = dJ/du, B_s w = dJ/dlambda_s of responses, a column each,
/// by one block solve on the strongly active set s with the factorizations of the state,
/// to the tolerance of @p parameters.
/// Collective. @throws SolveError.
template <int dim>
KktVectors adjoint_states(const state::StateSolver<dim>              &solver,
                          const state::ContactState<dim>             &state,
                          const std::vector<response::Partials<dim>> &partials,
                          Solves                                      solves,
                          const qp::SolverParameters                 &parameters);

/// ft and ct of data_derivatives(), a column per variable. Collective.
template <int dim>
KktVectors residual_derivatives(const GradientProblem<dim> &problem);

/**
 * u'_j (per subdomain) and lambda'_j (owned rows), a column per variable,
 * by the direct method on the strongly active set, all from the
 * factorizations of the state. Collective. @throws SolveError.
 */
template <int dim>
KktVectors state_derivatives(const GradientProblem<dim> &problem);

// Each of these is one method for any responses. All are collective and
// throw SolveError. dJ/dX is given by the first
// two with exact derivatives of the data, u' by the last two.

/**
 * J' = dJ/dX . V - lambda'(g' - B'u) for responses that need no solve:
 * the adjoint state is w = 0, eta = -lambda or zero.
 * @throws InputError for others.
 */
template <int dim>
Gradients<dim> energy_gradients(const GradientProblem<dim> &problem,
                                const Responses<dim>       &responses);

/**
 * J'_j = dJ/dX . V_j + w'ft_j + eta'ct_j with the adjoint_states() of all responses.
 */
template <int dim>
Gradients<dim> adjoint_gradients(const GradientProblem<dim> &problem,
                                 const Responses<dim>       &responses);

/// J'_j = dJ/dX . V_j + dJ/du . u'_j + dJ/dlambda . lambda'_j.
template <int dim>
Gradients<dim> direct_gradients(const GradientProblem<dim> &problem,
                                const Responses<dim>       &responses);

/// Differences of states solved from cold, by parameters.differences. The
/// solver is left at another geometry than the state's.
template <int dim>
Gradients<dim> difference_gradients(const GradientProblem<dim> &problem,
                                    const Responses<dim>       &responses);
} // namespace snug::sensitivity

#endif
