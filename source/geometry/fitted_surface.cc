#include <snug/geometry/fitted_surface.h>

#include <deal.II/lac/vector.h>

#include <sstream>

namespace snug::geometry {
template <int dim>
double SurfaceSample<dim>::largest_distance(const KnownSurface<dim> &surface) const
{
  double largest = 0.;
  for (const auto &point : points)
    {
      const double distance = std::abs(surface.distance(point));
      // The distance from a surface of a failed fit is not finite.
      largest = std::isfinite(distance) ? std::max(largest, distance) : HUGE_VAL;
    }
  return largest;
}

template <int dim>
KnownSurface<dim> SurfaceSample<dim>::oriented(KnownSurface<dim> surface) const
{
  surface.encloses_body = true;
  double sum            = 0.;
  for (unsigned int i = 0; i < at.size(); ++i)
    sum += normals[i] * surface.normal(at[i]);
  surface.encloses_body = sum >= 0.;
  return surface;
}

// The shift is needed because the inverse of deal.II asserts a regular matrix in Debug mode and
// divides by zero in Release mode.
dealii::FullMatrix<double> inverse_of_squares(dealii::FullMatrix<double> A)
{
  const double shift = 1e-14 * A.trace();
  if (!(shift > 0. && std::isfinite(shift)))
    return dealii::FullMatrix<double>(A.m(), A.m());
  for (unsigned int i = 0; i < A.m(); ++i)
    A(i, i) += shift;
  A.gauss_jordan();
  return A;
}

template <int dim>
KnownSurface<dim> fitted_round(const SurfaceSample<dim> &sample, const dealii::Tensor<1, dim> &axis)
{
  // Coordinates are relative to the mean and in units of the size. The normal equations contain
  // squares of the coordinates and thus stay well conditioned for small surfaces far from the
  // origin.
  const auto        &points = sample.points;
  dealii::Point<dim> mean;
  for (const auto &point : points)
    mean += point / double(points.size());
  double size = 0.;
  for (const auto &point : points)
    size = std::max(size, mean.distance(point));
  // The unknowns are the centre, whose component along the axis is kept at 0, and R^2 - |c|^2.
  dealii::FullMatrix<double> A(dim + 1, dim + 1);
  dealii::Vector<double>     b(dim + 1), x(dim + 1);
  for (const auto &point : points)
    {
      dealii::Tensor<1, dim> y = (point - mean) / size;
      y -= (y * axis) * axis;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          const double left = i < dim ? 2. * y[i] : 1.;
          for (unsigned int j = 0; j <= dim; ++j)
            A(i, j) += left * (j < dim ? 2. * y[j] : 1.);
          b(i) += left * y.norm_square();
        }
    }
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      A(i, j) += axis[i] * axis[j] * points.size();
  // A x = b are the normal equations of 2 c.y + (R^2 - |c|^2) = |y|^2 over all points. For flat
  // boundaries A is singular, and callers reject the result.
  inverse_of_squares(A).vmult(x, b);
  KnownSurface<dim> result;
  result.kind =
    axis.norm() > 0. ? KnownSurface<dim>::Kind::cylinder : KnownSurface<dim>::Kind::sphere;
  result.axis   = axis;
  result.centre = mean;
  // The radius follows from R^2 = (R^2 - |c|^2) + |c|^2.
  double square = x(dim);
  for (unsigned int d = 0; d < dim; ++d)
    {
      result.centre[d] += size * x(d);
      square += x(d) * x(d);
    }
  result.radius = size * std::sqrt(square);
  return sample.oriented(result);
}

template <int dim>
std::string describe(const KnownSurface<dim> &surface)
{
  using Kind = typename KnownSurface<dim>::Kind;
  std::ostringstream text;
  text << surface.name() << " of ";
  if (surface.kind == Kind::cone)
    text << surface.angle * 180. / M_PI << " degrees to its axis";
  else if (surface.kind == Kind::torus)
    text << "radii " << surface.radius << " and " << surface.tube;
  else
    text << "radius " << surface.radius;
  return text.str();
}

template struct SurfaceSample<2>;
template struct SurfaceSample<3>;
template KnownSurface<2> fitted_round(const SurfaceSample<2> &, const dealii::Tensor<1, 2> &);
template KnownSurface<3> fitted_round(const SurfaceSample<3> &, const dealii::Tensor<1, 3> &);
template std::string     describe(const KnownSurface<2> &);
template std::string     describe(const KnownSurface<3> &);
} // namespace snug::geometry
