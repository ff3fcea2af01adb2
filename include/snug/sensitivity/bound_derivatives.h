#ifndef snug_sensitivity_bound_derivatives_h
#define snug_sensitivity_bound_derivatives_h

#include <snug/sensitivity/kkt_vectors.h>
#include <snug/state/state_solver.h>

namespace snug::sensitivity {
/// Return whether friction forces are bounded by Tresca's law, whose bound b = beta a changes with
/// the area a of a contact.
template <int dim>
bool has_bounds(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

/// Return b' n^ on the owned rows of contacts that slip in the direction n^, one column per
/// velocity; zero in other rows. No columns where has_bounds() is false.
template <int dim>
qp::MultiVector bound_derivatives(const state::StateSolver<dim>       &solver,
                                  const state::ContactState<dim>      &state,
                                  const std::vector<mesh::Field<dim>> &velocities);

/// Add the field d/dX (x'b n^) at fixed x to @p gradient, where x is column @p j of @p of_rows. The
/// product of this field with velocities is that of x with bound_derivatives(). Collective.
template <int dim>
void add_bound_gradient(const state::StateSolver<dim>  &solver,
                        const state::ContactState<dim> &state,
                        const qp::MultiVector          &of_rows,
                        unsigned int                    j,
                        mesh::Field<dim>               &gradient);
} // namespace snug::sensitivity

#endif
