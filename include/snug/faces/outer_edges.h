#ifndef snug_faces_outer_edges_h
#define snug_faces_outer_edges_h

#include <snug/faces/face_shape.h>

#include <map>

namespace snug::faces {
/**
 * This class finds the end of a set of faces: the edges (2D: end points) that no other face of the
 * set shares, neither as a whole edge nor as the half of the edge of a coarser face.
 */
template <int dim>
class OuterEdges
{
public:
  /// Find the outer edges of @p faces, which are indices into @p surface. The references must
  /// outlive this object.
  OuterEdges(const mesh::Surface<dim>        &surface,
             const std::vector<unsigned int> &faces,
             const FaceShape<dim>            &shape);

  /// Return whether a surface node is on an outer edge.
  bool contains(unsigned int node) const { return outer_at_vertex.count(node) > 0; }

  /**
   * Return how far x(xi) + @p offset lies beyond the outer edges that contain x(xi), as a fraction
   * of the face's extent in that direction. The distance is measured within the face at right
   * angles to the edge. It is 0 if x(xi) is on no outer edge. @p face is an index into the surface.
   */
  double excess(unsigned int                              face,
                const dealii::Point<dim - 1>             &xi,
                const dealii::Tensor<1, dim>             &offset,
                const typename mesh::Surface<dim>::Field &positions) const;

private:
  const mesh::Surface<dim> &surface;
  const FaceShape<dim>     &shape;
  /// Pair {face, edge}; on edge 2i+s the coordinate i is s.
  using Edge = std::pair<unsigned int, unsigned int>;
  std::vector<Edge>                         outer;
  std::map<unsigned int, std::vector<Edge>> outer_at_vertex;

  std::pair<unsigned int, unsigned int> ends_of(unsigned int face, unsigned int edge) const;
  std::vector<unsigned int>             edge_nodes(unsigned int face, unsigned int edge) const;
  std::vector<unsigned int>             edge_masters(const std::vector<unsigned int> &nodes) const;
  double                                excess_at_edge(const Edge                               &edge,
                                                       const dealii::Point<dim - 1>             &xi,
                                                       const dealii::Tensor<1, dim>             &offset,
                                                       const typename mesh::Surface<dim>::Field &positions) const;
};
} // namespace snug::faces

#endif
