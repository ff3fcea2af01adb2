#include <snug/contact/level_set.h>

#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace snug::contact {
namespace {
/// Part of the element size over which differences are taken: with 1/25
/// a wave six elements long is differentiated to 3e-11, and round-off is
/// 1e3 times that of the formula in second derivatives.
const double level_set_step = 1. / 25.;

/// The rotation in the plane of e_last and @p axis that takes the one to
/// the direction of the other.
template <int dim>
dealii::Tensor<2, dim> rotation_to(dealii::Tensor<1, dim> axis)
{
  axis /= axis.norm();
  dealii::Tensor<1, dim> last;
  last[dim - 1]            = 1.;
  dealii::Tensor<2, dim> q = dealii::unit_symmetric_tensor<dim>();
  // The product of the reflections at the planes normal to e_last and to s. Not defined for
  // opposite directions, for which any half turn about an axis normal to e_last does.
  const auto s = last + axis;
  if (s.norm() > 1e-8)
    return q - outer_product(s, s) / (1. + axis[dim - 1]) + 2. * outer_product(axis, last);
  q[0][0] = q[dim - 1][dim - 1] = -1.;
  return q;
}

/// By the leading minors (Sylvester); 2 or 3 dimensions.
template <int dim>
bool is_positive_definite(const dealii::SymmetricTensor<2, dim> &a)
{
  return a[0][0] > 0. && a[0][0] * a[1][1] > a[0][1] * a[0][1] && determinant(a) > 0.;
}
} // namespace

/// The point y = x - m grad phi(y) with what phi is there.
/// The unknowns of the Newton method are y and the multiplier m; at the solution
/// m |grad phi| = n . (x - y) is the signed distance.
template <int dim>
struct LevelSet<dim>::Foot
{
  dealii::Point<dim>     y;
  double                 m = 0.;
  double                 value;
  dealii::Tensor<1, dim> gradient;
  dealii::Tensor<2, dim> hessian;
  /// inverse of [I + m hessian, gradient; gradient', 0]
  dealii::FullMatrix<double> inverse = dealii::FullMatrix<double>(dim + 1, dim + 1);

  /// How y moves with x.
  dealii::Tensor<2, dim> follow() const
  {
    dealii::Tensor<2, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        result[i][j] = inverse(i, j);
    return result;
  }

  /// Whether the inverse exists and y is a minimum of the distance.
  bool invert();
};

template <int dim>
bool LevelSet<dim>::Foot::invert()
{
  const double length = gradient.norm();
  if (!(length > 0.) || !std::isfinite(length))
    return false;
  const dealii::Tensor<1, dim> n        = gradient / length;
  const auto                   identity = dealii::unit_symmetric_tensor<dim>();
  // y is a minimum of the distance on phi = 0 if I + m H is positive on its tangents; elsewhere,
  // past a centre of curvature, other points of the obstacle are closer.
  const dealii::Tensor<2, dim> across = identity - outer_product(n, n);
  const dealii::Tensor<2, dim> A      = identity + m * hessian;
  const auto                   bend   = symmetrize(across * A * across + outer_product(n, n));
  if (!is_positive_definite(bend - 1e-6 * identity))
    return false;
  // scaled so that all entries are of order one
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
void LevelSet<dim>::evaluate(Foot &foot) const
{
  // The formula is one of coordinates turned to Axis: derivatives are turned back.
  const dealii::Point<dim> local(transpose(rotation) * (foot.y - origin));
  foot.value    = formula.value(local);
  foot.gradient = rotation * formula.gradient(local, step);
  foot.hessian  = rotation * formula.hessian(local, step) * transpose(rotation);
}

/// Along the gradient until phi vanishes, as the first guess.
/// To within a tenth of an element of phi = 0, from where Newton's method takes over.
template <int dim>
bool LevelSet<dim>::descend(const dealii::Point<dim> &x, Foot &foot) const
{
  foot.y = x;
  for (unsigned int i = 0; i < 50; ++i)
    {
      evaluate(foot);
      const double square = foot.gradient.norm_square();
      if (!(square > 0.) || !std::isfinite(square))
        return false;
      // Newton's step for phi = 0 along the gradient.
      const dealii::Tensor<1, dim> move = -foot.value / square * foot.gradient;
      foot.y += move;
      // From y - x + m grad phi = 0, in the direction of the gradient.
      foot.m = (x - foot.y) * foot.gradient / square;
      if (move.norm() < 0.1 * size)
        return true;
    }
  return false;
}

template <int dim>
std::optional<typename LevelSet<dim>::Foot> LevelSet<dim>::foot(const dealii::Point<dim> &x) const
{
  Foot foot;
  if (!descend(x, foot))
    return std::nullopt;
  bool close = false;
  for (unsigned int i = 0; i < 30; ++i)
    {
      evaluate(foot);
      // At every iterate: Newton's matrix has to be regular and to lead to a minimum.
      if (!foot.invert())
        return std::nullopt;
      // Only after another evaluation: distance() takes gradient and Hessian at the foot.
      if (close)
        return foot;
      // The matrix was made with the unit normal in place of the gradient: residual and multiplier
      // are scaled by its length.
      const double           length = foot.gradient.norm();
      const auto             rest   = foot.y - x + foot.m * foot.gradient;
      dealii::Tensor<1, dim> move;
      double                 dm = 0.;
      for (unsigned int k = 0; k < dim; ++k)
        {
          for (unsigned int l = 0; l < dim; ++l)
            move[k] -= foot.inverse(k, l) * rest[l];
          move[k] -= foot.inverse(k, dim) * foot.value / length;
          dm -= foot.inverse(dim, k) * rest[k];
        }
      dm -= foot.inverse(dim, dim) * foot.value / length;
      foot.y += move;
      foot.m += dm / length;
      // quadratic convergence: the next error is below round-off
      close = move.norm() < 1e-9 * size;
    }
  return std::nullopt;
}

template <int dim>
std::optional<ObstacleDistance<dim>> LevelSet<dim>::distance(const dealii::Point<dim> &x) const
{
  const auto found = foot(x);
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
