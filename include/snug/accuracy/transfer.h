#ifndef snug_accuracy_transfer_h
#define snug_accuracy_transfer_h

#include <snug/state/state_solver.h>

namespace snug::accuracy {
/**
 * Where the solve on another mesh of the same bodies begins: contact pressures at the slave nodes
 * by their positions on the slave side of @p state, times the areas there; active where they push,
 * other rows without force. Nothing, for a cold start, where none does.
 * @param positions of the nodes of the mesh of @p to.
 * Collective.
 */
template <int dim>
qp::WarmStart transferred(const state::StateSolver<dim>             &from,
                          const state::ContactState<dim>            &state,
                          const state::StateSolver<dim>             &to,
                          const typename mesh::BodyMesh<dim>::Field &positions);
} // namespace snug::accuracy

#endif
