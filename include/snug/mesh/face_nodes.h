#ifndef snug_mesh_face_nodes_h
#define snug_mesh_face_nodes_h

#include <deal.II/base/point.h>

#include <vector>

namespace snug::mesh {
/**
 * Return the nodes of face 2d + s (deal.II's numbering: the side s of axis d) of a
 * cell with tensor-product ordered @p cell_nodes. The nodes are ordered with the first tangent
 * fastest, and oriented such that t1 x t2 (3D), or (t_y, -t_x) (2D), points out.
 */
template <int dim>
std::vector<unsigned int> oriented_face_nodes(const std::vector<unsigned int> &cell_nodes,
                                              unsigned int                     degree,
                                              unsigned int                     face);

/// Return the point of a face of the reference cube [0,1]^dim with coordinates @p xi in
/// [0,1]^(dim-1) along the tangents of oriented_face_nodes().
template <int dim>
dealii::Point<dim> point_on_face(unsigned int face, const dealii::Point<dim - 1> &xi);
} // namespace snug::mesh

#endif
