#ifndef snug_mortar_multiplier_nodes_h
#define snug_mortar_multiplier_nodes_h

#include <snug/faces/face_shape.h>

namespace snug::mortar {
/// Integrals of the shape functions of a slave face over its part opposite to the master side, and
/// over the whole face.
struct FaceCover
{
  unsigned int        face; ///< index of the surface face
  std::vector<double> covered, whole;
  /// Nodes that do not hang, with the weights with which their multiplier functions contain that of
  /// each node of the face.
  std::vector<std::vector<std::pair<unsigned int, double>>> functions;
};

/**
 * Slave nodes that carry a multiplier. The other slave nodes give their multiplier functions psi_j
 * away, psi_i + sum_j share_ji psi_j, sum_i share_ji = 1. So all functions still sum to 1 and no
 * pressure is lost:
 * - Hanging nodes give their functions to their masters.
 * - Nodes that are held in the normal direction have no displacement on which the row could act.
 *   They give their functions to the nearest nodes that are not held (Wohlmuth, SIAM J. Numer.
 *   Anal. 38, 2000, for corners).
 * - Nodes with less than half of the possible cover on each of their faces give their
 *   functions to the nearest better covered nodes, whose rows their own rows would almost copy.
 *
 * Where all nodes are badly covered, the best covered node keeps its multiplier. Held nodes without
 * free neighbours keep their multipliers.
 */
struct MultiplierNodes
{
  /// Pairs (index in nodes, share); the shares of a node sum to 1.
  using Shares = std::vector<std::pair<unsigned int, double>>;

  /// Surface nodes, in the order of the faces and their nodes.
  std::vector<unsigned int> nodes;
  /// Owners of the multiplier function of each surface node; empty if the node is on no covered
  /// face.
  std::vector<Shares> shares;
};

/// Return the multiplier nodes of the slave faces with @p covers, without nodes that are not
/// covered at all and nodes without an area (faces::nodes_without_area()). @p held and @p positions
/// are given per surface node.
template <int dim>
MultiplierNodes choose_multiplier_nodes(const mesh::Surface<dim>                 &surface,
                                        const std::vector<FaceCover>             &covers,
                                        const std::vector<bool>                  &held,
                                        const faces::FaceShape<dim>              &shape,
                                        const typename mesh::Surface<dim>::Field &positions);
} // namespace snug::mortar

#endif
