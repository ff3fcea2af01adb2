#ifndef snug_geometry_body_geometry_h
#define snug_geometry_body_geometry_h

#include <snug/base/values.h>
#include <snug/geometry/cell_grid.h>
#include <snug/geometry/known_surface.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>


#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::geometry {
struct ImportedMesh;

enum class Source
{
  box,
  ring,
  disc,
  cylinder,
  sphere,
  shell,
  file,
  cad
};
Names names(Source);

/// Parts of a round body. Each part is half of the part before.
enum class Part
{
  full,
  half,
  quarter,
  eighth
};
inline Names names(Part)
{
  return {{"full"}, {"half"}, {"quarter"}, {"eighth"}};
}

/**
 * Mesh entries of `subsection Body NAME`. Faces of a box are called left,
 * right (x-, x+), front, back (y-, y+), bottom, top (z-, z+); in 2D left,
 * right (x-, x+), bottom, top (y-, y+).
 */
struct BodyMeshParameters
{
  Source                    source = Source::box;
  std::vector<double>       corner; ///< [length], default 0
  std::vector<double>       size;   ///< [length], default 1
  std::vector<unsigned int> cells;  ///< per axis
  /// per axis: size of the last cell over the size of the first cell, with sizes
  /// in geometric progression; default 1
  std::vector<double> grading;
  /// per axis: length from the lower end that half of the cells, with equal sizes, fill; the sizes
  /// of the other cells grow from there [length]; 0: no fine part; default 0
  std::vector<double> fine_length;
  /// face name -> "sphere R" | "sphere R at x, y" | "cylinder x R" |
  /// "cylinder x R at y" | formula of x, y, z giving the outward
  /// displacement of the face [length]. The curved face touches the flat
  /// face at the centre of the face, or at the given coordinates. R > 0 is convex. In 2D
  /// the axis of a cylinder is z.
  std::map<std::string, std::string> curved_faces;

  /// @name Round bodies
  /// @{
  double radius       = 1.;  ///< outer [length]
  double inner_radius = 0.5; ///< of rings and shells [length]
  double length       = 1.;  ///< of cylinders and rings [length]
  Part   part         = Part::full;
  /// ring: around, across, along; cylinder: across, along; shell: around,
  /// across; disc, sphere: across
  std::vector<unsigned int> round_cells;
  /// @}

  /// @name Mesh files and CAD files
  /// @{
  std::string              file;    ///< path
  std::vector<std::string> regions; ///< regions of the file in the body; empty: all
  /// sets of faces or nodes that are boundaries; empty: all sets of faces
  std::vector<std::string> boundary_sets;
  /// number of a group without a name -> name
  std::map<std::string, std::string> boundary_numbers;
  /// boundary -> "facets" | "smooth"
  std::map<std::string, std::string>  surfaces;
  std::shared_ptr<const ImportedMesh> imported; ///< contents of the file
  unsigned int solid = 0; ///< number of the solid of a CAD file, from 1; 0: the only one
  /// boundary -> faces of a CAD file, "3 + 4 + chain 7"
  std::map<std::string, std::string> cad_faces;
  double                             element_size = 0.; ///< of the mesh of a CAD file [length]
  std::map<std::string, double>      face_sizes;        ///< boundary -> element size [length]
  double                             size_growth = 0.3; ///< of element sizes per distance
  /// Refinements of the mesh of a CAD file, one after the other: places in the coordinates of the
  /// file at which the element size is halved. Without places, it is halved everywhere. Not an
  /// entry.
  std::vector<std::vector<dealii::Point<3>>> halved;
  /// @}

  /// @name Regions, to which materials may refer, and parts of boundaries
  /// @{
  /// {region, formula of x, y, z}, see with_regions()
  std::vector<std::pair<std::string, std::string>> region_formulas;
  /// {boundary, "boundary & formula of x, y, z"}, see with_boundary_formulas()
  std::vector<std::pair<std::string, std::string>> boundary_formulas;
  /// groups of a file that are regions; a cell in several groups belongs to the group in this
  /// list
  std::vector<std::string> named_regions;
  /// @}

  /// @name Placement, in this order
  /// @{
  /// components of a displacement as formulas of x, y, z [length]
  std::vector<std::string> warp;
  double                   scale = 1.;
  /// rotations {axis, degrees} about the origin, one after the other
  std::vector<std::pair<std::string, std::string>> rotate;
  std::vector<double>                              shift; ///< [length]
  /// @}

  /// Boundaries whose true surface contact and supports need, and
  /// whether designs may curve flat boundaries. These members are not entries.
  std::vector<std::string> sampled_boundaries;
  bool                     is_designed = false;
  /// If true, all curved boundary faces get samples of the true surface; not an entry.
  bool samples_all_curved = false;

  unsigned int refinements = 0;
  /// formula of x, y, z; cells are refined where the formula is positive
  std::string  refine_where;
  unsigned int local_refinements = 0;

  void declare(Entries &entries);
  /// Set empty lists to their defaults.
  void complete(unsigned int dimension);
  /// Check that the mesh can be made from the entries and is not too large, and that bodies of
  /// revolution have no negative radius. @throws InputError naming the entry.
  void check(const SectionCheck &section, bool axisymmetric, unsigned int n_ranks) const;
};

/// A point of a body, given by a cell of the coarse mesh and coordinates in
/// [0,1]^dim in this cell. A point between cells has several such representations.
template <int dim>
struct MeshPoint
{
  unsigned int       cell;
  dealii::Point<dim> unit;
};

constexpr unsigned int no_element = static_cast<unsigned int>(-1);

