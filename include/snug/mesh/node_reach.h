#ifndef snug_mesh_node_reach_h
#define snug_mesh_node_reach_h

#include <snug/mesh/body_mesh.h>

namespace snug::mesh {
/**
 * Where the n nodes of a cell or face find their values in a vector of
 * some nodes of the mesh: at one of those (slot), or, hanging, as the
 * combination T of their masters' slots.
 */
template <int dim>
class NodeReach
{
public:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  /// @p nodes of the mesh; slots are places in @p among, ascending and
  /// with all masters, or the nodes themselves if that is empty.
  NodeReach(const BodyMesh<dim>             &mesh,
            const std::vector<unsigned int> &nodes,
            const std::vector<unsigned int> &among = {});

  /// Those reached; in the order of the nodes if none hangs.
  const std::vector<unsigned int> &slots() const { return reached; }

  /// Values at the nodes, T u.
  Nodes values(const double *u) const;

  /// u += factor * T' r.
  void add(double factor, const Nodes &r, double *u) const;

  /// K <- T' K T, from the nodes' unknowns to the slots' (row by row).
  void condense(std::vector<double> &K) const;

private:
  unsigned int              n_nodes;
  std::vector<unsigned int> reached;
  std::vector<double>       T; ///< n_nodes x slots, row by row, or empty
};
} // namespace snug::mesh

#endif
