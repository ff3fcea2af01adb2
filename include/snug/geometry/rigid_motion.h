#ifndef snug_geometry_rigid_motion_h
#define snug_geometry_rigid_motion_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace snug::geometry {
/// Return the rotation by @p degrees about a coordinate axis, counterclockwise if the axis points
/// to the viewer. Multiples of 90 degrees are exact, because with the round-off of cos 90 faces
/// would not lie exactly in coordinate planes, and an axis of revolution would not lie exactly at x
/// = 0. In 2D the axis is z (2).
template <int dim>
dealii::Tensor<2, dim> rotation(unsigned int axis, double degrees);

/// A rigid motion x' = Q x + t, by default the identity.
template <int dim>
struct RigidMotion
{
  dealii::Tensor<2, dim> Q = dealii::unit_symmetric_tensor<dim>();
  dealii::Tensor<1, dim> t;

  /// Return whether the motion leaves every point exactly where it is.
  bool is_identity() const { return *this == RigidMotion(); }

  bool operator==(const RigidMotion &other) const { return Q == other.Q && t == other.t; }

  dealii::Tensor<1, dim> point(const dealii::Tensor<1, dim> &x) const { return Q * x + t; }
  /// Return the point that the motion takes to @p x.
  dealii::Tensor<1, dim> point_back(const dealii::Tensor<1, dim> &x) const { return (x - t) * Q; }
  dealii::Tensor<1, dim> vector(const dealii::Tensor<1, dim> &v) const { return Q * v; }
  dealii::Tensor<1, dim> vector_back(const dealii::Tensor<1, dim> &v) const { return v * Q; }
};

/**
 * Return the motions that @p text lists, one after the other: "rotate AXIS DEGREES about X Y Z" and
 * "shift X Y Z", separated by commas. AXIS is x, y or z; in 2D it is z. Without "about" the
 * rotation is about the origin. @throws std::invalid_argument with the reason.
 */
template <int dim>
RigidMotion<dim> rigid_motion(const std::string &text);
} // namespace snug::geometry

#endif
