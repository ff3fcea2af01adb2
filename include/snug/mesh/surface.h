#ifndef snug_mesh_surface_h
#define snug_mesh_surface_h

#include <snug/geometry/rigid_motion.h>
#include <snug/mesh/body_mesh.h>

#include <algorithm>
#include <map>

namespace snug::mesh {
/**
 * A set of boundary faces gathered on every rank, for contact search.
 * Surface nodes are numbered in the order of global nodes. The samples of the faces, see BodyMesh,
 * are numbered behind the nodes. The lists of faces and points are equal on all ranks.
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
    /// surface points, consecutive and ascending; empty if the mesh face is the true surface
    std::vector<unsigned int>          samples;
    const geometry::KnownSurface<dim> *known; ///< null if the face lies on no known surface
  };

  /// Gather the faces of the (body, boundary) pairs. Collective.
  Surface(const BodyMesh<dim>                                      &mesh,
          const std::vector<std::pair<unsigned int, unsigned int>> &boundaries);

  /// Return this surface with the reference positions and the known surfaces of each body moved by
  /// @p motions, one per body.
  Surface moved(const std::vector<geometry::RigidMotion<dim>> &motions) const;

  MPI_Comm communicator() const { return mesh.communicator(); }
  /// Return the solid or the section of a solid that the mesh represents.
  const Idealization      &idealization() const { return mesh.idealization(); }
  const std::vector<Face> &faces() const { return surface_faces; }
  unsigned int             n_nodes() const { return global_nodes.size(); }
  /// Return the number of nodes and samples.
  unsigned int n_points() const { return points; }
  /// Return the reference positions of the points.
  const Field &reference_positions() const { return reference; }
  unsigned int global_node(unsigned int surface_node) const { return global_nodes[surface_node]; }
  /// Return the surface node of a global node, or n_nodes() if the node is not on the surface.
  unsigned int find(unsigned int global) const
  {
    const auto place = std::lower_bound(global_nodes.begin(), global_nodes.end(), global);
    return place == global_nodes.end() || *place != global ? n_nodes()
                                                           : place - global_nodes.begin();
  }
  /// Return the masters (surface nodes, weights) of a hanging node; empty for other nodes.
  const std::vector<std::pair<unsigned int, double>> &masters(unsigned int surface_node) const
  {
    return node_masters[surface_node];
  }

  /// Return the values of a mesh field at the nodes or points of the surface. Collective.
  Field gather(const mesh::Field<dim> &field) const;
  /// Return the values of a mesh field at the nodes alone. Collective.
  Field gather_nodes(const mesh::Field<dim> &field) const;
  /// Return the body of each point.
  std::vector<unsigned int> bodies_of_points() const;
  /// Add a surface field to a field of nodes or points, at the nodes and samples that this rank
  /// owns (hanging nodes included). A sum over ranks thus contains each value once.
  void add_owned(const Field &surface_field, mesh::Field<dim> &field) const;
  /// Return the cells of this rank, as indices of BodyMesh::cells(), that have one of the @p faces.
  std::vector<unsigned int> cells_of(const std::vector<unsigned int> &faces) const;
  /// Return the (surface, local) numbers of the samples on this rank.
  const std::vector<std::pair<unsigned int, unsigned int>> &samples() const
  {
    return owned_samples;
  }

  /// The numbers {body, boundary, logical centre in units of 2^-32, known surface, has
  /// samples, global nodes} of a face. The numbers are integers, so that sorting gives an
  /// order that does not depend on the distribution of cells and nodes.
  using FaceRecord = std::vector<long long>;

private:
  /// Local numbers of the samples of the faces of this rank.
  using OwnSamples = std::map<FaceRecord, const std::vector<unsigned int> *>;

  void  add_faces(const std::vector<FaceRecord> &records, const OwnSamples &samples);
  void  find_owned();
  Field sum_of_owners(const mesh::Field<dim> &field, bool with_samples) const;

  const BodyMesh<dim>                                      &mesh;
  std::vector<Face>                                         surface_faces;
  std::vector<unsigned int>                                 global_nodes;
  std::vector<std::vector<std::pair<unsigned int, double>>> node_masters;
  /// (surface, local) numbers of the nodes and samples that this rank owns
  std::vector<std::pair<unsigned int, unsigned int>>    owned, owned_samples;
  std::vector<std::vector<geometry::KnownSurface<dim>>> known_surfaces; ///< per body
  unsigned int                                          points = 0; ///< number of nodes and samples
  Field                                                 reference;
};
} // namespace snug::mesh

#endif
