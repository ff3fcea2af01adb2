#ifndef snug_mesh_node_reach_h
#define snug_mesh_node_reach_h

#include <snug/mesh/body_mesh.h>

#include <memory>

namespace snug::mesh {
/**
 * This class maps the n nodes of a cell or face to slots, which are positions in a vector with
 * values at some nodes of the mesh. The value at a node is the value at one slot. The value at
 * a hanging node is a combination of the values at the slots of the masters. T holds the weights.
 */
template <int dim>
class NodeReach
{
public:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  /// Find the slots of the @p nodes of a cell or face. Slots are positions in @p among, which is
  /// ascending and contains all masters. If @p among is empty, slots are local nodes.
  NodeReach(const BodyMesh<dim>             &mesh,
            const std::vector<unsigned int> &nodes,
            const std::vector<unsigned int> &among = {});

  /// Find the slots of a cell of the mesh. Those of a tetrahedron are the slots of its ten nodes.
  static NodeReach
  of_cell(const BodyMesh<dim> &mesh, unsigned int cell, const std::vector<unsigned int> &among);

  /// Return the slots with nonzero weights: in the order of the nodes if no node hangs, and in the
  /// order of the nodes of a tetrahedron; otherwise ascending.
  const std::vector<unsigned int> &slots() const { return reached; }

  /// Return the values at the nodes, T u.
  Nodes values(const double *u) const;

  /// Add factor * T' r to u.
  void add(double factor, const Nodes &r, double *u) const;

  /// Replace K by T' K T, from the unknowns of the nodes to the unknowns of the slots (row by row).
  void condense(std::vector<double> &K) const;

private:
  using Weights = std::vector<double>;

  unsigned int              n_nodes;
  std::vector<unsigned int> reached;
  /// T, n_nodes x slots, row by row; null for the identity. Tetrahedra share it.
  std::shared_ptr<const Weights> weights;

  NodeReach() = default;
};
} // namespace snug::mesh

#endif
