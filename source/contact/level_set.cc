#include <snug/contact/level_set.h>

#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace snug::contact {
namespace {
/// Step of the difference quotients, as a fraction of the element size. With 1/25, the error of the
/// derivative of a wave six elements long is 3e-11, and the round-off of second derivatives is 1e3
/// times that of the formula.
const double level_set_step = 1. / 25.;

/// Return the rotation in the plane of e_last and @p axis that maps e_last to the direction of
/// @p axis.
template <int dim>
dealii::Tensor<2, dim> rotation_to(dealii::Tensor<1, dim> axis)
{
  axis /= axis.norm();
  dealii::Tensor<1, dim> last;
  last[dim - 1]            = 1.;
  dealii::Tensor<2, dim> q = dealii::unit_symmetric_tensor<dim>();
  // The rotation is the product of the reflections at the planes normal to e_last and to s. It is
  // not defined for opposite directions, for which any half turn about an axis normal to e_last
  // suffices.
  const auto s = last + axis;
  if (s.norm() > 1e-8)
    return q - outer_product(s, s) / (1. + axis[dim - 1]) + 2. * outer_product(axis, last);
  q[0][0] = q[dim - 1][dim - 1] = -1.;
  return q;
}

/// Return whether @p a is positive definite, by its leading minors (Sylvester); 2 or 3 dimensions.
template <int dim>
bool is_positive_definite(const dealii::SymmetricTensor<2, dim> &a)
{
  return a[0][0] > 0. && a[0][0] * a[1][1] > a[0][1] * a[0][1] && determinant(a) > 0.;
}
} // namespace

/// The point y = x - m grad phi(y) with the value and the derivatives of phi at y. The unknowns of
/// Newton's method are y and the multiplier m. At the solution m |grad phi| = n . (x - y) is the
/// signed distance.
template <int dim>
struct LevelSet<dim>::ClosestPoint
{
  dealii::Point<dim>     y;
  double                 m = 0.;
  double                 value;
  dealii::Tensor<1, dim> gradient;
  dealii::Tensor<2, dim> hessian;
  /// inverse of [I + m hessian, n; n', 0] with n = gradient / |gradient|
  dealii::FullMatrix<double> inverse = dealii::FullMatrix<double>(dim + 1, dim + 1);

  /// Return the derivative of y with respect to x.
  dealii::Tensor<2, dim> follow() const
  {
    dealii::Tensor<2, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        result[i][j] = inverse(i, j);
    return result;
  }

  /// Compute the inverse. Return whether the inverse exists and y is a minimum of the distance.
  bool invert();
};

template <int dim>
bool LevelSet<dim>::ClosestPoint::invert()
{
  const double length = gradient.norm();
  if (!(length > 0.) || !std::isfinite(length))
    return false;
  const dealii::Tensor<1, dim> n        = gradient / length;
  const auto                   identity = dealii::unit_symmetric_tensor<dim>();
  // y is a minimum of the distance on phi = 0 if I + m H is positive definite on the tangents. Past
  // a centre of curvature I + m H is not, and other points of the obstacle are closer.
  const dealii::Tensor<2, dim> across = identity - outer_product(n, n);
  const dealii::Tensor<2, dim> A      = identity + m * hessian;
  const auto                   bend   = symmetrize(across * A * across + outer_product(n, n));
  if (!is_positive_definite(bend - 1e-6 * identity))
    return false;
  // The unit normal in place of the gradient scales the matrix, so that all entries are of order
  // one.
  for (unsigned int i = 0; i < dim; ++i)
    {
      for (unsigned int j = 0; j < dim; ++j)
        inverse(i, j) = A[i][j];
      inverse(i, dim) = inverse(dim, i) = n[i];
    }
  inverse(dim, dim) = 0.;
  inverse.gauss_jordan();
  return true;
}

