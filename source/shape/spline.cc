#include <snug/base/assertions.h>
#include <snug/shape/spline.h>


#include <algorithm>
#include <cmath>

namespace snug::shape {
namespace {
std::vector<double> uniform_breaks(const unsigned int n_spans)
{
  std::vector<double> breaks;
  for (unsigned int i = 0; i <= n_spans; ++i)
    breaks.push_back(double(i) / n_spans);
  return breaks;
}
} // namespace

Spline::Spline(const unsigned int n, const unsigned int degree, const bool closed)
  : Spline(uniform_breaks(closed ? n : n - degree), degree, closed)
{
  // Otherwise uniform closed spline i is symmetric about (i - (degree - 1) / 2) / n.
  shift = closed ? (degree - 1.) / (2. * n) : 0.;
}

Spline::Spline(const std::vector<double> &breaks, const unsigned int degree, const bool closed)
  : size(breaks.size() - 1 + (closed ? 0 : degree)), p(degree), closed(closed)
{
  SNUG_ASSERT(breaks.size() > 1 && breaks.front() == 0. && breaks.back() == 1.,
              "the spans of a spline go from 0 to 1");
  if (closed)
    {
      const int n = size, degree_of_knots = degree;
      for (int i = -degree_of_knots; i <= n + degree_of_knots; ++i)
        {
          const int period = i < 0 ? -((n - 1 - i) / n) : i / n;
          knots.push_back(breaks[i - period * n] + period);
        }
      return;
    }
  // The end knots are repeated degree + 1 times (clamped knots), so that only the end control
  // point acts at an end.
  knots.assign(degree, 0.);
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), degree, 1.);
}

/// The recurrence of Cox and de Boor is applied to all p + 1 nonzero splines at once, in
/// place: B_i^p = (s - t_i) / (t_(i+p) - t_i) B_i^(p-1)
///       + (t_(i+p+1) - s) / (t_(i+p+1) - t_(i+1)) B_(i+1)^(p-1).
/// All terms are non-negative, so that no digits cancel.
std::pair<unsigned int, std::vector<double>> Spline::values(double s) const
{
  if (closed)
    {
      s -= shift;
      s -= std::floor(s);
    }
  // The span satisfies knots[span] <= s < knots[span + 1]. The last span contains s = 1.
  const auto          end  = knots.begin() + (closed ? size + p : size);
  const unsigned int  span = std::upper_bound(knots.begin() + p, end, s) - knots.begin() - 1;
  std::vector<double> values(p + 1, 0.);
  values[0] = 1.;
  for (unsigned int q = 1; q <= p; ++q)
    {
      double saved = 0.;
      for (unsigned int r = 0; r < q; ++r)
        {
          const double left  = knots[span + 1 + r - q];
          const double right = knots[span + 1 + r];
          // left <= knots[span] < knots[span + 1] <= right, so right - left is never zero.
          const double part = values[r] / (right - left);
          values[r]         = saved + (right - s) * part;
          saved             = (s - left) * part;
        }
      values[q] = saved;
    }
  return {span - p, values};
}

/// For degree 0 the result is the middle of the span, because there is no inner knot.
double Spline::greville(const unsigned int i) const
{
  if (shift != 0.) // without round-off
    return double(i) / size;
  if (p == 0)
    return (knots[i] + knots[i + 1]) / 2.;
  double sum = 0.;
  for (unsigned int k = 1; k <= p; ++k)
    sum += knots[i + k];
  return sum / p - (closed ? std::floor(sum / p) : 0.);
}

/// The derivative of sum_i c_i B_i^p is sum_i p (c_(i+1) - c_i) / (t_(i+p+1) - t_(i+1)) B_i^(p-1)
/// on the knots without the first and the last one (de Boor, 1978).
std::vector<Combination> Spline::derivative(const unsigned int order) const
{
  SNUG_ASSERT(order <= p, "the order of the derivative exceeds the degree");
  std::vector<Combination> points;
  for (unsigned int i = 0; i + p + 1 < knots.size(); ++i)
    points.push_back({{i % size, 1.}});
  for (unsigned int r = 1; r <= order; ++r)
    {
      const unsigned int q = p + 1 - r;
      for (unsigned int i = 0; i + 1 < points.size(); ++i)
        {
          const double factor = q / (knots[i + q + r] - knots[i + r]);
          Combination  difference;
          for (const auto &[point, weight] : points[i + 1])
            difference[point] += factor * weight;
          for (const auto &[point, weight] : points[i])
            difference[point] -= factor * weight;
          points[i] = difference;
        }
      points.pop_back();
    }
  if (closed) // the control points repeat after one period
    points.resize(size);
  return points;
}

SplineAxis::SplineAxis(const unsigned int n, const unsigned int degree, const Ends &ends)
  : size(n), ends(n == 1 ? Ends() : ends), splines(whole(n, degree, this->ends))
{}

