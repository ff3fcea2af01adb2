#ifndef snug_geometry_body_geometry_h
#define snug_geometry_body_geometry_h

#include <snug/base/values.h>
#include <snug/geometry/known_surface.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <deal.II/grid/cell_id.h>

#include <map>
#include <memory>
#include <set>
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
  file
};
Names names(Source);

/// Each is half of the one before.
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
  /// per axis: size of the last cell over the size of the first, cells
  /// between in geometric progression; default 1
  std::vector<double> grading;
  /// per axis: half of the cells are equal and fill this much from the
  /// lower end, the rest grow from there [length]; 0: not; default 0
  std::vector<double> fine_length;
  /// face name -> "sphere R" | "sphere R at x, y" | "cylinder x R" |
  /// "cylinder x R at y" | formula of x, y, z giving the outward
  /// displacement of the face [length]. The curved face touches the flat
  /// one at its centre, or at the coordinates given; R > 0 is convex. In 2D
  /// a cylinder's axis is z.
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

  /// @name Mesh files
  /// @{
  std::string              file;    ///< path
  std::vector<std::string> regions; ///< of the file; empty: all
  /// number of a group without a name -> name
  std::map<std::string, std::string> boundary_numbers;
  /// boundary -> "facets" | "smooth"
  std::map<std::string, std::string>  surfaces;
  std::shared_ptr<const ImportedMesh> imported; ///< what is in the file
  /// @}

  /// @name Regions, to which materials may refer
  /// @{
  /// {region, formula of x, y, z}, see with_regions()
  std::vector<std::pair<std::string, std::string>> region_formulas;
  /// cells of a file that are in several groups belong to the one of
  /// these
  std::vector<std::string> named_regions;
  /// @}

  /// @name Placement, in this order
  /// @{
  /// formulas of x, y, z: components of a displacement [length]
  std::vector<std::string> warp;
  double                   scale = 1.;
  /// {axis, degrees}, one after the other about the origin
  std::vector<std::pair<std::string, std::string>> rotate;
  std::vector<double>                              shift; ///< [length]
  /// @}

  /// Boundaries whose true surface contact and supports ask for, and
  /// whether designs may curve those that are flat: not entries.
  std::vector<std::string> sampled_boundaries;
  bool                     is_designed = false;
  /// Whether the true surface is asked for wherever it is curved: not an entry.
  bool samples_all_curved = false;

  unsigned int refinements = 0;
  /// cells are refined where this formula of x, y, z is positive
  std::string  refine_where;
  unsigned int local_refinements = 0;
  /// Cells of all bodies that have children besides, with all their ancestors; null: none.
  /// Not an entry.
  std::shared_ptr<const std::set<dealii::CellId>> refined;

  void declare(Entries &entries);
  /// Give lists that were left empty their defaults.
  void complete(unsigned int dimension);
  /// The mesh can be made of its entries and is not too large; bodies of
  /// revolution have no negative radius.
  void check(const SectionCheck &section, bool axisymmetric) const;
};

/// A point of a body: a cell of its coarse mesh and coordinates in
/// [0,1]^dim in that cell. Points between cells have several.
template <int dim>
struct MeshPoint
{
  unsigned int       cell;
  dealii::Point<dim> unit;
};

/// The centre of a cell in its own coordinates.
template <int dim>
dealii::Point<dim> unit_centre()
{
  dealii::Point<dim> centre;
  for (unsigned int d = 0; d < dim; ++d)
    centre[d] = 0.5;
  return centre;
}

/**
 * The reference geometry of one body: a coarse mesh and the map from its
 * cells to positions, which is evaluated anew on every mesh, so that
 * curved faces stay curved: positions of boundary points lie on the true
 * surface, which meshes only interpolate.
 *
 * Some bodies have a grid: their coarse cells lie in layers along the axes
 * of logical coordinates in [0,1]^dim, and boundary 2d + s is the side s of
 * axis d. Some of these, all but full rings, also have a frame, a map from
 * [0,1]^dim to positions.
 */
template <int dim>
class BodyGeometry
{
public:
  virtual ~BodyGeometry() = default;

  /// Cells with their vertices in deal.II's order; boundary faces get the
  /// index of their name in boundary_names(). Vertices only tell cells
  /// apart; they need not lie at their reference positions.
  struct CoarseMesh
  {
    std::vector<dealii::Point<dim>>        vertices;
    std::vector<std::vector<unsigned int>> cells;
    /// face vertices (in any order) and boundary index
    std::vector<std::pair<std::vector<unsigned int>, unsigned int>> boundary_faces;
  };

  virtual CoarseMesh coarse_mesh() const = 0;

  /// Number of its cells; may be larger than any mesh can be.
  virtual double n_coarse_cells() const = 0;

  virtual const std::vector<std::string> &boundary_names() const = 0;

  /// Names of the regions; at least one. A region may be empty.
  virtual std::vector<std::string> region_names() const { return {"body"}; }

  /// Index of the region of a cell of the coarse mesh.
  virtual unsigned int region(unsigned int /*coarse_cell*/) const { return 0; }

  /// The surfaces of known shape that boundary faces lie on to rounding;
  /// planes are not among them.
  virtual std::vector<KnownSurface<dim>> known_surfaces() const { return {}; }

  /// Index into known_surfaces() for the boundary face @p face of a cell of
  /// the coarse mesh; no_surface: none.
  virtual unsigned int known_surface(unsigned int /*coarse_cell*/, unsigned int /*face*/) const
  {
    return no_surface;
  }

  /// Of an index of boundary_names().
  virtual BoundaryShape boundary_shape(unsigned int /*boundary*/) const { return {}; }

  static constexpr unsigned int no_surface = static_cast<unsigned int>(-1);

  /// Reference position. @throws InputError where a formula is not finite.
  virtual dealii::Point<dim> position(const MeshPoint<dim> &point) const = 0;

  /// The same point has the same coordinates in all its cells, up to
  /// round-off; their order of magnitude is 1.
  virtual dealii::Point<dim> logical(const MeshPoint<dim> &point) const = 0;

  /// Lengths along the logical axes; only their ratios matter.
  virtual dealii::Tensor<1, dim> extent() const = 0;

  /// Bodies of blocks have none, so the partition "auto" leaves them to METIS.
  virtual bool has_grid() const { return false; }

  /**
   * Fraction in [0,1]^dim of the body's frame at @p logical. For face
   * 2d+s, coordinate d is the distance from the opposite side. Only with
   * a frame.
   */
  virtual dealii::Point<dim> box_fraction(const dealii::Point<dim> &logical) const;

  /// The point at @p fraction of the frame, faces not yet curved. Only
  /// with a frame.
  virtual dealii::Point<dim> box_position(const dealii::Point<dim> &fraction) const;
};

/// The geometry of a body, placed and with the regions its parameters say.
/// @throws InputError naming the entry.
template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_geometry(const BodyMeshParameters &parameters);

/// Index of @p name in the boundary names. @throws InputError listing them.
template <int dim>
unsigned int boundary_index(const BodyGeometry<dim> &geometry, const std::string &name);
} // namespace snug::geometry

#endif
