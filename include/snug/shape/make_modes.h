#ifndef snug_shape_make_modes_h
#define snug_shape_make_modes_h

#include <snug/shape/shape_basis.h>

namespace snug::shape {
/**
 * Heights over a face from a net of n1 x n2 (2D: n1) control points,
 *   u(x) = sum_i B_i(s, t) alpha_i d(x),  i = j + n1 k,
 * with products B_i of B-splines of @p degree, or Bernstein polynomials
 * where it is 0. s and t are the fractions, in the order x, y, z, of the
 * face's bounding rectangle along the two axes that its mean normal leaves;
 * the face must be a graph over them. d: the given unit direction or the
 * face's normal.
 *
 * Control points stand at their Greville abscissae: for Symmetry at the mean
 * height of the face; shown where the face is there.
 * @throws InputError naming the entry Face, Control points, Degree or
 *   Direction.
 */
template <int dim>
Modes<dim>
spline_patch(const ShapedFace<dim> &face, const ShapeParameters &parameters, unsigned int degree);

/**
 * Free-form deformation: the nodes of some bodies inside a box move by
 *   u(x) = sum_i B_i(s) p_i,  s = (x - corner) / size,
 * with products B_i of splines along the axes, as those of spline_patch(),
 * and the moves p_i of control points, which stand at their Greville
 * abscissae: points moved by an affine map move the box by that map.
 * Variables of a point: its moves along x, y, z, or along one direction.
 *
 * Where a side of the box cuts a body, the control points of that side
 * are frozen, so that the field is continuous. So are points that move no
 * node. Collective.
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
 * One variable per node of a face that does not hang, smoothed by a filter
 * of radius r:
 *   u_i = c_i d_i sum_j w_ij alpha_j / sum_j w_ij,
 *   w_ij = A_j max(0, 1 - |x_i - x_j| / r),
 * with the reference positions x, tributary areas A and normals d (or the
 * given direction), and c_i = 1. Where nodes are fixed, their rows are
 * zero and c_i = min(1, distance from the nearest fixed node / r) leads
 * smoothly there. Equal alpha move a plane face as a whole.
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
