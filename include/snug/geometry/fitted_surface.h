#ifndef snug_geometry_fitted_surface_h
#define snug_geometry_fitted_surface_h

#include <snug/geometry/known_surface.h>

#include <deal.II/lac/full_matrix.h>

#include <optional>
#include <string>
#include <vector>

namespace snug::geometry {
/// Points of a surface, and normals out of the body near some of them.
template <int dim>
struct SurfaceSample
{
  using Point = dealii::Point<dim>;

  std::vector<Point>                  points;
  std::vector<Point>                  at; ///< of the normals
  std::vector<dealii::Tensor<1, dim>> normals;

  /// Of the points from @p surface.
  double largest_distance(const KnownSurface<dim> &surface) const;

  /// @p surface, convex or not as the normals say.
  KnownSurface<dim> faced(KnownSurface<dim> surface) const;
};

/// (A + 1e-14 tr(A) I)^-1 for the matrix @p A of normal equations, which may be singular: what the
/// points do not tell stays small. Zeros if A is zero or not finite.
dealii::FullMatrix<double> inverse_of_squares(dealii::FullMatrix<double> A);

/**
 * The sphere or, with a unit vector @p axis, the cylinder that fits the points best: least squares
 * of |x|^2 = 2 c.x + (R^2 - |c|^2) in the centre c and R.
 */
template <int dim>
KnownSurface<dim> fitted_round(const SurfaceSample<dim>     &sample,
                               const dealii::Tensor<1, dim> &axis);

/**
 * The surface of the entry "Curved faces = boundary: value", where @p value is "sphere" or, in
 * 3D, "cylinder AXIS" with the axis x, y or z; in 2D both are circles, the axis is z.
 * @throws InputError naming the entry if @p value is none of these, or a point is off by more
 *   than 1e-4 R.
 */
template <int dim>
KnownSurface<dim> fitted_surface(const std::string        &boundary,
                                 const std::string        &value,
                                 const SurfaceSample<dim> &sample);

/// The sphere, cylinder, cone or torus, the first of these, from which no point is farther than
/// @p tolerance. None for fewer points than 3/2 of its unknown numbers.
template <int dim>
std::optional<KnownSurface<dim>> recognized_surface(const SurfaceSample<dim> &sample,
                                                    double                    tolerance);

/// "cylinder of radius 10", in 2D "circle".
template <int dim>
std::string describe(const KnownSurface<dim> &surface);
} // namespace snug::geometry

#endif