Spline SplineAxis::whole(const unsigned int n, const unsigned int degree, const Ends &ends)
{
  const auto [lower, upper] = ends.smooth;
  const unsigned int points = lower && upper ? 2 * n - 2 : lower || upper ? 2 * n - 1 : n;
  // The degree 0 stands for one span. A single control point moves all points by the same amount.
  const unsigned int p = degree == 0 || n == 1 ? points - 1 : degree;
  return Spline(points, p, ends.closed || (lower && upper));
}

double SplineAxis::to_whole(const double s) const
{
  // With a smooth lower end alone, this axis is the upper half of the axis of the splines.
  return ends.smooth[1] ? s / 2. : ends.smooth[0] ? (1. + s) / 2. : s;
}

unsigned int SplineAxis::folded(const unsigned int i) const
{
  if (ends.smooth[1])
    return i < size ? i : 2 * size - 2 - i;
  if (ends.smooth[0])
    return i < size ? size - 1 - i : i - (size - 1);
  return i;
}

std::vector<std::pair<unsigned int, double>> SplineAxis::values(const double s) const
{
  const auto                                   along = splines.values(to_whole(s));
  std::vector<std::pair<unsigned int, double>> result;
  for (unsigned int k = 0; k < along.second.size(); ++k)
    result.emplace_back(folded((along.first + k) % splines.n()), along.second[k]);
  return result;
}

double SplineAxis::greville(const unsigned int i) const
{
  if (ends.smooth[1])
    return 2. * splines.greville(i);
  if (ends.smooth[0])
    return 2. * splines.greville(i + size - 1) - 1.;
  return splines.greville(i);
}

std::vector<Combination> SplineAxis::derivative(const unsigned int order) const
{
  std::vector<Combination> result;
  for (const auto &of_whole : splines.derivative(order))
    {
      Combination point;
      for (const auto &[i, weight] : of_whole)
        point[folded(i)] += weight * std::pow(to_whole(1.) - to_whole(0.), order);
      result.push_back(point);
    }
  return result;
}

SplineNet::SplineNet(const std::vector<unsigned int>     &n,
                     const unsigned int                   degree,
                     const std::vector<SplineAxis::Ends> &ends)
{
  for (unsigned int axis = 0; axis < n.size(); ++axis)
    axes.emplace_back(n[axis], degree, ends.empty() ? SplineAxis::Ends() : ends[axis]);
}

unsigned int SplineNet::n_points() const
{
  unsigned int product = 1;
  for (const SplineAxis &axis : axes)
    product *= axis.n();
  return product;
}

std::vector<std::pair<unsigned int, double>> SplineNet::values(const std::vector<double> &s) const
{
  SNUG_ASSERT_EQUAL(s.size(), n_axes());
  std::vector<std::pair<unsigned int, double>> products = {{0, 1.}};
  unsigned int                                 stride   = 1;
  for (unsigned int axis = 0; axis < n_axes(); ++axis)
    {
      const auto                                   along = axes[axis].values(s[axis]);
      std::vector<std::pair<unsigned int, double>> longer;
      for (const auto &value : along)
        for (const auto &product : products)
          // The first axis is fastest, so the products of the axes before stay consecutive.
          longer.emplace_back(product.first + stride * value.first, product.second * value.second);
      products = longer;
      stride *= axes[axis].n();
    }
  return products;
}

/// The indices satisfy i = i_0 + n_0 (i_1 + n_1 (i_2 + ..)).
std::vector<unsigned int> SplineNet::indices(unsigned int i) const
{
  std::vector<unsigned int> result;
  for (const SplineAxis &axis : axes)
    {
      result.push_back(i % axis.n());
      i /= axis.n();
    }
  return result;
}

std::vector<double> SplineNet::greville(const unsigned int i) const
{
  const auto          at = indices(i);
  std::vector<double> result;
  for (unsigned int axis = 0; axis < n_axes(); ++axis)
    result.push_back(axes[axis].greville(at[axis]));
  return result;
}

/// With clamped knots, only control points on the border move the border of the face or box. An
/// axis with one control point has no border, because all control points would be on it.
bool SplineNet::on_border(const unsigned int i) const
{
  for (unsigned int axis = 0; axis < n_axes(); ++axis)
    for (const unsigned int side : {0, 1})
      if (axes[axis].n() > 1 && axes[axis].is_border(side) && on_side(i, axis, side))
        return true;
  return false;
}

bool SplineNet::on_side(const unsigned int i,
                        const unsigned int axis,
                        const unsigned int side) const
{
  return indices(i)[axis] == (side == 0 ? 0 : axes[axis].n() - 1);
}

std::vector<Combination> SplineNet::derivative(const unsigned int axis,
                                               const unsigned int order) const
{
  unsigned int stride = 1;
  for (unsigned int a = 0; a < axis; ++a)
    stride *= axes[a].n();
  std::vector<Combination> result;
  for (unsigned int i = 0; i < n_points(); ++i)
    if (indices(i)[axis] == 0) // one line of control points along the axis
      for (const auto &along : axes[axis].derivative(order))
        {
          Combination point;
          for (const auto &[k, weight] : along)
            point[i + stride * k] = weight;
          result.push_back(point);
        }
  return result;
}
} // namespace snug::shape
