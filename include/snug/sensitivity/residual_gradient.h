#ifndef snug_sensitivity_residual_gradient_h
#define snug_sensitivity_residual_gradient_h

#include <snug/sensitivity/kkt_vectors.h>
#include <snug/state/state_solver.h>

namespace snug::sensitivity {
/**
 * Add to @p gradient the field d/dX (w'(f - K u - B'lambda) + eta'(g - B u) + x'b n^) at
 * fixed u, lambda, w, eta, x and n^. The product of this field with the velocities V_j is
 * that of (w, eta, x) with data_derivatives(), for any number of velocities at the cost
 * of one. (w, eta, x) is column @p j of @p adjoint, x its given part. The field is this rank's
 * share at the local nodes, including hanging nodes. Collective.
 */
template <int dim>
void add_residual_gradient(const state::StateSolver<dim>  &solver,
                           const state::ContactState<dim> &state,
                           const KktVectors               &adjoint,
                           unsigned int                    j,
                           mesh::Field<dim>               &gradient);
} // namespace snug::sensitivity

#endif
