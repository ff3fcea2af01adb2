#include <snug/elasticity/linear_traction.h>

namespace snug::elasticity {
template <int dim>
dealii::Tensor<2, 3> inertia(const dealii::Tensor<2, dim> &second)
{
  dealii::Tensor<2, 3> I;
  for (unsigned int d = 0; d < 3; ++d)
    // |r|^2 is on the diagonal of all three axes; [2][2] is the entry of a section.
    I[d][d] = trace(second);
  for (unsigned int d = 0; d < dim; ++d)
    for (unsigned int e = 0; e < dim; ++e)
      I[d][e] -= second[d][e];
  return I;
}

template <int dim>
dealii::Tensor<2, 3> inverse(const dealii::Tensor<2, 3> &I)
{
  if (dim == 3)
    return invert(I);
  dealii::Tensor<2, 3> result;
  result[2][2] = 1. / I[2][2];
  return result;
}

/// Return the moment. It is positive from x to y.
dealii::Tensor<1, 3> moment_of(const dealii::Tensor<1, 2> &arm, const dealii::Tensor<1, 2> &force)
{
  dealii::Tensor<1, 3> moment;
  moment[2] = arm[0] * force[1] - arm[1] * force[0];
  return moment;
}

dealii::Tensor<1, 3> moment_of(const dealii::Tensor<1, 3> &arm, const dealii::Tensor<1, 3> &force)
{
  return cross_product_3d(arm, force);
}

/// Return (0, 0, w) x (v_x, v_y, 0) = (-w v_y, w v_x, 0).
dealii::Tensor<1, 2> turned(const dealii::Tensor<1, 3> &axis, const dealii::Tensor<1, 2> &v)
{
  dealii::Tensor<1, 2> result;
  result[0] = -axis[2] * v[1];
  result[1] = axis[2] * v[0];
  return result;
}

dealii::Tensor<1, 3> turned(const dealii::Tensor<1, 3> &axis, const dealii::Tensor<1, 3> &v)
{
  return cross_product_3d(axis, v);
}

template <int dim>
SpreadResultant<dim>::SpreadResultant(const Resultant<dim>         &resultant,
                                      const AreaMoments<dim>       &moments,
                                      const dealii::Tensor<1, dim> &origin)
  : moments(moments)
{
  const auto to_centre = moments.first / moments.area;
  spread.uniform       = resultant.force / moments.area;
  spread.centre        = origin + to_centre;
  // Without a moment, the inverse of I stays zero, and with it spin and the derivative of spin.
  if (resultant.moment.norm() == 0.)
    return;
  inverse_inertia =
    // By Steiner's theorem, int r r dA about the centroid follows from the moments about the
    // origin.
    inverse<dim>(inertia(moments.second - moments.area * outer_product(to_centre, to_centre)));
  spread.spin = inverse_inertia * resultant.moment;
}

/// Compute c' = (first' - A' (c - o)) / A, a' = -A'/A a, and I' by Steiner's theorem with its
/// product terms.
template <int dim>
LinearTraction<dim> SpreadResultant<dim>::derivative(const AreaMoments<dim> &change) const
{
  const auto          to_centre     = moments.first / moments.area;
  const auto          centre_change = (change.first - change.area * to_centre) / moments.area;
  LinearTraction<dim> result;
  result.uniform           = (-change.area / moments.area) * spread.uniform;
  result.centre            = centre_change;
  const auto second_change = change.second - change.area * outer_product(to_centre, to_centre) -
                             moments.area * (outer_product(centre_change, to_centre) +
                                             outer_product(to_centre, centre_change));
  // I w = M with fixed M gives I w' = -I' w. Without a moment the inverse is zero, and so is w'.
  result.spin = -1. * divided_by_inertia(inertia(second_change) * spread.spin);
  return result;
}

template dealii::Tensor<2, 3> inertia(const dealii::Tensor<2, 2> &);
template dealii::Tensor<2, 3> inertia(const dealii::Tensor<2, 3> &);
template dealii::Tensor<2, 3> inverse<2>(const dealii::Tensor<2, 3> &);
template dealii::Tensor<2, 3> inverse<3>(const dealii::Tensor<2, 3> &);
template class SpreadResultant<2>;
template class SpreadResultant<3>;
} // namespace snug::elasticity
