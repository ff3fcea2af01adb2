#ifndef snug_mesh_file_curved_blocks_h
#define snug_mesh_file_curved_blocks_h

#include <snug/geometry/block_mesh.h>
#include <snug/mesh_file/curved_boundary.h>
#include <snug/mesh_file/element_split.h>

namespace snug::mesh_file {
/// The cells of a body, and the split of the cells; null: not split.
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
 * Make edges and faces of the blocks of @p mesh pieces of the true surface, and move the middles of
 * split elements to the true surface. The interior middles of quadratic elements are moved as well.
 * The parts of a split triangle are bilinear in the coordinates of the triangle.
 *
 * Where the scaled Jacobian of a block is below 0.2 of its value with straight edges, the curves
 * and patches of the block are moved halfway towards the straight ones, repeatedly. @p warnings
 * gets a line with their number and the maximum distance from the true surface.
 */
template <int dim>
void curve_blocks(geometry::BlockMesh<dim> &mesh,
                  const SplitCells         &cells,
                  const BodySurface<dim>   &surface,
                  const SurfaceShapes<dim> &shapes,
                  std::vector<std::string> &warnings);
} // namespace snug::mesh_file

#endif
