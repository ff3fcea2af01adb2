#ifndef snug_mesh_body_mesh_h
#define snug_mesh_body_mesh_h

#include <snug/geometry/coarse_cells.h>
#include <snug/mesh/idealization.h>
#include <snug/mesh/interior_faces.h>
#include <snug/mesh/partition.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/tensor.h>

#include <mpi.h>

#include <memory>
#include <vector>

namespace snug::mesh {
/**
 * The mesh of all bodies on this rank: one triangulation, its nodes (scalar
 * degrees of freedom of FE_Q(degree); displacement component c of node a is
 * unknown dim*a + c) and plain arrays the other modules work on.
 *
 * Local node indices run over the locally relevant nodes. Cells are the
 * locally owned ones. Node k of a cell is tensor-product ordered, the
 * first coordinate fastest, (degree+1)^dim nodes.
 *
 * Behind the nodes come the samples: points of the true surface of boundary
 * faces of this rank, (surface_degree+1)^(dim-1) per face in tensor order.
 * Faces of bodies' sampled boundaries have them, unless the face is flat and
 * stays so, and other curved ones where all are asked for. Positions, velocities and gradients run
 * over nodes and samples, displacements over nodes.
 */
template <int dim>
class BodyMesh
{
public:
  using Field = std::vector<dealii::Tensor<1, dim>>; ///< per local node or point

  struct Cell
  {
    unsigned int              body;
    unsigned int              part;   ///< wholly on this rank
    unsigned int              region; ///< index of the regions of the body
    std::vector<unsigned int> nodes;  ///< local node indices
  };

  /**
   * A boundary face of an owned cell. Its nodes, first tangent fastest,
   * are oriented such that t1 x t2 (3D), or (t_y, -t_x) (2D), points out
   * of the body.
   */
  struct Face
  {
    unsigned int              body;
    unsigned int              boundary; ///< index of the body's names
    unsigned int              cell;     ///< index into cells()
    unsigned int              number;   ///< in the cell: side s of axis d is 2d + s
    std::vector<unsigned int> nodes;
    /// the surface of known shape it lies on, or no_surface, see BodyGeometry
    unsigned int              known_surface;
    std::vector<unsigned int> samples; ///< or empty
  };

  /// The hanging node @p node is sum_m weight_m master_m; masters are
  /// never hanging.
  struct Hanging
  {
    unsigned int                                 node;
    std::vector<std::pair<unsigned int, double>> masters;
  };

  /// Collective. @throws InputError for bad mesh entries.
  BodyMesh(MPI_Comm                                         communicator,
           const std::vector<geometry::BodyMeshParameters> &bodies,
           unsigned int                                     degree,
           const Idealization      &idealization = Idealization::natural(dim),
           const TearingParameters &tearing      = TearingParameters());

  MPI_Comm     communicator() const { return comm; }
  unsigned int degree() const { return fe_degree; }
  /// What the mesh stands for.
  const Idealization                &idealization() const { return meaning; }
  unsigned int                       n_bodies() const { return geometries.size(); }
  const geometry::BodyGeometry<dim> &geometry(unsigned int body) const { return *geometries[body]; }

  const std::vector<Cell>    &cells() const { return mesh_cells; }
  const std::vector<Face>    &boundary_faces() const { return mesh_faces; }
  const std::vector<Hanging> &hanging() const { return hanging_nodes; }

  unsigned int n_local_nodes() const { return relevant.n_elements(); }
  /// Local nodes and samples.
  unsigned int n_points() const { return reference.size(); }
  /// Global number of a local node.
  unsigned int global_node(unsigned int node) const { return relevant.nth_index_in_set(node); }
  /// Local index of a global node; it must be relevant on this rank.
  unsigned int local_node(unsigned int global) const { return relevant.index_within_set(global); }
  /// Rank that owns a local node.
  unsigned int owner(unsigned int node) const { return owner_of_global(global_node(node)); }
  /// Rank that owns a global node.
  unsigned int owner_of_global(unsigned int global) const;
  bool is_hanging(unsigned int node) const { return hanging_of_node[node] < hanging_nodes.size(); }
  /// Index into hanging(), only for hanging nodes.
  unsigned int hanging_index(unsigned int node) const { return hanging_of_node[node]; }
  unsigned int body_of_node(unsigned int node) const { return node_body[node]; }

