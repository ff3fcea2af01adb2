#ifndef snug_mesh_surface_h
#define snug_mesh_surface_h

#include <snug/mesh/body_mesh.h>

#include <algorithm>
#include <map>

namespace snug::mesh {
/**
 * A set of boundary faces gathered on every rank, for contact search.
 * Surface nodes are numbered by ascending global node; behind them come the
 * samples of the faces, see BodyMesh. All arrays are equal on all ranks.
 */
template <int dim>
class Surface
{
public:
  using Field = std::vector<dealii::Tensor<1, dim>>; ///< per surface node or point

  struct Face
  {
    unsigned int              body, boundary;
    std::vector<unsigned int> nodes; ///< surface nodes, oriented outwards
    /// surface points, ascending without a gap, or empty: the mesh is the surface
    std::vector<unsigned int>          samples;
    const geometry::KnownSurface<dim> *known; ///< null: none
  };

  /// Gather the faces of the (body, boundary) pairs. Collective.
  Surface(const BodyMesh<dim>                                      &mesh,
          const std::vector<std::pair<unsigned int, unsigned int>> &boundaries);

  MPI_Comm communicator() const { return mesh.communicator(); }
  /// What the mesh stands for.
  const Idealization      &idealization() const { return mesh.idealization(); }
  const std::vector<Face> &faces() const { return surface_faces; }
  unsigned int             n_nodes() const { return global_nodes.size(); }
  /// Nodes and samples.
  unsigned int n_points() const { return reference.size(); }
  /// Reference positions of the points.
  const Field &reference_positions() const { return reference; }
  unsigned int global_node(unsigned int surface_node) const { return global_nodes[surface_node]; }
  /// The surface node of a global one; n_nodes(): it is not on the surface.
  unsigned int find(unsigned int global) const
  {
    const auto place = std::lower_bound(global_nodes.begin(), global_nodes.end(), global);
    return place == global_nodes.end() || *place != global ? n_nodes()
                                                           : place - global_nodes.begin();
  }
  /// Masters (surface nodes, weights) of a hanging node; else empty.
  const std::vector<std::pair<unsigned int, double>> &masters(unsigned int surface_node) const
  {
    return node_masters[surface_node];
  }

  /// Values of a field of nodes or points at those of the surface. Collective.
  Field gather(const typename BodyMesh<dim>::Field &field) const;
  /// Add a surface field to a field of nodes or points at those this rank
  /// owns (hanging nodes included), so that a sum over ranks adds each once.
  void add_owned(const Field &surface_field, typename BodyMesh<dim>::Field &field) const;
  /// Cells of this rank, as in BodyMesh::cells(), that have one of these faces.
  std::vector<unsigned int> cells_of(const std::vector<unsigned int> &faces) const;
  /// (surface, local) numbers of the samples on this rank.
  const std::vector<std::pair<unsigned int, unsigned int>> &samples() const
  {
    return owned_samples;
  }

  /// {body, boundary, logical centre in units of 2^-32, known surface, has
  /// samples, global nodes} of a face: as integers, so that sorting gives an
  /// order that does not depend on how cells and nodes are distributed.
  using FaceRecord = std::vector<long long>;

private:
  /// Local numbers of the samples of this rank's faces.
  using OwnSamples = std::map<FaceRecord, const std::vector<unsigned int> *>;

  void add_faces(const std::vector<FaceRecord>              &records,
                 const std::map<unsigned int, unsigned int> &index,
                 const OwnSamples                           &samples);
  void find_owned(const std::map<unsigned int, unsigned int> &index);

  const BodyMesh<dim>                                      &mesh;
  std::vector<Face>                                         surface_faces;
  std::vector<unsigned int>                                 global_nodes;
  std::vector<std::vector<std::pair<unsigned int, double>>> node_masters;
  /// local node of each surface node this rank owns: (surface, local)
  std::vector<std::pair<unsigned int, unsigned int>>    owned, owned_samples;
  std::vector<std::vector<geometry::KnownSurface<dim>>> known_surfaces; ///< per body
  Field                                                 reference;
};
} // namespace snug::mesh

#endif
