#ifndef snug_state_contact_results_h
#define snug_state_contact_results_h

#include <snug/state/state_solver.h>

namespace snug::state {
/// Values at the local nodes of one column of primal vectors: those of the
/// first copy on this rank, hanging nodes interpolated.
template <int dim>
typename mesh::BodyMesh<dim>::Field
nodal_values(const StateSolver<dim> &solver, const feti::PrimalVectors &u, unsigned int column);

/// Fill in displacement, energies and contact points of a state from its
/// u and dual solution. @p rows are those of its geometry.
/// Collective.
template <int dim>
void recover_contact_results(const StateSolver<dim>     &solver,
                             const RowCoefficients<dim> &rows,
                             ContactState<dim>          &state);
} // namespace snug::state

#endif