/**
 * The place of a cell in the element of a mesh file of which the cell is a part. Elements are split
 * into one cell at each corner: vertex 0 of the cell is the corner, axis d of the cell leads to the
 * middle of the edge towards the corner towards[d], and the last vertex is the middle of the
 * element. Elements number their corners around the bottom, then around the top.
 */
template <int dim>
struct ElementPart
{
  unsigned int                   element   = no_element; ///< index in the body
  unsigned char                  n_corners = 0;          ///< of the element
  unsigned char                  corner    = 0;
  std::array<unsigned char, dim> towards   = {};

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & element & n_corners & corner & towards;
  }

  /// Return whether the element is a triangle, a tetrahedron or a prism.
  bool has_triangles() const { return element != no_element && n_corners != 1u << dim; }
};

/// Return the centre of a cell in the coordinates of the cell.
template <int dim>
dealii::Point<dim> unit_centre()
{
  dealii::Point<dim> centre;
  for (unsigned int d = 0; d < dim; ++d)
    centre[d] = 0.5;
  return centre;
}

/**
 * The reference geometry of one body: a coarse mesh and the map from the
 * cells to positions. Every mesh evaluates the map itself, so that
 * curved faces stay curved: positions of boundary points lie on the true
 * surface, which meshes only interpolate.
 *
 * Some bodies have a grid: the coarse cells lie in layers along the axes
 * of logical coordinates in [0,1]^dim, and boundary 2d + s is the side s of
 * axis d. All bodies with a grid except full rings also have a frame, a map from
 * [0,1]^dim to positions.
 */
template <int dim>
class BodyGeometry
{
public:
  virtual ~BodyGeometry() = default;

  /// Cells with vertices in deal.II's order. The index of a boundary face is the
  /// index of the boundary in boundary_names(). Vertices only identify cells and
  /// need not lie at their reference positions.
  struct CoarseMesh
  {
    std::vector<dealii::Point<dim>>        vertices;
    std::vector<std::vector<unsigned int>> cells;
    /// face vertices (in any order) and boundary index
    std::vector<std::pair<std::vector<unsigned int>, unsigned int>> boundary_faces;
  };

  /// Return the coarse mesh. The geometry must have all cells.
  virtual CoarseMesh coarse_mesh() const = 0;

  /// Return whether all coarse cells are on this rank. If not, functions of a cell must only be
  /// called for cells on this rank. All other functions return the values of the whole mesh.
  virtual bool has_all_cells() const { return true; }

  /// Return the number of coarse cells, on all ranks. The number may exceed the number of cells of
  /// any mesh.
  virtual double n_coarse_cells() const = 0;

  virtual const std::vector<std::string> &boundary_names() const = 0;

  /// Return the names of the regions, at least one. A region may be empty.
  virtual std::vector<std::string> region_names() const { return {"body"}; }

  /// Return the index of the region of a cell of the coarse mesh.
  virtual unsigned int region(unsigned int /*coarse_cell*/) const { return 0; }

  /// Return the part of an element of a mesh file that a cell of the coarse mesh is. Return
  /// no_element for cells that no element was split into.
  virtual ElementPart<dim> element_part(unsigned int /*coarse_cell*/) const { return {}; }

  /// Return the surfaces of known shape on which boundary faces lie up to round-off, without
  /// planes.
  virtual std::vector<KnownSurface<dim>> known_surfaces() const { return {}; }

  /// Return the index into known_surfaces() for the boundary face @p face of a cell of
  /// the coarse mesh, or no_surface.
  virtual unsigned int known_surface(unsigned int /*coarse_cell*/, unsigned int /*face*/) const
  {
    return no_surface;
  }

  /// Return the shape of a boundary, given by the index in boundary_names().
  virtual BoundaryShape boundary_shape(unsigned int /*boundary*/) const { return {}; }

  static constexpr unsigned int no_surface = static_cast<unsigned int>(-1);

  /// Return the reference position. @throws InputError if a formula is not finite.
  virtual dealii::Point<dim> position(const MeshPoint<dim> &point) const = 0;

  /// Return the logical coordinates. A point has the same logical coordinates in all its cells, up
  /// to round-off. The order of magnitude of the coordinates is 1.
  virtual dealii::Point<dim> logical(const MeshPoint<dim> &point) const = 0;

  /// Return the lengths along the logical axes. Only the ratios of the lengths are used.
  virtual dealii::Tensor<1, dim> extent() const = 0;

  /// Return the grid of the coarse cells, or null for bodies without a grid, such as bodies of
  /// blocks.
  virtual const CellGrid<dim> *grid() const { return nullptr; }

  /// Return the boundary of the face @p face of a coarse cell on the side @p face of the grid. The
  /// body must have a grid.
  virtual unsigned int side_boundary(unsigned int /*coarse_cell*/, unsigned int face) const
  {
    return face;
  }

  /// Return whether a boundary is a whole side of a box.
  virtual bool is_box_side(unsigned int /*boundary*/) const { return false; }

  /**
   * Return the coordinates in [0,1]^dim of the frame of the body at @p logical. Coordinate d is 0
   * at boundary 2d and 1 at boundary 2d + 1. The body must have
   * a frame.
   */
  virtual dealii::Point<dim> box_fraction(const dealii::Point<dim> &logical) const;

  /// Return the point at the coordinates @p fraction of the frame, before faces are curved. The
  /// body must have a frame.
  virtual dealii::Point<dim> box_position(const dealii::Point<dim> &fraction) const;
};

/// Return the geometry of a body with the placement, regions and boundaries of the parameters.
/// @throws InputError naming the entry.
template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_geometry(const BodyMeshParameters &parameters);

/// Return the index of @p name in the boundary names. @throws InputError listing the names.
template <int dim>
unsigned int boundary_index(const BodyGeometry<dim> &geometry, const std::string &name);
} // namespace snug::geometry

#endif
