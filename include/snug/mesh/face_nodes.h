#ifndef snug_mesh_face_nodes_h
#define snug_mesh_face_nodes_h

#include <deal.II/base/point.h>

#include <vector>

namespace snug::mesh {
/**
 * Nodes of face 2d + s (deal.II's numbering: the side s of axis d) of a
 * cell with tensor-product ordered @p cell_nodes, first tangent fastest,
 * oriented such that t1 x t2 (3D), or (t_y, -t_x) (2D), points out.
 */
template <int dim>
std::vector<unsigned int> oriented_face_nodes(const std::vector<unsigned int> &cell_nodes,
                                              unsigned int                     degree,
                                              unsigned int                     face);

/// In the reference cube [0,1]^dim, the point of that face with coordinates @p xi in [0,1]^(dim-1)
/// along the tangents of its oriented nodes.
template <int dim>
dealii::Point<dim> point_on_face(unsigned int face, const dealii::Point<dim - 1> &xi);
} // namespace snug::mesh

#endif
