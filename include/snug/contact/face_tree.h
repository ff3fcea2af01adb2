#ifndef snug_contact_face_tree_h
#define snug_contact_face_tree_h

#include <snug/faces/closest_point.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

namespace snug::contact {
/// Return the positions of the nodes of a face.
template <int dim>
std::vector<dealii::Tensor<1, dim>> face_nodes(const mesh::Surface<dim>                 &surface,
                                               unsigned int                              face,
                                               const typename mesh::Surface<dim>::Field &positions);

/// This class searches the faces of one side of a pair with a tree of boxes. Each box contains its
/// face, so that the search misses no face.
template <int dim>
class FaceTree
{
public:
  using Box = dealii::BoundingBox<dim>;

  /// Build the tree of @p faces of @p surface. The shape must outlive this object.
  FaceTree(const mesh::Surface<dim>                 &surface,
           const std::vector<unsigned int>          &faces,
           const faces::FaceShape<dim>              &shape,
           const typename mesh::Surface<dim>::Field &positions);

  /// Disable copying, because the tree refers to the boxes.
  FaceTree(const FaceTree &)            = delete;
  FaceTree &operator=(const FaceTree &) = delete;

  /// Return the positions of the nodes of face @p i of the side.
  const std::vector<dealii::Tensor<1, dim>> &nodes(std::size_t i) const { return face_points[i]; }

  /// Return the diagonal of the box of face @p i of the side [length].
  double extent(std::size_t i) const;

  /// Return an upper bound of the distance between @p x and the nearest face [length].
  double bound(const dealii::Tensor<1, dim> &x) const;

  /// A face of the side with its point closest to a given point.
  using Nearby = std::pair<std::size_t, faces::ClosestPoint<dim>>;

  /// Return the faces that may be closest to @p x, ascending: those whose boxes are as near as the
  /// closest point, up to a millionth of its distance and of the size of its face.
  std::vector<Nearby> nearest(const dealii::Tensor<1, dim> &x) const;

  /// Return the faces whose boxes intersect @p box, ascending.
  std::vector<std::size_t> meeting(const Box &box) const;

private:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;
  using Boxes = std::vector<Box>;

  const faces::FaceShape<dim>                                                 &shape;
  const std::vector<Nodes>                                                     face_points;
  const Boxes                                                                  boxes;
  const decltype(dealii::pack_rtree_of_indices(std::declval<const Boxes &>())) tree;
};

/// Return the diagonal of a box [length].
template <int dim>
double diameter(const dealii::BoundingBox<dim> &box)
{
  const auto &corners = box.get_boundary_points();
  return corners.first.distance(corners.second);
}
} // namespace snug::contact

#endif
