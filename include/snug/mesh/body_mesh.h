#ifndef snug_mesh_body_mesh_h
#define snug_mesh_body_mesh_h

#include <snug/mesh/forest.h>
#include <snug/mesh/idealization.h>
#include <snug/mesh/interior_faces.h>
#include <snug/mesh/partition.h>
#include <snug/mesh/tetrahedron.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/tensor.h>

#include <mpi.h>

#include <memory>
#include <optional>
#include <vector>

namespace snug::mesh {
/// A vector at each local node of a mesh, or at each of its points.
template <int dim>
using Field = std::vector<dealii::Tensor<1, dim>>;

/**
 * The mesh of all bodies on this rank. This class holds the nodes of one triangulation (scalar
 * degrees of freedom of FE_Q(degree); displacement component c of node a is
 * unknown dim*a + c) and plain arrays on which the other modules work.
 *
 * Local node indices run over the locally relevant nodes. The cells are the
 * locally owned cells. The (degree+1)^dim nodes of a cell are in tensor-product order, the
 * first coordinate fastest.
 *
 * The samples are numbered behind the nodes. Samples are points of the true surface of boundary
 * faces of this rank, (surface_degree+1)^(dim-1) per face in tensor order. A face of a sampled
 * boundary has samples unless the face is flat and designs do not curve it. With
 * samples_all_curved, all other curved faces have samples as well. Positions, velocities and
 * gradients have values at nodes and samples, displacements have values at nodes.
 */
template <int dim>
class BodyMesh
{
public:
  using Field = mesh::Field<dim>;

  struct Cell
  {
    unsigned int              body;
    unsigned int              part;   ///< all cells of a part are on the same rank
    unsigned int              region; ///< index among the regions of the body
    std::vector<unsigned int> nodes;  ///< local node indices
  };

  /**
   * A boundary face of an owned cell. The nodes of the face, first tangent fastest,
   * are oriented such that t1 x t2 (3D), or (t_y, -t_x) (2D), points out
   * of the body.
   */
  struct Face
  {
    unsigned int              body;
    unsigned int              boundary; ///< index among the boundary names of the body
    unsigned int              cell;     ///< index into cells()
    unsigned int              number;   ///< number in the cell: side s of axis d is 2d + s
    std::vector<unsigned int> nodes;
    /// known surface on which the face lies, or no_surface, see BodyGeometry
    unsigned int              known_surface;
    std::vector<unsigned int> samples; ///< empty if the face has no samples
  };

  /// A hanging node. The value at @p node is sum_m weight_m master_m, and masters are
  /// never hanging.
  struct Hanging
  {
    unsigned int                                 node;
    std::vector<std::pair<unsigned int, double>> masters;
  };

  /// Make the mesh of the cells of a forest. Without @p tearing, the cells stay on the ranks on
  /// which p4est has them and all parts are 0: such a mesh is cheap and has all faces and points,
  /// but it cannot be torn, and cell_neighbours() and interior_faces() are empty. Collective.
  /// @throws InputError for bad mesh entries.
  BodyMesh(const Forest<dim>                      &forest,
           unsigned int                            degree,
           const Idealization                     &idealization,
           const std::optional<TearingParameters> &tearing);

  /// Make the mesh of bodies. Collective. @throws InputError for bad mesh entries.
  BodyMesh(MPI_Comm                                         communicator,
           const std::vector<geometry::BodyMeshParameters> &bodies,
           unsigned int                                     degree,
           const Idealization      &idealization = Idealization::natural(dim),
           const TearingParameters &tearing      = TearingParameters());

  MPI_Comm     communicator() const { return comm; }
  unsigned int degree() const { return fe_degree; }
  /// Return the solid or the section of a solid that the mesh represents.
  const Idealization                &idealization() const { return meaning; }
  unsigned int                       n_bodies() const { return geometries->size(); }
  const geometry::BodyGeometry<dim> &geometry(unsigned int body) const
  {
    return *(*geometries)[body];
  }

  const std::vector<Cell>    &cells() const { return mesh_cells; }
  const std::vector<Face>    &boundary_faces() const { return mesh_faces; }
  const std::vector<Hanging> &hanging() const { return hanging_nodes; }

  const std::vector<Tetrahedron> &tetrahedra() const { return whole_tetrahedra; }
  /// Return the tetrahedron of a cell of cells(), or null.
  const Tetrahedron *tetrahedron(unsigned int cell) const
  {
    const unsigned int t = tetrahedron_of_cell[cell];
    return t < whole_tetrahedra.size() ? &whole_tetrahedra[t] : nullptr;
  }

