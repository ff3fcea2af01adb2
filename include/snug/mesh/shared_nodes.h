#ifndef snug_mesh_shared_nodes_h
#define snug_mesh_shared_nodes_h

#include <snug/mesh/body_mesh.h>

#include <vector>

namespace snug::mesh {
/**
 * Replace nodal values by their sums over ranks. Values are summed in the order of the ranks.
 * Collective.
 * @param[in,out] values @p n_components values per local node, node by
 *   node: the contributions of this rank on input, the sums over all ranks on output.
 */
template <int dim>
void sum_at_shared_nodes(const mesh::BodyMesh<dim> &mesh,
                         unsigned int               n_components,
                         std::vector<double>       &values);

/// Return a nodal field with the values of the owners of the nodes at all local nodes. Collective.
template <int dim>
Field<dim> owners_values(const BodyMesh<dim> &mesh, const Field<dim> &field);
} // namespace snug::mesh

#endif
