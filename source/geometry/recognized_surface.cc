#include <snug/geometry/fitted_surface.h>

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace snug::geometry {
namespace {
template <int dim>
using Kind   = typename KnownSurface<dim>::Kind;
using Vector = dealii::Tensor<1, 3>;
using Point  = dealii::Point<3>;

/// Return the vector of length 1 with the minimum x'Ax, found by inverse iteration.
dealii::Vector<double> smallest_eigenvector(const dealii::FullMatrix<double> &A)
{
  const unsigned int     n = A.m();
  dealii::Vector<double> x(n), next(n);
  for (unsigned int i = 0; i < n; ++i)
    x(i) = 1. + 0.3 * i; // lies in no symmetry plane of common parts
  const auto inverse = inverse_of_squares(A);
  for (unsigned int turn = 0; turn < 30; ++turn)
    {
      inverse.vmult(next, x);
      const double length = next.l2_norm();
      if (!(length > 0.))
        break;
      x.equ(1. / length, next);
    }
  return x;
}

dealii::FullMatrix<double> sum_of_squares(const std::vector<dealii::Vector<double>> &rows)
{
  const unsigned int         n = rows.front().size();
  dealii::FullMatrix<double> A(n, n);
  for (const auto &row : rows)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        A(i, j) += row(i) * row(j);
  return A;
}

/// Return the direction along which the components of all normals are nearly equal to the
/// component of @p mean.
Vector common_direction(const std::vector<Vector> &normals, const Vector &mean)
{
  std::vector<dealii::Vector<double>> rows;
  for (const auto &n : normals)
    {
      const Vector d = n - mean;
      rows.emplace_back(3);
      for (unsigned int i = 0; i < 3; ++i)
        rows.back()(i) = d[i];
    }
  const auto x = smallest_eigenvector(sum_of_squares(rows));
  return Vector({x(0), x(1), x(2)});
}

template <typename T>
T mean_of(const std::vector<T> &values)
{
  T sum;
  for (const auto &value : values)
    sum += value;
  return T(sum / double(values.size()));
}

KnownSurface<3> start_cylinder(const SurfaceSample<3> &sample)
{
  return fitted_round(sample, common_direction(sample.normals, Vector()));
}

/// Return the start of the fit of a cone. The tangent planes of a cone meet at the apex.
KnownSurface<3> start_cone(const SurfaceSample<3> &sample)
{
  KnownSurface<3> cone;
  cone.kind                       = Kind<3>::cone;
  cone.axis                       = common_direction(sample.normals, mean_of(sample.normals));
  const Point                mean = mean_of(sample.points);
  dealii::FullMatrix<double> A(3, 3);
  dealii::Vector<double>     b(3), apex(3);
  for (unsigned int k = 0; k < sample.at.size(); ++k)
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int j = 0; j < 3; ++j)
          A(i, j) += sample.normals[k][i] * sample.normals[k][j];
        b(i) += sample.normals[k][i] * (sample.normals[k] * (sample.at[k] - mean));
      }
  inverse_of_squares(A).vmult(apex, b);
  cone.centre = mean + Vector({apex(0), apex(1), apex(2)});
  if (cone.axis * (mean - cone.centre) < 0.)
    cone.axis *= -1.;
  for (const auto &x : sample.points)
    {
      const double along = (x - cone.centre) * cone.axis;
      cone.angle += std::atan2((x - cone.centre - along * cone.axis).norm(), along) /
                    double(sample.points.size());
    }
  return cone;
}

/// Return the start of the fit of a torus. The normals of a surface of revolution meet its axis:
/// n.m + (x x n).a = 0 with the direction a and the moment m of the axis (Pottmann, Wallner,
/// Computational Line Geometry, 2001). Points rotated into a plane through the axis lie on a
/// circle.
KnownSurface<3> start_torus(const SurfaceSample<3> &sample)
{
  const Point                         mean = mean_of(sample.points);
  const double                        size = std::max(1e-300, mean.distance(sample.points.front()));
  std::vector<dealii::Vector<double>> rows;
  for (unsigned int k = 0; k < sample.at.size(); ++k)
    {
      const Vector moment = cross_product_3d((sample.at[k] - mean) / size, sample.normals[k]);
      rows.emplace_back(6);
      for (unsigned int i = 0; i < 3; ++i)
        {
          rows.back()(i)     = moment[i];
          rows.back()(3 + i) = sample.normals[k][i];
        }
    }
  const auto      x = smallest_eigenvector(sum_of_squares(rows));
  const Vector    a({x(0), x(1), x(2)}), m({x(3), x(4), x(5)});
  KnownSurface<3> torus;
  torus.kind            = Kind<3>::torus;
  torus.axis            = a / a.norm();
  const Point      foot = mean + size * cross_product_3d(a, m) / a.norm_square();
  SurfaceSample<2> section;
  for (const auto &point : sample.points)
    {
      const double along = (point - foot) * torus.axis;
      section.points.emplace_back((point - foot - along * torus.axis).norm(), along);
    }
  const auto circle = fitted_round(section, {});
  torus.centre      = foot + circle.centre[1] * torus.axis;
  torus.radius      = circle.centre[0];
  torus.tube        = circle.radius;
  return torus;
}

