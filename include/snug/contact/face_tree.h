#ifndef snug_contact_face_tree_h
#define snug_contact_face_tree_h

#include <snug/faces/face_shape.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

namespace snug::contact {
/// Positions of the nodes of a face.
template <int dim>
std::vector<dealii::Tensor<1, dim>> face_nodes(const mesh::Surface<dim>                 &surface,
                                               unsigned int                              face,
                                               const typename mesh::Surface<dim>::Field &positions);

/// The side of a pair that is searched: a tree of boxes that contain its
/// faces, so that none is missed.
template <int dim>
class FaceTree
{
public:
  using Box = dealii::BoundingBox<dim>;

  /// @p faces of @p surface; the shape must outlive this.
  FaceTree(const mesh::Surface<dim>                 &surface,
           const std::vector<unsigned int>          &faces,
           const faces::FaceShape<dim>              &shape,
           const typename mesh::Surface<dim>::Field &positions);

  /// The tree refers to the boxes.
  FaceTree(const FaceTree &)            = delete;
  FaceTree &operator=(const FaceTree &) = delete;

  /// Of the nodes of the face @p i of the side.
  const std::vector<dealii::Tensor<1, dim>> &nodes(std::size_t i) const { return face_points[i]; }

  /// The diagonal of its box [length].
  double extent(std::size_t i) const;

  /// No face is nearer to @p x than a face that is at least as near as this [length].
  double bound(const dealii::Tensor<1, dim> &x) const;

  /// The face whose box is nearest.
  std::size_t nearest_box(const dealii::Tensor<1, dim> &x) const;

  /// The faces whose boxes meet @p box, ascending.
  std::vector<std::size_t> meeting(const Box &box) const;

private:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;
  using Boxes = std::vector<Box>;

  const faces::FaceShape<dim>                                                 &shape;
  const std::vector<Nodes>                                                     face_points;
  const Boxes                                                                  boxes;
  const decltype(dealii::pack_rtree_of_indices(std::declval<const Boxes &>())) tree;
};

/// The diagonal of a box [length].
template <int dim>
double diameter(const dealii::BoundingBox<dim> &box)
{
  const auto &corners = box.get_boundary_points();
  return corners.first.distance(corners.second);
}
} // namespace snug::contact

#endif
