#ifndef snug_state_node_reach_h
#define snug_state_node_reach_h

#include <snug/mesh/tearing.h>

namespace snug::state {
/**
 * Where the n nodes of a cell or face find their values in a subdomain's
 * vector: at one of its nodes (slot), or, hanging, as the combination T of
 * their masters' slots.
 */
template <int dim>
class NodeReach
{
public:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  NodeReach(const mesh::BodyMesh<dim>       &mesh,
            const mesh::Subdomain           &subdomain,
            const std::vector<unsigned int> &nodes);

  /// Subdomain nodes reached; in the order of the nodes if none hangs.
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
} // namespace snug::state

#endif
