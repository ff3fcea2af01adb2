#ifndef snug_shape_limits_h
#define snug_shape_limits_h

#include <snug/shape/face_coordinates.h>
#include <snug/shape/shape_basis.h>
#include <snug/shape/spline.h>

namespace snug::shape {
/**
 * Return the limits of a patch for the entries Only remove, Maximum slope, Convex and Minimum tool
 * radius. With the move h outwards, the coordinate s as a length, and the curvature k of the face
 * along s, positive where the face is convex,
 *
 * | entry               | limit                     |
 * |---------------------|---------------------------|
 * | Only remove         | h <= 0                    |
 * | Maximum slope       | -m <= dh/ds <= m          |
 * | Convex              | d2h/ds2 <= k              |
 * | Minimum tool radius | d2h/ds2 <= k + 1/R        |
 *
 * along each coordinate with several control points. The control points of h and of its derivatives
 * obey the limits, so that the functions obey them everywhere, because the values of a spline lie
 * between the minimum and the maximum of its control points. k is the minimum over the part of the
 * face that the control point moves. The curvature of the moved face differs from k - d2h/ds2 by
 * terms of second order in dh/ds, and for moves along normals by the relative change of k.
 * @throws InputError naming the entry.
 */
template <int dim>
std::vector<ControlLimit> patch_limits(const ShapedFace<dim>                 &face,
                                       const FaceCoordinates<dim>            &coordinates,
                                       const SplineNet                       &net,
                                       const typename ShapedFace<dim>::Field &directions,
                                       const ShapeParameters                 &parameters);

/// Return the limit h <= 0 of each of @p n controls if the entry Only remove is set. The weights of
/// controls in the moves must not be negative. @throws InputError naming the entry.
template <int dim>
std::vector<ControlLimit> removal_limits(const ShapedFace<dim>                 &face,
                                         unsigned int                           n,
                                         const typename ShapedFace<dim>::Field &directions,
                                         const ShapeParameters                 &parameters);
} // namespace snug::shape

#endif
