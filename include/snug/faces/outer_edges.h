#ifndef snug_faces_outer_edges_h
#define snug_faces_outer_edges_h

#include <snug/faces/face_shape.h>

#include <map>

namespace snug::faces {
/**
 * Where a set of faces ends: their edges (2D: end points) that no other
 * face of the set shares, neither whole nor as the half of a coarser
 * face's edge.
 */
template <int dim>
class OuterEdges
{
public:
  /// @p faces: indices into @p surface. The references must outlive this.
  OuterEdges(const mesh::Surface<dim>        &surface,
             const std::vector<unsigned int> &faces,
             const FaceShape<dim>            &shape);

  /**
   * How far x(xi) + @p offset lies beyond the outer edges that contain
   * x(xi), measured within the face at right angles to the edge, as a
   * fraction of the face's extent in that direction. 0 if x(xi) is on no
   * outer edge. @p face is an index into the surface.
   */
  double excess(unsigned int                              face,
                const dealii::Point<dim - 1>             &xi,
                const dealii::Tensor<1, dim>             &offset,
                const typename mesh::Surface<dim>::Field &positions) const;

private:
  const mesh::Surface<dim> &surface;
  const FaceShape<dim>     &shape;
  /// {face, edge}; edge 2i+s is where coordinate i is s
  using Edge = std::pair<unsigned int, unsigned int>;
  std::vector<Edge>                         outer;
  std::map<unsigned int, std::vector<Edge>> outer_at_vertex;

  std::vector<unsigned int> edge_nodes(unsigned int face, unsigned int edge) const;
  std::vector<unsigned int> edge_masters(const std::vector<unsigned int> &nodes) const;
  double                    excess_at_edge(const Edge                               &edge,
                                           const dealii::Point<dim - 1>             &xi,
                                           const dealii::Tensor<1, dim>             &offset,
                                           const typename mesh::Surface<dim>::Field &positions) const;
};
} // namespace snug::faces

#endif
