#include <snug/supports/component.h>

namespace snug::supports {
/// Return a x v, where a is z in 2D.
template <int dim>
static dealii::Tensor<1, dim> turned(const dealii::Tensor<1, dim> &a,
                                     const dealii::Tensor<1, dim> &v)
{
  if constexpr (dim == 2)
    return -dealii::cross_product_2d(v);
  else
    return dealii::cross_product_3d(a, v);
}

template <int dim>
dealii::Tensor<1, dim> Component<dim>::lever(const dealii::Tensor<1, dim> &x) const
{
  const dealii::Tensor<1, dim> r = x - axis.point;
  return dim == 2 ? r : r - (r * axis.direction) * axis.direction;
}

template <int dim>
dealii::Tensor<1, dim> Component<dim>::direction(const dealii::Tensor<1, dim> &x,
                                                 const dealii::Tensor<1, dim> &unit_normal) const
{
  if (is_normal())
    return unit_normal;
  if (number == axial)
    return axis.direction;
  if (!turns())
    return dealii::Point<dim>::unit_vector(number);
  auto r = lever(x);
  if (r.norm() > 0.)
    r /= r.norm();
  return number == radial ? r : turned(axis.direction, r);
}

template <int dim>
dealii::Tensor<2, dim> Component<dim>::derivative(const dealii::Tensor<1, dim> &x) const
{
  const auto r = lever(x);
  if (!turns() || r.norm() == 0.)
    return {};
  return outer_product(turned(axis.direction, direction(x, {})), turned(axis.direction, r)) /
         r.norm_square();
}

template struct Component<2>;
template struct Component<3>;
} // namespace snug::supports
