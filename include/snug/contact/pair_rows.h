#ifndef snug_contact_pair_rows_h
#define snug_contact_pair_rows_h

#include <snug/contact/pair_geometry.h>
#include <snug/contact/row_group.h>

#include <memory>

namespace snug::contact {
/**
 * Return the rows of nodal (node to face) contact of one pair. The row of slave node s with the
 * weights w_k of its Projection to a master face is
 *   c_s = n,  c_k = -w_k n,  gap = n . (x_m - x_s) + softening,  n = -v/|v|
 * with the softening of the Projection and its vector v (PairNormals). x_m is the point of the true
 * surface of the face over its point sum_k w_k x_k. Hanging master nodes are replaced
 * by their masters. Faces stay; weights (NormalProjection), normals and gaps follow the positions.
 * Slave nodes that hang carry no row. Slave nodes carry no row either if their closest point lies
 * beyond the edge of the master side (edge_tolerance), is out of reach or does not face them
 * (SearchCriteria).
 */
template <int dim>
std::unique_ptr<RowGroup<dim>> nodal_rows(const PairGeometry<dim> &pair);

/**
 * Return the rows of slave nodes against a rigid obstacle. With the distance d(x) to the obstacle
 * as it is placed, the row of slave node s is
 *   c_s = n = -grad d(x_s),  gap = d(x_s) + n . w,
 * where w is the displacement of the obstacle. Normal and gap follow the slave node: n' = -H V_s
 * with the Hessian H of d, d' = -n . V_s. Slave nodes that hang, are out of reach or do not face
 * the obstacle (SearchCriteria) carry no row.
 */
template <int dim>
std::unique_ptr<RowGroup<dim>> obstacle_rows(const PairGeometry<dim> &pair);
} // namespace snug::contact

#endif
