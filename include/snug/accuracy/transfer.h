#ifndef snug_accuracy_transfer_h
#define snug_accuracy_transfer_h

#include <snug/state/state_solver.h>

namespace snug::accuracy {
/**
 * Return the start of a solve on another mesh of the same bodies. The forces are the contact
 * pressures at the slave nodes, by their positions on the slave side of @p state, times the
 * tributary areas there. Rows with a positive force are active, all other rows have no force. If
 * no row has a force, return an empty start, which is a cold start.
 * @param positions positions of the nodes of the mesh of @p to. Collective.
 */
template <int dim>
qp::WarmStart transferred(const state::StateSolver<dim>  &from,
                          const state::ContactState<dim> &state,
                          const state::StateSolver<dim>  &to,
                          const mesh::Field<dim>         &positions);
} // namespace snug::accuracy

#endif
