#ifndef snug_contact_projection_h
#define snug_contact_projection_h

#include <snug/contact/pair_geometry.h>

#include <utility>
#include <vector>

namespace snug::contact {
/**
 * Slave node s against master face: closest point with shape function
 * weights w_k at master nodes k, found once and frozen.
 * With nodal normals n_k = a_k/|a_k| of the master side (a_k: sum over
 * its faces of the area vectors t1 x t2 at node k) the unit normal is
 * n = v/|v|, v = -sum_k w_k n_k: from the slave INTO the master body.
 */
struct Projection
{
  unsigned int slave; ///< surface node
  /// surface nodes, ascending, and weights, which sum to 1
  std::vector<std::pair<unsigned int, double>> masters;
};

/**
 * A slave node whose closest point lies on the outer edge of the master
 * side is paired if it is beyond that edge by at most this fraction of
 * the master face's extent.
 */
constexpr double edge_tolerance = 0.05;

/**
 * Closest points of the slave nodes that do not hang, in the order of the
 * slave faces and their nodes, without the nodes beyond the edge of the
 * master side. The faces to be tried come from a tree of boxes that
 * contain them, so none is missed. Where faces are equally close, the one
 * with the lowest index is taken; weights below 1e-12 become 0.
 */
template <int dim>
std::vector<Projection> project(const mesh::Surface<dim>                 &surface,
                                const PairFaces                          &sides,
                                const faces::FaceShape<dim>              &shape,
                                const typename mesh::Surface<dim>::Field &positions);
} // namespace snug::contact

#endif
