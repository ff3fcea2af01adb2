#ifndef snug_shape_spline_h
#define snug_shape_spline_h

#include <utility>
#include <vector>

namespace snug::shape {
/**
 * The n B-splines of degree p on the uniform clamped knots
 *   0 (p+1 times), 1/(n-p), .., (n-p-1)/(n-p), 1 (p+1 times),
 * by the recurrence of Cox and de Boor (C. de Boor, A Practical Guide to
 * Splines, Springer, 1978). The splines are not negative and sum to 1. At s = 0 only the first
 * spline differs from zero, and at s = 1 only the last spline. With n = p + 1, a single span,
 * the splines are the Bernstein polynomials of degree p.
 */
class Spline
{
public:
  /// Construct the knots. @p degree < @p n.
  Spline(unsigned int n, unsigned int degree);

  unsigned int n() const { return size; }

  /// Return the values at @p s in [0,1] of the degree + 1 consecutive splines that begin with
  /// number .first. All other splines are zero at @p s.
  std::pair<unsigned int, std::vector<double>> values(double s) const;

  /// Return the Greville abscissa of spline @p i, the mean of the inner knots of the spline, with
  /// sum_i greville(i) B_i(s) = s. For p = 0, return the middle of the span.
  double greville(unsigned int i) const;

private:
  unsigned int        size, degree;
  std::vector<double> knots;
};

/// Products of splines over [0,1]^m, numbered with the first axis fastest.
class SplineNet
{
public:
  /// Construct B-splines of @p degree along axes with @p n control points each. The degree
  /// 0 stands for one span, that is the degree n - 1. Splines are constant along an axis with one
  /// control point.
  SplineNet(const std::vector<unsigned int> &n, unsigned int degree);

  unsigned int n_axes() const { return axes.size(); }

  unsigned int n_points() const;

  /// Return the control points whose functions are not zero at @p s, with the values.
  std::vector<std::pair<unsigned int, double>> values(const std::vector<double> &s) const;

  /// Return the index of control point @p i along each axis.
  std::vector<unsigned int> indices(unsigned int i) const;

  /// Return the Greville abscissae of control point @p i.
  std::vector<double> greville(unsigned int i) const;

  /// Return whether control point @p i is the first or last along an axis with several points.
  bool on_border(unsigned int i) const;

  /// Return whether control point @p i is the first (@p side 0) or last (1) along
  /// @p axis.
  bool on_side(unsigned int i, unsigned int axis, unsigned int side) const;

private:
  std::vector<Spline> axes;
};
} // namespace snug::shape

#endif
