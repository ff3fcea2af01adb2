#ifndef snug_mesh_triangulate_h
#define snug_mesh_triangulate_h

#include <snug/geometry/coarse_cells.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/tria_description.h>

#include <map>

namespace snug::mesh {
template <int dim>
using Geometries = std::vector<std::unique_ptr<geometry::BodyGeometry<dim>>>;

/// The joint coarse mesh of all bodies, which every rank holds completely. Bodies share no
/// vertices, even where bodies touch.
template <int dim>
struct CoarseMesh
{
  /// Join the coarse meshes of the bodies. @p geometries must outlive this object.
  explicit CoarseMesh(const Geometries<dim> &geometries);

  const Geometries<dim>             &geometries;
  std::vector<dealii::Point<dim>>    vertices;
  std::vector<dealii::CellData<dim>> cells;      ///< body after body; the material id is the body
  std::vector<unsigned int>          first_cell; ///< of each body, then the number of cells
  geometry::CoarseCells<dim>         places;     ///< of the cells in their bodies
  /// index among the boundary names of the body, by the vertices of a face in ascending order
  std::map<std::vector<unsigned int>, unsigned int> boundary;
};

/// Return whether any cell of the coarse mesh may have children.
bool are_refined(const std::vector<geometry::BodyMeshParameters> &bodies);

/// Create a triangulation from the coarse mesh and set the boundary ids.
template <int dim>
void create_triangulation(const CoarseMesh<dim>                             &coarse,
                          dealii::parallel::distributed::Triangulation<dim> &triangulation);

/// This class converts cell ids of a forest to ids whose coarse cell is the position in the coarse
/// mesh. The ids of a forest do not contain this position, because p4est reorders the trees.
template <int dim>
class PlacedIds
{
public:
  explicit PlacedIds(const dealii::parallel::distributed::Triangulation<dim> &forest);

  dealii::CellId of(const dealii::CellId &in_forest) const;

private:
  std::vector<unsigned int> place; ///< position of each tree in the coarse mesh
};

/// Refine every body according to its parameters. Collective.
/// @throws InputError for a formula that cannot be read.
template <int dim>
void refine(const std::vector<geometry::BodyMeshParameters>   &bodies,
            const CoarseMesh<dim>                             &coarse,
            dealii::parallel::distributed::Triangulation<dim> &triangulation);
} // namespace snug::mesh

#endif
