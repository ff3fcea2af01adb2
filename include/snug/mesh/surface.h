#ifndef snug_mesh_surface_h
#define snug_mesh_surface_h

#include <snug/mesh/body_mesh.h>

namespace snug::mesh {
/**
 * A set of boundary faces gathered on every rank, for contact search.
 * Surface nodes are numbered by ascending global node; all arrays are
 * equal on all ranks.
 */
template <int dim>
class Surface
{
public:
  using Field = std::vector<dealii::Tensor<1, dim>>; ///< per surface node

  struct Face
  {
    unsigned int              body, boundary;
    std::vector<unsigned int> nodes; ///< surface nodes, oriented outwards
  };

  /// Gather the faces of the (body, boundary) pairs. Collective.
  Surface(const BodyMesh<dim>                                      &mesh,
          const std::vector<std::pair<unsigned int, unsigned int>> &boundaries);

  /// What the mesh stands for.
  const Idealization      &idealization() const { return mesh.idealization(); }
  const std::vector<Face> &faces() const { return surface_faces; }
  unsigned int             n_nodes() const { return global_nodes.size(); }
  unsigned int global_node(unsigned int surface_node) const { return global_nodes[surface_node]; }
  /// Masters (surface nodes, weights) of a hanging node; else empty.
  const std::vector<std::pair<unsigned int, double>> &masters(unsigned int surface_node) const
  {
    return node_masters[surface_node];
  }

  /// Values of a nodal field at the surface nodes. Collective.
  Field gather(const typename BodyMesh<dim>::Field &field) const;
  /// Add a surface field to a nodal field at the nodes this rank owns
  /// (hanging nodes included), so that a sum over ranks adds each once.
  void add_owned(const Field &surface_field, typename BodyMesh<dim>::Field &field) const;

private:
  const BodyMesh<dim>                                      &mesh;
  std::vector<Face>                                         surface_faces;
  std::vector<unsigned int>                                 global_nodes;
  std::vector<std::vector<std::pair<unsigned int, double>>> node_masters;
  /// local node of each surface node this rank owns: (surface, local)
  std::vector<std::pair<unsigned int, unsigned int>> owned;
};
} // namespace snug::mesh

#endif
