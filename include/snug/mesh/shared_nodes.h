#ifndef snug_mesh_shared_nodes_h
#define snug_mesh_shared_nodes_h

#include <snug/mesh/body_mesh.h>

#include <vector>

namespace snug::mesh {
/**
 * Replace nodal values by their sums over ranks.
 * @param[in,out] values @p n_components values per local node, node by
 *   node: this rank's contributions in, the sums of all ranks out, at all
 *   local nodes. Collective; summed in the order of the ranks.
 */
template <int dim>
void sum_at_shared_nodes(const mesh::BodyMesh<dim> &mesh,
                         unsigned int               n_components,
                         std::vector<double>       &values);

/// A nodal field at all local nodes by the values of the ranks that own them. Collective.
template <int dim>
typename BodyMesh<dim>::Field owners_values(const BodyMesh<dim>                 &mesh,
                                            const typename BodyMesh<dim>::Field &field);
} // namespace snug::mesh

#endif
