#ifndef snug_shape_spline_h
#define snug_shape_spline_h

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace snug::shape {
/// The coefficients of a linear combination of control points.
using Combination = std::map<unsigned int, double>;

/**
 * The n B-splines of degree p on the uniform clamped knots
 *   0 (p+1 times), 1/(n-p), .., (n-p-1)/(n-p), 1 (p+1 times),
 * by the recurrence of Cox and de Boor (C. de Boor, A Practical Guide to
 * Splines, Springer, 1978). The splines are not negative and sum to 1. At s = 0 only the first
 * spline differs from zero, and at s = 1 only the last spline. With n = p + 1, a single span,
 * the splines are the Bernstein polynomials of degree p.
 *
 * Closed splines have the period 1. With uniform knots of the distance 1/n, closed spline i is
 * symmetric about i/n, so that a shift of s by 1/n renumbers the splines.
 */
class Spline
{
public:
  /// Construct uniform knots. @p degree < @p n.
  Spline(unsigned int n, unsigned int degree, bool closed = false);

  /// Construct splines on spans between the numbers @p breaks, which ascend from 0 to 1. Closed
  /// spline i differs from zero from breaks i - degree to i + 1.
  Spline(const std::vector<double> &breaks, unsigned int degree, bool closed = false);

  unsigned int n() const { return size; }
  unsigned int degree() const { return p; }
  bool         is_closed() const { return closed; }

  /// Return the ends of the spans, from 0 to 1.
  std::vector<double> breaks() const { return {knots.begin() + p, knots.end() - p}; }

  /// Return the values at @p s in [0,1] of the degree + 1 consecutive splines that begin with
  /// number .first. All other splines are zero at @p s. The numbers of closed splines are taken
  /// modulo n.
  std::pair<unsigned int, std::vector<double>> values(double s) const;

  /// Return the Greville abscissa of spline @p i, the mean of the inner knots of the spline, with
  /// sum_i greville(i) B_i(s) = s for clamped knots. For p = 0, return the middle of the span.
  double greville(unsigned int i) const;

  /// Return the control points of the derivative of order @p order, each as a combination of the
  /// control points of the function. They are control points of a spline of degree p - order, whose
  /// values lie between the minimum and the maximum of its control points. @p order <= p.
  std::vector<Combination> derivative(unsigned int order) const;

private:
  unsigned int        size, p;
  bool                closed;
  double              shift = 0.; ///< s of the knot 0
  std::vector<double> knots;
};

/**
 * The splines along one axis of a net. With a smooth end, the function is continued beyond that
 * end as an even function, so that its slope at the end is zero: with the clamped or closed splines
 * B of the mirrored axis and the pairs of mirrored control points i, i',
 *   B_i^even(s) = B_i(s) + B_i'(s).
 * The axis with n control points and one smooth end is half of an axis with 2n - 1 control points.
 * The axis with two smooth ends is half of a closed axis with 2n - 2 control points.
 */
class SplineAxis
{
public:
  /// Properties of the two ends.
  struct Ends
  {
    bool                closed = false;
    std::array<bool, 2> smooth = {{false, false}};
  };

  SplineAxis(unsigned int n, unsigned int degree, const Ends &ends);

  unsigned int n() const { return size; }
  unsigned int degree() const { return splines.degree(); }

  /// Return whether side 0 or 1 of the axis is a border of the face: not closed, and not smooth.
  bool is_border(unsigned int side) const { return !ends.closed && !ends.smooth[side]; }

  /// Return numbers and values at @p s in [0,1] of the splines that are not zero there.
  std::vector<std::pair<unsigned int, double>> values(double s) const;

  double greville(unsigned int i) const;

  /// Return the control points of the derivative with respect to s, see Spline::derivative().
  std::vector<Combination> derivative(unsigned int order) const;

private:
  /// Return the splines of the whole axis, of which this axis may be a half.
  static Spline whole(unsigned int n, unsigned int degree, const Ends &ends);
  /// Return the position on the axis of the splines of a position on this axis.
  double to_whole(double s) const;
  /// Return the control point of a control point of the axis of the splines.
  unsigned int folded(unsigned int i) const;

  unsigned int size;
  Ends         ends;
  Spline       splines;
};

/// Products of splines over [0,1]^m, numbered with the first axis fastest.
class SplineNet
{
public:
  /// Construct B-splines of @p degree along axes with @p n control points each. The degree
  /// 0 stands for one span, that is the degree n - 1. Splines are constant along an axis with one
  /// control point. Without @p ends, all axes are clamped.
  SplineNet(const std::vector<unsigned int>     &n,
            unsigned int                         degree,
            const std::vector<SplineAxis::Ends> &ends = {});

  unsigned int n_axes() const { return axes.size(); }

  unsigned int n_points() const;

  unsigned int degree(unsigned int axis) const { return axes[axis].degree(); }

  /// Return the control points whose functions are not zero at @p s, with the values.
  std::vector<std::pair<unsigned int, double>> values(const std::vector<double> &s) const;

  /// Return the index of control point @p i along each axis.
  std::vector<unsigned int> indices(unsigned int i) const;

  /// Return the Greville abscissae of control point @p i.
  std::vector<double> greville(unsigned int i) const;

  /// Return whether control point @p i is on a border of the face: first or last along an axis
  /// with several points, at an end that is neither closed nor smooth.
  bool on_border(unsigned int i) const;

  /// Return whether control point @p i is the first (@p side 0) or last (1) along
  /// @p axis.
  bool on_side(unsigned int i, unsigned int axis, unsigned int side) const;

  /// Return the control points of the derivative along @p axis, see Spline::derivative().
  std::vector<Combination> derivative(unsigned int axis, unsigned int order) const;

private:
  std::vector<SplineAxis> axes;
};
} // namespace snug::shape

#endif
