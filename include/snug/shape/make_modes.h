#ifndef snug_shape_make_modes_h
#define snug_shape_make_modes_h

#include <snug/shape/shape_basis.h>

namespace snug::shape {
/**
 * Return heights over a face from a net of n1 x n2 (2D: n1) control points,
 *   u(x) = sum_i B_i(s, t) alpha_i d(x),  i = j + n1 k,
 * with products B_i of B-splines of @p degree, or of Bernstein polynomials
 * if @p degree is 0. s and t are the fractions of FaceCoordinates. Splines are periodic along
 * closed coordinates, and even across the boundaries of the entry Smooth across symmetry. d is the
 * given unit direction or the normal of the face.
 *
 * Control points are placed at their Greville abscissae. For the entry Symmetry, control points
 * of a projection lie at the mean height of the face. Control points are shown on the face itself.
 * Collective. @throws InputError naming the entry.
 */
template <int dim>
Modes<dim>
spline_patch(const ShapedFace<dim> &face, const ShapeParameters &parameters, unsigned int degree);

/**
 * Return the modes of a free-form deformation. The nodes of some bodies inside a box move by
 *   u(x) = sum_i B_i(s) p_i,  s = (x - corner) / size,
 * with products B_i of splines along the axes as in spline_patch(),
 * and the moves p_i of control points. The control points are placed at their Greville
 * abscissae, so that an affine map of the control points moves the box by the same affine map.
 * The variables of a control point are its moves along x, y, z, or along one direction.
 *
 * Where a side of the box cuts a body, the control points of that side
 * are frozen, so that the field is continuous. Control points that move no
 * node are frozen as well. Collective.
 *
 * Source: T. W. Sederberg, S. R. Parry, SIGGRAPH 1986.
 * @throws InputError naming the entry Bodies, Box corner, Box size,
 *   Control points or Direction.
 */
template <int dim>
Modes<dim> spline_box(const mesh::BodyMesh<dim> &mesh,
                      const BodyNames           &bodies,
                      const ShapeParameters     &parameters,
                      unsigned int               degree);

/**
 * Return modes with one variable per face node that does not hang. A filter of radius r smooths
 * the moves:
 *   u_i = c_i d_i sum_j w_ij alpha_j / sum_j w_ij,
 *   w_ij = A_j max(0, 1 - |x_i - x_j| / r),
 * with the reference positions x, tributary areas A and normals d (or the
 * given direction). Without fixed nodes c_i = 1. With fixed nodes
 * c_i = min(1, distance from the nearest fixed node / r), so that the moves of fixed nodes are
 * zero and the moves of other nodes decrease to zero continuously. Equal alpha move a plane face
 * as a whole.
 *
 * Sources: the filter of Bruns, Tortorelli, Comput. Methods Appl. Mech.
 * Engrg. 190 (2001), used for shapes in the vertex morphing of Hojjat,
 * Stavropoulou, Bletzinger, ibid. 268 (2014).
 * @throws InputError naming the entry Filter radius, Direction or Fixed.
 */
template <int dim>
Modes<dim> node_wise(const ShapedFace<dim> &face, const ShapeParameters &parameters);
} // namespace snug::shape

#endif