  unsigned int n_local_nodes() const { return relevant.n_elements(); }
  /// Return the number of local nodes and samples.
  unsigned int n_points() const { return reference.size(); }
  /// Return the global number of a local node.
  unsigned int global_node(unsigned int node) const { return relevant.nth_index_in_set(node); }
  /// Return the local index of a global node. The node must be relevant on this rank.
  unsigned int local_node(unsigned int global) const { return relevant.index_within_set(global); }
  /// Return the rank that owns a local node.
  unsigned int owner(unsigned int node) const { return owner_of_global(global_node(node)); }
  /// Return the rank that owns a global node.
  unsigned int owner_of_global(unsigned int global) const;
  bool is_hanging(unsigned int node) const { return hanging_of_node[node] < hanging_nodes.size(); }
  /// Return the index of a hanging node in hanging(). The node must be hanging.
  unsigned int hanging_index(unsigned int node) const { return hanging_of_node[node]; }
  unsigned int body_of_node(unsigned int node) const { return node_body[node]; }

  const std::vector<dealii::Point<dim>> &logical_positions() const { return logical; }
  /// Return the reference positions, with interpolated hanging nodes. In axisymmetric
  /// bodies, points on the axis have x = 0 without round-off.
  const Field &reference_positions() const { return reference; }
  /// Set @p field at hanging nodes to the interpolation of the masters.
  void interpolate_hanging(Field &field) const;
  /// Apply the transpose: add values at hanging nodes to the masters, then set them to zero.
  void distribute_hanging(Field &field) const;
  /// Set @p field at samples to the interpolation of the nodes of the faces.
  void interpolate_samples(Field &field) const;
  /// Apply the transpose: add values at samples to the nodes, then set them to zero.
  void distribute_samples(Field &field) const;

  /// Return the number of active cells of all ranks.
  unsigned long n_global_cells() const { return n_cells; }
  /// Return the number of nodes of all ranks that are not hanging.
  unsigned long n_global_free_nodes() const { return n_free_nodes; }

  /// Return the faces between owned cells, and between owned cells and cells of other ranks. The
  /// indices of cells of other ranks follow the indices of cells().
  const std::vector<InteriorFace<dim>> &interior_faces() const { return inner_faces; }
  /// Return the cell with an index of interior_faces(). Cells of other ranks have no valid part.
  const Cell &known_cell(unsigned int index) const
  {
    return index < mesh_cells.size() ? mesh_cells[index] : other_cells[index - mesh_cells.size()];
  }

  /// Return the id of a cell of cells(). The id does not depend on the number of ranks. In finer
  /// meshes, the same id names the cell together with all its children.
  const dealii::CellId &cell_id(unsigned int cell) const { return cell_ids[cell]; }

  const geometry::CoarseCells<dim> &coarse_cells() const { return places; }

  /// Return the reference position of the body at coordinates @p unit of a cell of cells(). Meshes
  /// interpolate this position between nodes.
  dealii::Point<dim> true_position(unsigned int cell, const dealii::Point<dim> &unit) const
  {
    return geometry(mesh_cells[cell].body).position(places.point(cell_ids[cell], unit));
  }

  /// Return the pairs of owned cells (a < b) that share a face or part of a face.
  const CellPairs &cell_neighbours() const { return neighbours; }

private:
  struct Source;

  MPI_Comm                               comm;
  unsigned int                           fe_degree;
  Idealization                           meaning;
  std::shared_ptr<const Geometries<dim>> geometries;
  geometry::CoarseCells<dim>             places; ///< of the coarse cells
  // Owned and ghost nodes. A local index is the position of the node in this set.
  dealii::IndexSet          relevant;
  std::vector<unsigned int> first_node_of_rank; ///< n_ranks + 1
  // per point
  std::vector<unsigned int>       node_body;
  std::vector<dealii::Point<dim>> logical;
  Field                           reference;
  std::vector<unsigned int>       hanging_of_node; ///< index, or the maximum integer
  std::vector<Cell>               mesh_cells;
  std::vector<dealii::CellId>     cell_ids;
  std::vector<Face>               mesh_faces;
  std::vector<Hanging>            hanging_nodes;
  std::vector<Tetrahedron>        whole_tetrahedra;
  std::vector<unsigned int>       tetrahedron_of_cell; ///< index, or the maximum integer
  CellPairs                       neighbours;
  /// cells of other ranks that share a face with a cell of this rank
  std::vector<Cell>              other_cells;
  std::vector<InteriorFace<dim>> inner_faces;
  /// shape functions of the nodes of a face at the samples of the face
  std::vector<std::vector<double>> sample_weights;
  unsigned long                    n_cells = 0, n_free_nodes = 0;

  void number_nodes(const Source &source);
  void collect_nodes(const Source &source);
  void collect_hanging(const Source &source);
  void collect_cells(const Source &source);
  void collect_interior_faces(const Source &source);
  void collect_samples(const std::vector<geometry::BodyMeshParameters> &bodies,
                       const Source                                    &source);
  bool is_flat(const Face &face) const;
  void snap_to_axis();
};
} // namespace snug::mesh

#endif
