#ifndef snug_geometry_fitted_surface_h
#define snug_geometry_fitted_surface_h

#include <snug/geometry/known_surface.h>

#include <deal.II/lac/full_matrix.h>

#include <optional>
#include <string>
#include <vector>

namespace snug::geometry {
/// Points of a surface, and outward normals of the body at some positions near the points.
template <int dim>
struct SurfaceSample
{
  using Point = dealii::Point<dim>;

  std::vector<Point>                  points;
  std::vector<Point>                  at; ///< positions of the normals
  std::vector<dealii::Tensor<1, dim>> normals;

  /// Return the maximum distance of the points from @p surface.
  double largest_distance(const KnownSurface<dim> &surface) const;

  /// Return @p surface with the member encloses_body set according to the normals.
  KnownSurface<dim> oriented(KnownSurface<dim> surface) const;
};

/// Return (A + 1e-14 tr(A) I)^-1 for the matrix @p A of normal equations, which may be singular.
/// The shift keeps unknowns small that the points do not determine. Return the zero matrix if A is
/// zero or not finite.
dealii::FullMatrix<double> inverse_of_squares(dealii::FullMatrix<double> A);

/**
 * Return the sphere or, with a unit vector @p axis, the cylinder that fits the points best. The
 * fit is the least-squares solution of |x|^2 = 2 c.x + (R^2 - |c|^2) for the centre c and R.
 */
template <int dim>
KnownSurface<dim> fitted_round(const SurfaceSample<dim>     &sample,
                               const dealii::Tensor<1, dim> &axis);

/// Return the first of sphere, cylinder, cone and torus from which no point is farther than
/// @p tolerance. A surface is not tried with fewer points than 3/2 of the number of its unknowns.
template <int dim>
std::optional<KnownSurface<dim>> recognized_surface(const SurfaceSample<dim> &sample,
                                                    double                    tolerance);

/// Return a description such as "cylinder of radius 10", in 2D "circle of radius 10".
template <int dim>
std::string describe(const KnownSurface<dim> &surface);
} // namespace snug::geometry

#endif
