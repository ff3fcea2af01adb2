#ifndef snug_shape_spline_h
#define snug_shape_spline_h

#include <utility>
#include <vector>

namespace snug::shape {
/**
 * The n B-splines of degree p on the uniform clamped knots
 *   0 (p+1 times), 1/(n-p), .., (n-p-1)/(n-p), 1 (p+1 times),
 * by the recurrence of Cox and de Boor (C. de Boor, A Practical Guide to
 * Splines, Springer, 1978). They are not negative and sum to 1; at s = 0
 * and s = 1 only the first and the last differ from zero. With n = p + 1,
 * a single span, they are the Bernstein polynomials of degree p.
 */
class Spline
{
public:
  /// @p degree < @p n.
  Spline(unsigned int n, unsigned int degree);

  unsigned int n() const { return size; }

  /// Values at @p s in [0,1] of the degree + 1 splines from number
  /// .first on; the others are zero there.
  std::pair<unsigned int, std::vector<double>> values(double s) const;

  /// Greville abscissa of spline @p i, the mean of its inner knots:
  /// sum_i greville(i) B_i(s) = s. 1/2 where p = 0.
  double greville(unsigned int i) const;

private:
  unsigned int        size, degree;
  std::vector<double> knots;
};

/// Products of splines over [0,1]^m, the first axis fastest.
class SplineNet
{
public:
  /// B-splines of @p degree along axes of @p n control points each; degree
  /// 0 stands for one span, n - 1.
  SplineNet(const std::vector<unsigned int> &n, unsigned int degree);

  unsigned int n_axes() const { return axes.size(); }

  unsigned int n_points() const;

  /// The control points that are not zero at @p s, with their values.
  std::vector<std::pair<unsigned int, double>> values(const std::vector<double> &s) const;

  /// Index of control point @p i along each axis.
  std::vector<unsigned int> indices(unsigned int i) const;

  /// Greville abscissae of control point @p i.
  std::vector<double> greville(unsigned int i) const;

  /// Whether control point @p i is the first or last along an axis.
  bool on_border(unsigned int i) const;

  /// Whether control point @p i is the first (@p side 0) or last (1) along
  /// @p axis.
  bool on_side(unsigned int i, unsigned int axis, unsigned int side) const;

private:
  std::vector<Spline> axes;
};
} // namespace snug::shape

#endif
