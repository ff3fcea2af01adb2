#ifndef snug_mortar_face_arrays_h
#define snug_mortar_face_arrays_h

#include <snug/faces/face_shape.h>
#include <snug/mortar/segment_points.h>

namespace snug::mortar {
/// Return the positions of all surface points.
template <int dim>
FaceNodes<dim, double> node_arrays(const typename mesh::Surface<dim>::Field &positions);

/// Return the positions of all surface points with their derivatives along @p velocity.
template <int dim>
FaceNodes<dim, faces::Differential<1>>
node_arrays(const typename mesh::Surface<dim>::Field &positions,
            const typename mesh::Surface<dim>::Field &velocity);

/// Return face @p face of the surface, with its nodes and offsets from the positions @p points.
template <int dim, typename Number>
MortarFace<dim, Number> mortar_face(const mesh::Surface<dim>     &surface,
                                    const faces::FaceShape<dim>  &shape,
                                    unsigned int                  face,
                                    const FaceNodes<dim, Number> &points);

/// Add gradient_a += sum_k offset_gradient_k . d offset_k / d x_a at the points of the face.
template <int dim>
void add_offset_gradient(const typename mesh::Surface<dim>::Face &face,
                         const faces::FaceShape<dim>             &shape,
                         const FaceNodes<dim, double>            &offset_gradient,
                         typename mesh::Surface<dim>::Field      &gradient);
} // namespace snug::mortar

#endif
