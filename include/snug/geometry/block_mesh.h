#ifndef snug_geometry_block_mesh_h
#define snug_geometry_block_mesh_h

#include <snug/geometry/patch.h>

#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dealii {
template <int dim, int spacedim>
class Manifold;
}

namespace snug::geometry {
/**
 * Quadrilaterals or hexahedra with straight or curved edges and faces, the
 * blocks, each divided into a grid of coarse cells.
 */
template <int dim>
struct BlockMesh
{
  using Surface = std::shared_ptr<const dealii::Manifold<dim, dim>>;

  /// A boundary face of a block: vertices in ascending order.
  using Face = std::vector<unsigned int>;

  /// A part of a patch, by the coordinates of vertices in ascending order.
  struct Piece
  {
    std::shared_ptr<Patch<dim>>   patch;
    std::vector<dealii::Point<2>> at;
  };

  std::vector<dealii::Point<dim>>        vertices;
  std::vector<std::vector<unsigned int>> blocks;  ///< deal.II vertex order
  std::vector<unsigned int>              regions; ///< per block
  std::map<Face, unsigned int>           boundaries;
  std::vector<std::string>               boundary_names, region_names;
  /// boundaries that are curved, and what they lie on
  std::map<unsigned int, Surface> surfaces;
  /// edges, and in 3D boundary faces, that are curved by themselves. Those of a face lie on it.
  std::map<Face, Piece> pieces;
  /// shapes of boundary faces that lie on one of them to rounding
  std::vector<KnownSurface<dim>> known_surfaces;
  std::map<Face, unsigned int>   known; ///< indices into these
  /// of boundaries that are not plane
  std::map<unsigned int, BoundaryShape> shapes;
  /// coordinates in which the inside of all blocks is straight; null:
  /// Cartesian ones, blended between the faces
  Surface inside;
  /// coarse cells along the axes of every block
  std::array<unsigned int, dim> cells;
};

/// Add the mirror image at the plane x_axis = 0, where the boundary
/// called @p name goes if it does not lie within it.
template <int dim>
void mirror(BlockMesh<dim> &mesh, unsigned int axis, const std::string &name);

/// All faces of the boundary @p index lie on @p surface.
template <int dim>
void set_known(BlockMesh<dim> &mesh, unsigned int index, const KnownSurface<dim> &surface);

/// Remove boundaries without faces.
template <int dim>
void remove_unused_boundaries(BlockMesh<dim> &mesh);

/**
 * Order the vertices of the blocks, which stay right-handed, such that all
 * blocks give the edges they share the same direction, as deal.II needs in
 * 2D and p4est in 3D. Axes may change places, so in 3D all axes must have
 * equally many cells.
 * @return whether there is such an order, which is always so in 2D;
 *   without, nothing is changed.
 */
template <int dim>
bool order_consistently(BlockMesh<dim> &mesh);

/// The same for the bottoms of blocks whose last axis goes from one surface
/// to another.
void order_layer_consistently(BlockMesh<3> &mesh);
} // namespace snug::geometry

#endif
