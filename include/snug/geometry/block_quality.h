#ifndef snug_geometry_block_quality_h
#define snug_geometry_block_quality_h

#include <snug/geometry/block_mesh.h>

namespace snug::geometry {
/**
 * Return the minimum scaled Jacobian of the quadratic tensor-product interpolation of a block over
 * its 3^dim points. The scaled Jacobian is det J over the product of the lengths of the columns of
 * J. The result is 1 for a box and negative for an inverted block. Edges and faces lie on
 * @p pieces; edges and faces without a piece are interpolated from their vertices and edges.
 */
template <int dim>
double least_scaled_jacobian(
  const std::vector<dealii::Point<dim>>                                         &vertices,
  const std::vector<unsigned int>                                               &block,
  const std::map<typename BlockMesh<dim>::Face, typename BlockMesh<dim>::Piece> &pieces);

/// Return the edges and, in 3D, the faces of a block, with vertices in ascending order.
template <int dim>
std::vector<std::vector<unsigned int>> edges_and_faces(const std::vector<unsigned int> &block);
} // namespace snug::geometry

#endif
