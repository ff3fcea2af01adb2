#ifndef snug_io_spline_surface_h
#define snug_io_spline_surface_h

#include <snug/shape/face_chart.h>
#include <snug/shape/spline.h>

#include <functional>

namespace snug::io {
/**
 * A cubic B-spline curve (2D) or surface (3D) over the coordinates of a face, with the control
 * points c_ij and the knots of fit_splines(),
 *   S(s, t) = sum_ij B_i(s) B_j(t) c_ij.
 * The control points are numbered with the first axis fastest.
 */
template <int dim>
struct SplineSurface
{
  static constexpr unsigned int degree = 3;

  std::vector<shape::Spline>          axes; ///< over fractions of the coordinates
  std::vector<dealii::Tensor<1, dim>> points;
  double                              deviation = 0.; ///< see fit_splines() [length]

  /// Return the functions that are not zero at @p fractions, with their values.
  std::vector<std::pair<unsigned int, double>>
  functions(const dealii::Tensor<1, dim - 1> &fractions) const;

  dealii::Tensor<1, dim> value(const dealii::Tensor<1, dim - 1> &fractions) const;

  /// Return the distance of a point near value(@p fractions) from the surface, to second order: the
  /// part of the difference at right angles to the surface.
  double distance(const dealii::Tensor<1, dim>     &x,
                  const dealii::Tensor<1, dim - 1> &fractions) const;

  unsigned int n_points() const;

  /// Rows of a matrix of as many columns as control points.
  using Rows = std::vector<std::vector<std::pair<unsigned int, double>>>;

  /// Return the rows of the second differences of adjacent control points along each axis, divided
  /// differences over the Greville abscissae.
  Rows second_differences() const;

  unsigned int n_spans(unsigned int axis) const { return axes[axis].breaks().size() - 1; }
};

/// A face of a design, or the curve of a face that is swept, as points over coordinates.
template <int dim>
struct CoordinatePoints
{
  using Flat = dealii::Tensor<1, dim - 1>;

  Flat                      range; ///< of the coordinates, from 0
  std::array<bool, dim - 1> closed;
  /// function that returns the point at coordinates, or nothing outside of the face
  std::function<std::optional<dealii::Tensor<1, dim>>(const Flat &)> point;
};

/// Return the points of the surface that contact uses: the interpolation of its @p positions, which
/// are positions of the points of the chart in the design. The arguments must outlive the result.
template <int dim>
CoordinatePoints<dim> points_of(const shape::FaceChart<dim>               &chart,
                                const std::vector<dealii::Tensor<1, dim>> &positions);

/**
 * Return the B-spline surface of a designed face.
 *
 * Each knot span has 4 x 4 Gauss points, of which those on the face determine the control points by
 * least squares. Control points of spans without a part of the face continue the surface with
 * minimal second differences. The deviation is the maximum distance of the B-spline surface from
 * the face at 10 random points of each span (fixed seed). Spans with a deviation above @p tolerance
 * are divided in the directions in which the third derivatives jump, until no span deviates more or
 * the surface has @p most_points control points.
 */
template <int dim>
SplineSurface<dim>
fit_splines(const CoordinatePoints<dim> &face, double tolerance, unsigned int most_points);
} // namespace snug::io

#endif
