#ifndef snug_contact_nearest_face_h
#define snug_contact_nearest_face_h

#include <snug/contact/face_tree.h>
#include <snug/faces/closest_point.h>

namespace snug::contact {
/// This class finds the nearest of the faces of one side of a pair.
template <int dim>
class NearestFace
{
public:
  struct Found
  {
    unsigned int             face; ///< index of the surface face
    faces::ClosestPoint<dim> point;
  };

  /// Prepare the search among @p faces of @p surface, at least one face. The shape must outlive
  /// this object.
  NearestFace(const mesh::Surface<dim>                 &surface,
              const std::vector<unsigned int>          &faces,
              const faces::FaceShape<dim>              &shape,
              const typename mesh::Surface<dim>::Field &positions)
    : shape(shape), faces(faces), tree(surface, faces, shape, positions)
  {}

  /// Return the face closest to @p p. Of equally close faces, return the one with the lowest index.
  Found closest(const dealii::Tensor<1, dim> &p) const;

private:
  const faces::FaceShape<dim>    &shape;
  const std::vector<unsigned int> faces;
  const FaceTree<dim>             tree;
};
} // namespace snug::contact

#endif
