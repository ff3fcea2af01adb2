#ifndef snug_mesh_file_curved_blocks_h
#define snug_mesh_file_curved_blocks_h

#include <snug/geometry/block_mesh.h>
#include <snug/mesh_file/curved_boundary.h>
#include <snug/mesh_file/element_split.h>

namespace snug::mesh_file {
/// The cells of a body, and how they were split; null: not.
struct SplitCells
{
  const std::vector<MeshFile::Element> &cells;
  ElementSplit                         *split;

  std::vector<std::vector<unsigned int>> parts(const MeshFile::Element &element) const
  {
    if (split != nullptr)
      return split->parts(element);
    return {cell_vertices(element)};
  }
};

/**
 * Make edges and faces of the blocks of @p mesh pieces of the true surface, and put the middles of
 * split elements among its vertices onto it. Quadratic elements have their own middles inside as
 * well. Facets of a triangle that was split are bilinear in its coordinates.
 *
 * Where the scaled Jacobian of a block falls below 0.2 of what it was, its curves and patches are
 * brought halfway back to the straight ones, repeatedly; @p notes say so.
 */
template <int dim>
void curve_blocks(geometry::BlockMesh<dim> &mesh,
                  const SplitCells         &cells,
                  const BodySurface<dim>   &surface,
                  const SurfaceShapes<dim> &shapes,
                  std::vector<std::string> &notes);
} // namespace snug::mesh_file

#endif
