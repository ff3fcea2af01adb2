#ifndef snug_mesh_forest_h
#define snug_mesh_forest_h

#include <snug/geometry/coarse_cells.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/tria_description.h>

#include <functional>
#include <map>
#include <memory>
#include <set>

namespace snug::mesh {
template <int dim>
using Geometries = std::vector<std::shared_ptr<const geometry::BodyGeometry<dim>>>;

/// The joint coarse mesh of all bodies. Bodies share no vertices, even where bodies touch.
template <int dim>
struct CoarseMesh
{
  /// Join the coarse meshes of the bodies. @p geometries must outlive this object.
  explicit CoarseMesh(const Geometries<dim> &geometries);

  const Geometries<dim>             &geometries;
  std::vector<dealii::Point<dim>>    vertices;
  std::vector<dealii::CellData<dim>> cells;      ///< body after body; the material id is the body
  std::vector<unsigned int>          first_cell; ///< of each body, then the number of cells
  geometry::CoarseCells<dim>         places;     ///< index of each coarse cell in its body
  /// index among the boundary names of the body, by the vertices of a face in ascending order
  std::map<std::vector<unsigned int>, unsigned int> boundary;
};

/**
 * The coarse cells of all bodies and the cells into which they are refined. Meshes are made from a
 * forest (BodyMesh). A forest can be refined further, so that the mesh of an adaptive step is made
 * from the forest of the step before. Some bodies may have their cells on rank 0 alone, until
 * a cell is refined: p4est needs the coarse mesh on every rank.
 */
template <int dim>
class Forest
{
public:
  using Triangulation = dealii::parallel::distributed::Triangulation<dim>;

  /// Make the geometries and refine every body according to its parameters. Collective.
  /// @throws InputError for bad mesh entries.
  Forest(MPI_Comm communicator, const std::vector<geometry::BodyMeshParameters> &bodies);

  /// Refine until every cell of @p cells has children. @p cells must hold all ancestors of its
  /// cells. Further cells are refined where levels of neighbours would differ by more than one.
  /// Refinements in several steps give the same cells as one refinement by the union of the sets.
  /// Collective.
  void refine(const std::set<dealii::CellId> &cells);

  MPI_Comm                                         communicator() const { return comm; }
  const std::vector<geometry::BodyMeshParameters> &bodies() const { return parameters; }
  /// Return the geometries of the bodies, which the meshes of a forest share.
  std::shared_ptr<const Geometries<dim>> geometries() const { return shapes; }

  /// Return whether the coarse cells of all bodies are grids.
  bool are_grids() const;

  /// Return the index of each coarse cell in its body.
  const geometry::CoarseCells<dim> &places() const { return cell_places; }

  /// Return the bodies whose cells only rank 0 has.
  const std::vector<unsigned int> &bodies_of_rank_0() const { return lacking; }

  /// Return the coarse mesh, which is made when it is asked for: grids without refinement do
  /// without it. The bodies must have all cells on this rank.
  const CoarseMesh<dim> &coarse() const;

  /// Return the triangulation of p4est, or null as long as no cell has been refined. Its coarse
  /// cells are numbered by p4est, see PlacedIds.
  const Triangulation *triangulation() const { return refined.get(); }

private:
  MPI_Comm                                  comm;
  std::vector<geometry::BodyMeshParameters> parameters;
  std::shared_ptr<const Geometries<dim>>    shapes;
  std::vector<unsigned int>                 lacking; ///< bodies whose cells only rank 0 has
  geometry::CoarseCells<dim>                cell_places;
  mutable std::unique_ptr<CoarseMesh<dim>>  coarse_mesh;
  std::unique_ptr<Triangulation>            refined;

  /// Return whether a cell is wanted to be refined, given its body, its id and its level.
  using Wanted = std::function<bool(unsigned int, const dealii::CellId &, unsigned int)>;

  void make_geometries();
  void create_triangulation();
  bool refine_step(const Wanted &wanted);
};

/// This class converts cell ids of a forest to ids whose coarse cell is the position in the coarse
/// mesh. The ids of a forest do not contain this position, because p4est reorders the trees.
template <int dim>
class PlacedIds
{
public:
  explicit PlacedIds(const typename Forest<dim>::Triangulation &triangulation);

  dealii::CellId of(const dealii::CellId &in_forest) const;

private:
  std::vector<unsigned int> place; ///< position of each tree in the coarse mesh
};
} // namespace snug::mesh

#endif
