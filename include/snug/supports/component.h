#ifndef snug_supports_component_h
#define snug_supports_component_h

#include <deal.II/base/point.h>

namespace snug::supports {
/// Axis of the radial, tangential and axial components: a point [length] and a unit direction,
/// which is not used in 2D.
template <int dim>
struct Axis
{
  dealii::Point<dim>     point;
  dealii::Tensor<1, dim> direction;
};

/**
 * Displacement component with direction e: x, y or z; the normal n of a face; or, about an axis
 * with direction a (z in 2D) through p, with the lever r = (x - p) - (a . (x - p)) a of the point
 * x,
 *
 * radial e = r/|r|, tangential e = t = a x r/|r|, axial e = a.
 *
 * A point that moves with the velocity V turns them about the axis: e' = (t . V)/|r| a x e.
 */
template <int dim>
struct Component
{
  static constexpr unsigned int normal = dim, radial = dim + 1, tangential = dim + 2,
                                axial = dim + 3;

  Component(unsigned int number, const Axis<dim> &axis = {}) : number(number), axis(axis) {}

  bool is_normal() const { return number == normal; }
  /// Return whether e is defined by the axis and changes with x.
  bool turns() const { return number == radial || number == tangential; }
  /// Return whether e depends on the positions.
  bool follows_positions() const { return is_normal() || turns(); }

  /// Return r.
  dealii::Tensor<1, dim> lever(const dealii::Tensor<1, dim> &x) const;

  /// Return e at x, where n is @p unit_normal. On the axis, radial and tangential e are zero.
  dealii::Tensor<1, dim> direction(const dealii::Tensor<1, dim> &x,
                                   const dealii::Tensor<1, dim> &unit_normal) const;

  /// Return the derivative de/dx with e' = (de/dx) V at fixed n.
  dealii::Tensor<2, dim> derivative(const dealii::Tensor<1, dim> &x) const;

  unsigned int number; ///< 0, 1, 2: x, y, z; or one of the names above
  Axis<dim>    axis;
};
} // namespace snug::supports

#endif
