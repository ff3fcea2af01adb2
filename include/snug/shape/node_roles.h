#ifndef snug_shape_node_roles_h
#define snug_shape_node_roles_h

#include <snug/shape/shaped_face.h>

namespace snug::shape {
/**
 * What the local nodes of a body do when its shaped face moves. Those of
 * boundaries that touch the shaped face slide in them: a node keeps its
 * distance from each plane there, so that it moves along an edge and stays
 * in a corner. Those of other boundaries are held, like nodes further
 * from the nodes of the face than the reach.
 */
template <int dim>
class NodeRoles
{
public:
  static constexpr unsigned int none = static_cast<unsigned int>(-1);

  /// @p reach [length]; 0: the whole body. Collective.
  NodeRoles(const ShapedFace<dim> &face, double reach);

  /// Surface node of a local node of the shaped face; else none.
  unsigned int driver(unsigned int node) const { return drivers[node]; }

  /// Projector onto the directions in which a node may follow; zero for
  /// nodes of the face, held and hanging ones and those of other bodies.
  const dealii::Tensor<2, dim> &freedom(unsigned int node) const { return projectors[node]; }

private:
  using Normals = std::vector<dealii::Tensor<1, dim>>;

  void find_drivers();
  /// Boundaries of the body other than the face: those that touch it, or
  /// those that do not.
  std::vector<std::pair<unsigned int, unsigned int>> others(bool touching) const;
  void                                               free_nodes(double reach);
  void                                               hold_or_slide();

  const ShapedFace<dim>              &face;
  std::vector<unsigned int>           drivers;
  std::vector<dealii::Tensor<2, dim>> projectors;
};
} // namespace snug::shape

#endif
