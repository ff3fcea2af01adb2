#ifndef snug_mortar_mortar_face_h
#define snug_mortar_mortar_face_h

#include <snug/faces/face_shape.h>
#include <snug/faces/point_field.h>
#include <snug/mortar/segment_points.h>

namespace snug::mortar {
/// Return face @p face of the surface, with its nodes and offsets from the @p positions of points.
template <int dim, typename Number>
MortarFace<dim, Number> mortar_face(const mesh::Surface<dim>             &surface,
                                    const faces::FaceShape<dim>          &shape,
                                    unsigned int                          face,
                                    const faces::PointField<dim, Number> &positions);
} // namespace snug::mortar

#endif