  const std::vector<dealii::Point<dim>> &logical_positions() const { return logical; }
  /// Reference positions, hanging nodes interpolated. Of axisymmetric
  /// bodies, nodes on the axis have x = 0 without round-off.
  const Field &reference_positions() const { return reference; }
  /// field at hanging nodes <- interpolation of their masters
  void interpolate_hanging(Field &field) const;
  /// Transpose: add values at hanging nodes to their masters, then zero.
  void distribute_hanging(Field &field) const;
  /// field at samples <- interpolation of the nodes of their faces
  void interpolate_samples(Field &field) const;
  /// Transpose: add values at samples to the nodes, then zero.
  void distribute_samples(Field &field) const;

  /// Active cells of all ranks.
  unsigned long n_global_cells() const { return n_cells; }
  /// Nodes without hanging ones, of all ranks.
  unsigned long n_global_free_nodes() const { return n_free_nodes; }

  /// Faces between owned cells, and between these and cells of other ranks, whose indices
  /// go on behind those of cells().
  const std::vector<InteriorFace<dim>> &interior_faces() const { return inner_faces; }
  /// A cell by such an index; of those of other ranks part is not set.
  const Cell &known_cell(unsigned int index) const
  {
    return index < mesh_cells.size() ? mesh_cells[index] : other_cells[index - mesh_cells.size()];
  }

  /// The id of a cell of cells(): the same on any number of ranks, and in finer meshes that of the
  /// cell with all its children.
  const dealii::CellId &cell_id(unsigned int cell) const { return cell_ids[cell]; }

  /// The reference position of the body at coordinates @p unit of a cell of cells(), which meshes
  /// interpolate between their nodes.
  dealii::Point<dim> true_position(unsigned int cell, const dealii::Point<dim> &unit) const
  {
    return geometries[mesh_cells[cell].body]->position(places.point(cell_ids[cell], unit));
  }

  /// Pairs of owned cells (a < b) that share a face or part of one.
  const CellPairs &cell_neighbours() const { return neighbours; }

private:
  struct Source;

  MPI_Comm                                                  comm;
  unsigned int                                              fe_degree;
  Idealization                                              meaning;
  std::vector<std::unique_ptr<geometry::BodyGeometry<dim>>> geometries;
  geometry::CoarseCells<dim>                                places; ///< of the coarse cells
  // Owned and ghost nodes: a local index is the place of a node in this set.
  dealii::IndexSet          relevant;
  std::vector<unsigned int> first_node_of_rank; ///< n_ranks + 1
  // per point
  std::vector<unsigned int>       node_body;
  std::vector<dealii::Point<dim>> logical;
  Field                           reference;
  std::vector<unsigned int>       hanging_of_node; ///< or a number above all
  std::vector<Cell>               mesh_cells;
  std::vector<dealii::CellId>     cell_ids;
  std::vector<Face>               mesh_faces;
  std::vector<Hanging>            hanging_nodes;
  CellPairs                       neighbours;
  /// of other ranks, that share a face with one of this
  std::vector<Cell>              other_cells;
  std::vector<InteriorFace<dim>> inner_faces;
  /// of the nodes of a face at its samples
  std::vector<std::vector<double>> sample_weights;
  unsigned long                    n_cells = 0, n_free_nodes = 0;

  void triangulate(const std::vector<geometry::BodyMeshParameters> &bodies,
                   const TearingParameters                         &tearing,
                   Source                                          &source);
  void number_nodes(Source &source);
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
