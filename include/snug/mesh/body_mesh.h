#ifndef snug_mesh_body_mesh_h
#define snug_mesh_body_mesh_h

#include <snug/geometry/body_geometry.h>
#include <snug/mesh/idealization.h>
#include <snug/mesh/partition.h>

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
 */
template <int dim>
class BodyMesh
{
public:
  using Field = std::vector<dealii::Tensor<1, dim>>; ///< per local node

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
    std::vector<unsigned int> nodes;
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
  ~BodyMesh();

  MPI_Comm     communicator() const;
  unsigned int degree() const;
  /// What the mesh stands for.
  const Idealization                &idealization() const;
  unsigned int                       n_bodies() const;
  const geometry::BodyGeometry<dim> &geometry(unsigned int body) const;

  const std::vector<Cell>    &cells() const;
  const std::vector<Face>    &boundary_faces() const;
  const std::vector<Hanging> &hanging() const;

  unsigned int n_local_nodes() const;
  /// Global number of a local node.
  unsigned int global_node(unsigned int node) const;
  /// Local index of a global node; it must be relevant on this rank.
  unsigned int local_node(unsigned int global) const;
  /// Rank that owns a local node.
  unsigned int owner(unsigned int node) const;
  /// Rank that owns a global node.
  unsigned int owner_of_global(unsigned int global) const;
  bool         is_hanging(unsigned int node) const;
  /// Index into hanging(), only for hanging nodes.
  unsigned int hanging_index(unsigned int node) const;
  unsigned int body_of_node(unsigned int node) const;

  const std::vector<dealii::Point<dim>> &logical_positions() const;
  /// Reference positions, hanging nodes interpolated. Of axisymmetric
  /// bodies, nodes on the axis have x = 0 without round-off.
  const Field &reference_positions() const;
  /// field at hanging nodes <- interpolation of their masters
  void interpolate_hanging(Field &field) const;
  /// Transpose: add values at hanging nodes to their masters, then zero.
  void distribute_hanging(Field &field) const;

  /// Active cells of all ranks.
  unsigned long n_global_cells() const;
  /// Nodes without hanging ones, of all ranks.
  unsigned long n_global_free_nodes() const;

  /// Pairs of owned cells (a < b) that share a face or part of one.
  const std::vector<std::pair<unsigned int, unsigned int>> &cell_neighbours() const;

private:
  struct Data;
  std::unique_ptr<Data> data;
};
} // namespace snug::mesh

#endif
