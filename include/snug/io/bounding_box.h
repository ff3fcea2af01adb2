#ifndef snug_io_bounding_box_h
#define snug_io_bounding_box_h

#include <snug/contact/pair.h>
#include <snug/mesh/body_mesh.h>

namespace snug::io {
/// This struct is a box along the axes [length].
template <int dim>
struct BoundingBox
{
  dealii::Point<dim> lower, upper;

  /// Return the length of the diagonal.
  double diagonal() const { return lower.distance(upper); }
};

/// Return the bounding box of the nodes of @p body in the reference geometry. Collective.
template <int dim>
BoundingBox<dim> box_of_body(const mesh::BodyMesh<dim> &mesh, unsigned int body);

/// Return the bounding box of the nodes of @p side in the reference geometry. Collective.
template <int dim>
BoundingBox<dim> box_of_side(const mesh::BodyMesh<dim> &mesh, const contact::Side &side);

/// Return the distance between two boxes, which is zero if they overlap.
template <int dim>
double distance(const BoundingBox<dim> &a, const BoundingBox<dim> &b);
} // namespace snug::io

#endif
