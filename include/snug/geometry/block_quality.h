#ifndef snug_geometry_block_quality_h
#define snug_geometry_block_quality_h

#include <snug/geometry/block_mesh.h>

namespace snug::geometry {
/**
 * Least scaled Jacobian, det J over the lengths of its columns, of the triquadratic interpolation
 * of a block at its 3^dim points: 1 for a box, negative if it is inverted. Edges and faces lie on
 * @p pieces, or else between their vertices and edges.
 */
template <int dim>
double least_scaled_jacobian(
  const std::vector<dealii::Point<dim>>                                         &vertices,
  const std::vector<unsigned int>                                               &block,
  const std::map<typename BlockMesh<dim>::Face, typename BlockMesh<dim>::Piece> &pieces);

/// Edges and, in 3D, faces of a block, vertices in ascending order.
template <int dim>
std::vector<std::vector<unsigned int>> edges_and_faces(const std::vector<unsigned int> &block);
} // namespace snug::geometry

#endif
