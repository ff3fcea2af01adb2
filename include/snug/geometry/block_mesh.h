#ifndef snug_geometry_block_mesh_h
#define snug_geometry_block_mesh_h

#include <snug/geometry/body_geometry.h>
#include <snug/geometry/patch.h>

#include <deal.II/base/point.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/shared_ptr.hpp>
#include <boost/serialization/vector.hpp>

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
 * A mesh of blocks, which are quadrilaterals or hexahedra with straight or curved edges and faces.
 * Each block is divided into a grid of coarse cells.
 */
template <int dim>
struct BlockMesh
{
  using Surface = std::shared_ptr<const dealii::Manifold<dim, dim>>;

  /// A boundary face of a block: vertices in ascending order.
  using Face = std::vector<unsigned int>;

  /// A part of a patch. The coordinates in the patch are those of the vertices in ascending order.
  struct Piece
  {
    std::shared_ptr<Patch<dim>>   patch;
    std::vector<dealii::Point<2>> at;

    template <class Archive>
    void serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive.template register_type<KnownSurface<dim>>();
      archive.template register_type<PartProjection<dim>>();
      archive.template register_type<Curve<dim>>();
      if constexpr (dim == 3)
        archive.template register_type<FacetPatch>();
      archive & patch & at;
    }
  };

  /// The place of an excerpt in the mesh, see excerpt().
  struct Excerpt
  {
    std::vector<unsigned int> numbers;      ///< of the blocks of the excerpt in the mesh, ascending
    unsigned int              n_blocks = 0; ///< of the mesh
    std::array<dealii::Point<dim>, 2> bounds; ///< of the vertices of the mesh

    template <class Archive>
    void serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive & numbers & n_blocks & bounds;
    }
  };

  std::vector<dealii::Point<dim>>        vertices;
  std::vector<std::vector<unsigned int>> blocks;  ///< deal.II vertex order
  std::vector<unsigned int>              regions; ///< per block
  std::vector<ElementPart<dim>>          parts;   ///< per block; empty if no element was split
  std::map<Face, unsigned int>           boundaries;
  std::vector<std::string>               boundary_names, region_names;
  /// curved boundaries, and the surfaces on which the boundaries lie
  std::map<unsigned int, Surface> surfaces;
  /// edges, and in 3D boundary faces, with patches of their own; the edges of a face lie on the
  /// patch of the face
  std::map<Face, Piece> pieces;
  /// curves and surfaces of the CAD part, in the order of their numbers
  std::vector<std::shared_ptr<PartProjection<dim>>> projections;
  /// surfaces of known shape on which some boundary faces lie up to round-off
  std::vector<KnownSurface<dim>> known_surfaces;
  std::map<Face, unsigned int>   known; ///< indices into known_surfaces
  /// shapes of boundaries that are not plane
  std::map<unsigned int, BoundaryShape> shapes;
  /// coordinates in which the interior of all blocks is straight; null means
  /// Cartesian coordinates with blending between the faces
  Surface inside;
  /// numbers of coarse cells along the axes of every block
  std::array<unsigned int, dim> cells;
  /// Only of an excerpt, which has no boundaries. The vertices have other numbers than in the mesh,
  /// but the same order.
  Excerpt place;

  bool is_excerpt() const { return place.n_blocks > 0; }

  /// Send a mesh without manifolds, that is any mesh but those of round bodies. The projections
  /// come without their shapes, see ImportedMesh::with_blocks().
  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & vertices & blocks & regions & parts & boundaries & boundary_names & region_names;
    archive & projections & pieces & known_surfaces & known & shapes & cells & place;
  }
};

/// Return the @p blocks of a mesh, in ascending order, with all that positions in them depend on.
/// The excerpt without blocks has the names and the bounds of the mesh.
template <int dim>
BlockMesh<dim> excerpt(const BlockMesh<dim> &mesh, const std::vector<unsigned int> &blocks);

/// Return the lower and the upper bounds of the vertices of the whole mesh.
template <int dim>
std::array<dealii::Point<dim>, 2> bounds_of(const BlockMesh<dim> &mesh);

/// Add the mirror image of the mesh at the plane x_axis = 0. The boundary faces called @p name lie
/// in this plane and are removed, because they are interior faces of the result.
template <int dim>
void mirror(BlockMesh<dim> &mesh, unsigned int axis, const std::string &name);

/// Set @p surface as the known surface of all faces of the boundary @p index.
template <int dim>
void set_known(BlockMesh<dim> &mesh, unsigned int index, const KnownSurface<dim> &surface);

/// Remove boundaries without faces.
template <int dim>
void remove_unused_boundaries(BlockMesh<dim> &mesh);

/**
 * Order the vertices of the blocks such that all blocks give a shared edge the same direction, as
 * deal.II requires in 2D and p4est in 3D. Blocks stay right-handed. The order may exchange the
 * axes of a block, so all axes must have the same number of cells in 3D.
 * @return whether such an order exists. In 2D it always exists. Without such an order, the mesh
 *   is not changed.
 */
template <int dim>
bool order_consistently(BlockMesh<dim> &mesh);

/// Order the bottoms of blocks in the same way. The last axis of the blocks goes from one surface
/// to another and stays the last axis.
void order_layer_consistently(BlockMesh<3> &mesh);
} // namespace snug::geometry

#endif
