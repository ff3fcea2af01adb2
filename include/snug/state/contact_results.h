#ifndef snug_state_contact_results_h
#define snug_state_contact_results_h

#include <snug/state/state_solver.h>

namespace snug::state {
/// Return the values at the local nodes of one column of primal vectors. The values are those of
/// the first copy on this rank. Hanging nodes are interpolated.
template <int dim>
typename mesh::BodyMesh<dim>::Field
nodal_values(const StateSolver<dim> &solver, const feti::PrimalVectors &u, unsigned int column);

/// Return the forces of the contact rows of a state: normal rows, then tangential rows [force].
/// Collective.
template <int dim>
std::vector<double> contact_row_forces(const StateSolver<dim>  &solver,
                                       const ContactState<dim> &state);

/// Set displacement, energies and contact points of a state from its u and dual solution. @p rows
/// are the rows at the geometry of the state. Collective.
template <int dim>
void recover_contact_results(const StateSolver<dim>     &solver,
                             const RowCoefficients<dim> &rows,
                             ContactState<dim>          &state);
} // namespace snug::state

#endif