template <int dim>
LevelSet<dim>::LevelSet(const ObstacleParameters &parameters, double element_size)
  : formula("Formula", parameters.formula)
  , origin(to_point<dim>(parameters.point))
  , rotation(rotation_to<dim>(to_point<dim>(parameters.axis)))
  , size(element_size)
  , step(level_set_step * element_size)
{}

template <int dim>
void LevelSet<dim>::evaluate(ClosestPoint &closest) const
{
  // The formula depends on coordinates rotated to Axis, so its derivatives are rotated back.
  const dealii::Point<dim> local(transpose(rotation) * (closest.y - origin));
  closest.value    = formula.value(local);
  closest.gradient = rotation * formula.gradient(local, step);
  closest.hessian  = rotation * formula.hessian(local, step) * transpose(rotation);
}

/// Move y along the gradient to within a tenth of an element of phi = 0. The result is the initial
/// guess of Newton's method. Return whether this distance is reached.
template <int dim>
bool LevelSet<dim>::descend(const dealii::Point<dim> &x, ClosestPoint &closest) const
{
  closest.y = x;
  for (unsigned int i = 0; i < 50; ++i)
    {
      evaluate(closest);
      const double square = closest.gradient.norm_square();
      if (!(square > 0.) || !std::isfinite(square))
        return false;
      // Make a Newton step for phi = 0 along the gradient.
      const dealii::Tensor<1, dim> move = -closest.value / square * closest.gradient;
      closest.y += move;
      // Take m from y - x + m grad phi = 0 in the direction of the gradient.
      closest.m = (x - closest.y) * closest.gradient / square;
      if (move.norm() < 0.1 * size)
        return true;
    }
  return false;
}

template <int dim>
std::optional<typename LevelSet<dim>::ClosestPoint>
LevelSet<dim>::closest_point(const dealii::Point<dim> &x) const
{
  ClosestPoint closest;
  if (!descend(x, closest))
    return std::nullopt;
  bool close = false;
  for (unsigned int i = 0; i < 30; ++i)
    {
      evaluate(closest);
      // Check every iterate, because the matrix of Newton's method has to be regular and to lead to
      // a minimum.
      if (!closest.invert())
        return std::nullopt;
      // Return only after another evaluation, because distance() takes the gradient and the Hessian
      // at the closest point.
      if (close)
        return closest;
      // The matrix contains the unit normal in place of the gradient, so the residual and the
      // multiplier are scaled by the length of the gradient.
      const double           length = closest.gradient.norm();
      const auto             rest   = closest.y - x + closest.m * closest.gradient;
      dealii::Tensor<1, dim> move;
      double                 dm = 0.;
      for (unsigned int k = 0; k < dim; ++k)
        {
          for (unsigned int l = 0; l < dim; ++l)
            move[k] -= closest.inverse(k, l) * rest[l];
          move[k] -= closest.inverse(k, dim) * closest.value / length;
          dm -= closest.inverse(dim, k) * rest[k];
        }
      dm -= closest.inverse(dim, dim) * closest.value / length;
      closest.y += move;
      closest.m += dm / length;
      // Convergence is quadratic, so the next error is below round-off.
      close = move.norm() < 1e-9 * size;
    }
  return std::nullopt;
}

template <int dim>
std::optional<ObstacleDistance<dim>> LevelSet<dim>::distance(const dealii::Point<dim> &x) const
{
  const auto found = closest_point(x);
  if (!found)
    return std::nullopt;
  const double                 length = found->gradient.norm();
  const dealii::Tensor<1, dim> n      = found->gradient / length;
  // n' = (I - n n') H y' / |grad phi|, the derivative of a unit vector.
  const dealii::Tensor<2, dim> turn = found->hessian * found->follow() / length;
  const dealii::Tensor<2, dim> across =
    dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) - outer_product(n, n);
  return ObstacleDistance<dim>{(x - found->y) * n, n, across * turn};
}

template class LevelSet<2>;
template class LevelSet<3>;
} // namespace snug::contact
