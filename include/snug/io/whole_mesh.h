#ifndef snug_io_whole_mesh_h
#define snug_io_whole_mesh_h

#include <snug/mesh/body_mesh.h>

#include <map>
#include <set>

namespace snug::io {
/**
 * The mesh of all bodies on rank 0, for mesh files. Nodes are numbered in the order of the cells,
 * and cells are sorted by body and cell id, so that the numbers do not depend on the ranks.
 */
template <int dim>
struct WholeMesh
{
  struct Cell
  {
    unsigned int              body, region;
    std::vector<unsigned int> nodes; ///< tensor-product order
  };

  struct Face
  {
    unsigned int              body, boundary;
    unsigned int              cell;   ///< index into cells
    unsigned int              number; ///< number in the cell: side s of axis d is 2d + s
    std::vector<unsigned int> nodes;  ///< oriented outwards, first tangent fastest
  };

  struct Hanging
  {
    unsigned int                                 node;
    std::vector<std::pair<unsigned int, double>> masters;
  };

  std::vector<dealii::Tensor<1, dim>> positions, forces; ///< per node
  std::vector<Cell>                   cells;
  std::vector<Face>                   faces;
  std::vector<Hanging>                hanging;
  std::vector<unsigned int>           number_of; ///< global node -> node
  /// body -> regions with cells
  std::map<unsigned int, std::set<unsigned int>> regions;
};

/// Return WholeMesh::number_of on rank 0, and nothing on other ranks. Rank 0 needs a third of the
/// memory of gather_mesh(). Collective.
template <int dim>
std::vector<unsigned int> gather_node_numbers(const mesh::BodyMesh<dim> &mesh);

/// Gather the mesh with the nodes at @p positions and nodal @p forces, which are the sums over the
/// ranks; without forces they are zero. The result is empty on ranks other than 0. Collective.
template <int dim>
WholeMesh<dim> gather_mesh(const mesh::BodyMesh<dim>                 &mesh,
                           const typename mesh::BodyMesh<dim>::Field &positions,
                           const typename mesh::BodyMesh<dim>::Field &forces = {});
} // namespace snug::io

#endif
