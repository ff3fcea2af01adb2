#ifndef snug_contact_tangent_row_h
#define snug_contact_tangent_row_h

#include <snug/contact/row_group.h>
#include <snug/faces/point_field.h>

namespace snug::contact {
/// The part of the couple of a tangential row that acts on the faces around a node of the row.
struct CouplePatch
{
  unsigned int              centre = 0;  ///< the node of the row
  std::vector<unsigned int> nodes  = {}; ///< surface nodes of the faces around it
  unsigned int spread = 0; ///< number of tangential directions in which these nodes spread, above 0
};

/// Data of the tangential rows of one contact row that a contact search fixes.
template <int dim>
struct TangentFrame
{
  /// direction in space from which the tangents in 3D are made
  dealii::Tensor<1, dim> reference;
  /// patches of each side on which the couple acts; sides without patches are left out
  std::vector<std::vector<CouplePatch>> couple;
  dealii::Tensor<1, dim>                displacement; ///< of the obstacle in space [length]
};

/**
 * Return tangent @p index of the frame with the unit normal @p n. In 2D it is n turned by +90
 * degrees. In 3D, with the reference direction r,
 *   t_0 = (r - (r . n) n) / |r - (r . n) n|,  t_1 = n x t_0.
 */
template <int dim, typename Number>
dealii::Tensor<1, dim, Number> tangent_direction(const dealii::Tensor<1, dim>         &reference,
                                                 const dealii::Tensor<1, dim, Number> &n,
                                                 unsigned int                          index);

/**
 * Return the tangential row along @p t, at right angles to the normal n, of a contact with the
 * normal @p row at the nodal positions @p x. All vectors are in space. The row is linear in t. Its
 * coefficients are
 *   f_a t + beta_a n,  f_a = c_a . n,
 * where c_a are the coefficients of the normal row, and its gap is t . w with the displacement w of
 * an obstacle. The forces f_a t alone would have the moment -g n x t, g = -n . sum_a f_a x_a, so
 * that common rotations of both bodies would slip where there is a gap g. The couple beta_a n
 * cancels this moment. Each side has half of it, so that opposite rotations of the two sides, as
 * where a gap between mirror images closes, do not slip either. On a side it is the sum over the
 * nodes b of the row, with the weights f_b, of couples on the nodes of the faces around b:
 *   beta_a = sum_b f_b / (sum f) y_ab . v_b,  v_b = -g/2 H_b^+ t,
 *   H_b = sum_a P y_ab y_ab' P,  P = I - n n',
 * where y_ab is the position relative to the mean of the nodes around b. So the rotation that the
 * row contains is that of a linear fit around each b, interpolated to the place of the row. Fits to
 * the nodes of the row alone would belong to places beside it: an error of the slip of first order
 * in the size of the faces, which alternates from row to row, and so does not decrease as a
 * traction. H^+ is the inverse of H in the tangent plane if the nodes spread in all of its
 * directions. It is H / tr(H)^2, which is the pseudoinverse, if the nodes lie on a line. Nodes b
 * around which nodes do not spread have no part. If none is left on a side, the other side has the
 * whole couple.
 */
template <int dim, typename Number>
Row<dim, Number> tangent_row(const Row<dim, Number>               &row,
                             const dealii::Tensor<1, dim, Number> &t,
                             const TangentFrame<dim>              &frame,
                             const faces::PointField<dim, Number> &x);

/// Return the row along tangent @p index of the frame.
template <int dim, typename Number>
Row<dim, Number> tangent_row(const Row<dim, Number>               &row,
                             unsigned int                          index,
                             const TangentFrame<dim>              &frame,
                             const faces::PointField<dim, Number> &x)
{
  return tangent_row(row, tangent_direction(frame.reference, row.normal, index), frame, x);
}

/// Return in how many directions at right angles to @p normal the @p nodes spread: by more than
/// 1/1000 of their spread in space and of their largest tangential spread. @p reference is that of
/// their TangentFrame.
template <int dim>
unsigned int tangential_spread(const dealii::Tensor<1, dim>             &normal,
                               const dealii::Tensor<1, dim>             &reference,
                               const std::vector<unsigned int>          &nodes,
                               const typename mesh::Surface<dim>::Field &positions);
} // namespace snug::contact

#endif
