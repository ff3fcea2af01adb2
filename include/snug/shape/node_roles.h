#ifndef snug_shape_node_roles_h
#define snug_shape_node_roles_h

#include <snug/shape/shaped_face.h>

namespace snug::shape {
/**
 * This class describes how the local nodes of a body follow the shaped face of the body: as nodes
 * of the face, freely, sliding or not at all. Nodes of boundaries that touch the shaped face slide
 * in these boundaries: a node keeps its distance from each plane of the boundary, so that a node of
 * an edge moves along the edge and a node of a corner stays. Nodes of other boundaries are held.
 * Nodes whose distance from the face nodes is not less than the reach are held as well. All other
 * nodes are free.
 */
template <int dim>
class NodeRoles
{
public:
  static constexpr unsigned int none = static_cast<unsigned int>(-1);

  /// Find the roles of all local nodes. @p reach [length]; 0 means the whole body. Collective.
  NodeRoles(const ShapedFace<dim> &face, double reach);

  /// Return the surface node of a local node of the shaped face, or none for other local nodes.
  unsigned int face_node(unsigned int node) const { return face_nodes[node]; }

  /// Return the projector onto the directions in which a node may follow. The projector is zero for
  /// face nodes, held nodes, hanging nodes and nodes of other bodies.
  const dealii::Tensor<2, dim> &free_directions(unsigned int node) const
  {
    return projectors[node];
  }

private:
  using Normals = std::vector<dealii::Tensor<1, dim>>;

  void find_face_nodes(const ShapedFace<dim> &face);
  /// Return the boundaries of the body other than the face that touch the face (@p touching), or
  /// the boundaries that do not touch the face.
  std::vector<std::pair<unsigned int, unsigned int>> other_boundaries(const ShapedFace<dim> &face,
                                                                      bool touching) const;
  void free_near_nodes(const ShapedFace<dim> &face, double reach);
  void constrain_boundary_nodes(const ShapedFace<dim> &face);

  std::vector<unsigned int>           face_nodes;
  std::vector<dealii::Tensor<2, dim>> projectors;
};
} // namespace snug::shape

#endif