/// Return @p surface with centre, axis, radius, tube and angle moved by @p step, in this order.
template <int dim>
KnownSurface<dim> moved(KnownSurface<dim> surface, const dealii::Vector<double> &step)
{
  for (unsigned int d = 0; d < dim; ++d)
    {
      surface.centre[d] += step(d);
      surface.axis[d] += step(dim + d);
    }
  if (surface.kind != Kind<dim>::sphere)
    surface.axis /= surface.axis.norm();
  surface.radius += step(2 * dim);
  surface.tube += step(2 * dim + 1);
  surface.angle += step(2 * dim + 2);
  return surface;
}

/// Return the least-squares fit of the distances by the Gauss-Newton method, started at @p surface.
/// Parameters that have no influence on the distances are not changed.
template <int dim>
KnownSurface<dim> refined_fit(const SurfaceSample<dim> &sample, KnownSurface<dim> surface)
{
  const unsigned int n    = 2 * dim + 3;
  const double       size = surface.kind == Kind<dim>::cone
                              ? surface.centre.distance(sample.points.front())
                              : surface.radius + surface.tube;
  // A failed start has no finite distances, and no step is made.
  for (unsigned int turn = 0; turn < 20 && std::isfinite(sample.largest_distance(surface)); ++turn)
    {
      dealii::FullMatrix<double> J(sample.points.size(), n);
      dealii::Vector<double>     step(n), b(n);
      std::vector<double>        unit(n, size);
      // The units of the axis and the angle are radians.
      std::fill_n(unit.begin() + dim, dim, 1.);
      unit[n - 1] = 1.;
      for (unsigned int j = 0; j < n; ++j)
        {
          step          = 0.;
          step(j)       = 1e-5 * unit[j];
          const auto up = moved(surface, step);
          step(j) *= -1.;
          const auto down = moved(surface, step);
          for (unsigned int i = 0; i < sample.points.size(); ++i)
            J(i, j) =
              (up.distance(sample.points[i]) - down.distance(sample.points[i])) / (2e-5 * size);
        }
      dealii::FullMatrix<double> A(n, n);
      J.Tmmult(A, J);
      dealii::Vector<double> d(sample.points.size());
      for (unsigned int i = 0; i < d.size(); ++i)
        d(i) = -surface.distance(sample.points[i]) / size;
      J.Tvmult(b, d);
      inverse_of_squares(A).vmult(step, b);
      const double change = step.l2_norm();
      for (unsigned int j = 0; j < n; ++j)
        step(j) *= unit[j];
      surface = moved(surface, step);
      if (!(change > 1e-15 && change < 1.))
        break;
    }
  return surface;
}

/// Return every n-th point and normal, for the first steps of the fit.
template <int dim>
SurfaceSample<dim> subsampled(const SurfaceSample<dim> &sample)
{
  const std::size_t  most = 400;
  SurfaceSample<dim> result;
  for (std::size_t i = 0; i < sample.points.size(); i += 1 + sample.points.size() / most)
    result.points.push_back(sample.points[i]);
  for (std::size_t i = 0; i < sample.at.size(); i += 1 + sample.at.size() / most)
    {
      result.at.push_back(sample.at[i]);
      result.normals.push_back(sample.normals[i]);
    }
  return result;
}

template <int dim>
std::optional<KnownSurface<dim>> confirmed(const SurfaceSample<dim> &sample,
                                           const SurfaceSample<dim> &few,
                                           KnownSurface<dim>         surface,
                                           double                    tolerance)
{
  surface = refined_fit(few, surface);
  if (!(few.largest_distance(surface) <= tolerance))
    return {};
  if (few.points.size() < sample.points.size())
    surface = refined_fit(sample, surface);
  surface = few.oriented(surface);
  if (!(sample.largest_distance(surface) <= tolerance))
    return {};
  return surface;
}
} // namespace

template <>
std::optional<KnownSurface<2>> recognized_surface(const SurfaceSample<2> &sample, double tolerance)
{
  if (sample.points.size() < 5)
    return {};
  const auto few = subsampled(sample);
  return confirmed(sample, few, fitted_round(few, {}), tolerance);
}

template <>
std::optional<KnownSurface<3>> recognized_surface(const SurfaceSample<3> &sample, double tolerance)
{
  const auto few   = subsampled(sample);
  const auto n     = sample.points.size();
  auto       found = std::optional<KnownSurface<3>>();
  if (n >= 6)
    found = confirmed(sample, few, fitted_round(few, {}), tolerance);
  if (!found && n >= 8)
    found = confirmed(sample, few, start_cylinder(few), tolerance);
  if (!found && n >= 9)
    found = confirmed(sample, few, start_cone(few), tolerance);
  if (!found && n >= 11)
    found = confirmed(sample, few, start_torus(few), tolerance);
  return found;
}
} // namespace snug::geometry
