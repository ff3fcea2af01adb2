#ifndef snug_mesh_triangulate_h
#define snug_mesh_triangulate_h

#include <snug/geometry/coarse_cells.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/tria_description.h>

#include <map>

namespace snug::mesh {
template <int dim>
using Geometries = std::vector<std::unique_ptr<geometry::BodyGeometry<dim>>>;

/// The coarse meshes of all bodies side by side, which every rank has. Bodies share no vertices,
/// even where they touch.
template <int dim>
struct CoarseMesh
{
  /// @p geometries must outlive it.
  explicit CoarseMesh(const Geometries<dim> &geometries);

  const Geometries<dim>             &geometries;
  std::vector<dealii::Point<dim>>    vertices;
  std::vector<dealii::CellData<dim>> cells;      ///< body after body; material id: body
  std::vector<unsigned int>          first_cell; ///< of the bodies, and the end
  geometry::CoarseCells<dim>         places;     ///< of the cells in their bodies
  /// index of the body's names, of boundary faces by their vertices in ascending order
  std::map<std::vector<unsigned int>, unsigned int> boundary;
};

/// Whether any cell of the coarse mesh may have children.
bool are_refined(const std::vector<geometry::BodyMeshParameters> &bodies);

/// The coarse mesh with its boundary ids.
template <int dim>
void create_triangulation(const CoarseMesh<dim>                             &coarse,
                          dealii::parallel::distributed::Triangulation<dim> &triangulation);

/// Ids of cells by the places of their coarse cells in the coarse mesh, which the ids of a forest
/// do not tell: p4est has its trees in an order of its own.
template <int dim>
class PlacedIds
{
public:
  explicit PlacedIds(const dealii::parallel::distributed::Triangulation<dim> &forest);

  dealii::CellId of(const dealii::CellId &in_forest) const;

private:
  std::vector<unsigned int> place; ///< of trees
};

/// Refine every body as its parameters say. Collective.
/// @throws InputError for a formula that cannot be read.
template <int dim>
void refine(const std::vector<geometry::BodyMeshParameters>   &bodies,
            const CoarseMesh<dim>                             &coarse,
            dealii::parallel::distributed::Triangulation<dim> &triangulation);
} // namespace snug::mesh

#endif
