#ifndef snug_sensitivity_data_derivatives_h
#define snug_sensitivity_data_derivatives_h

#include <snug/sensitivity/gradient_parameters.h>
#include <snug/sensitivity/kkt_vectors.h>
#include <snug/state/state_solver.h>

namespace snug::sensitivity {
/**
 * Compute the right-hand sides of the sensitivity problem for k velocities V_j, one
 * column each (equation 14 of Vondrák, Kozubek, Dostál; the paper prints f' in c_w
 * and c_s, where the derivative g' of the gap is meant):
 *
 * primal ft_j = f'_j - K'_j u - B'_j^T lambda per subdomain,
 * dual ct_j = g'_j - B'_j u + D'_j lambda on the owned rows,
 * given b' n^, the bound_derivatives(), which are exact.
 *
 * parameters.derivatives selects exact derivatives or differences of K, f, B and g
 * (semi-analytic derivatives). Collective.
 */
template <int dim>
KktVectors data_derivatives(const state::StateSolver<dim>       &solver,
                            const state::ContactState<dim>      &state,
                            const std::vector<mesh::Field<dim>> &velocities,
                            const GradientParameters            &parameters);
} // namespace snug::sensitivity

#endif
