#ifndef snug_mortar_multiplier_nodes_h
#define snug_mortar_multiplier_nodes_h

#include <snug/mesh/surface.h>

namespace snug::mortar {
/// Integrals of the shape functions of a slave face over its part opposite
/// to the master side, and over all of it.
struct FaceCover
{
  unsigned int        face; ///< index into the surface
  std::vector<double> covered, whole;
};

/**
 * The slave nodes that carry a multiplier. The others give their multiplier
 * functions psi_j away, psi_i + sum_j share_ji psi_j, sum_i share_ji = 1,
 * so that all of them still sum to 1 and no pressure is lost:
 * - hanging nodes to their masters;
 * - nodes that are held in the normal direction, and have no displacement
 *   the row could act on, to the nearest nodes that are not (Wohlmuth,
 *   SIAM J. Numer. Anal. 38, 2000, for corners);
 * - nodes the cover of which is less than a quarter of what it could be on
 *   each of their faces, to the nearest better covered ones: their rows
 *   would be almost copies of those.
 * Where all nodes are badly covered the best keeps its multiplier; held
 * nodes without free neighbours keep theirs.
 */
struct MultiplierNodes
{
  /// (index in nodes, share); the shares of a node sum to 1.
  using Shares = std::vector<std::pair<unsigned int, double>>;

  /// Surface nodes, in the order of the faces and their nodes.
  std::vector<unsigned int> nodes;
  /// Who has the multiplier function of each surface node; nobody if it is
  /// on no covered face.
  std::vector<Shares> shares;
};

/// The multiplier nodes of the slave faces with @p covers, without those
/// that are not covered at all; @p held and @p positions per surface node.
template <int dim>
MultiplierNodes choose_multiplier_nodes(const mesh::Surface<dim>                 &surface,
                                        const std::vector<FaceCover>             &covers,
                                        const std::vector<bool>                  &held,
                                        const typename mesh::Surface<dim>::Field &positions);
} // namespace snug::mortar

#endif
