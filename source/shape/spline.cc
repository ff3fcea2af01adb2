#include <snug/shape/spline.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace snug::shape {
Spline::Spline(const unsigned int n, const unsigned int degree)
  : size(n), degree(degree), knots(degree + 1, 0.)
{
  Assert(degree < n, dealii::ExcMessage("A spline needs more points."));
  const unsigned int n_spans = n - degree;
  for (unsigned int i = 1; i < n_spans; ++i)
    knots.push_back(double(i) / n_spans);
  // The end knots are repeated degree + 1 times (clamped knots), so that only the end control
  // point acts at an end.
  knots.insert(knots.end(), degree + 1, 1.);
}

/// The recurrence of Cox and de Boor is applied to all degree + 1 nonzero splines at once, in
/// place: B_i^p = (s - t_i) / (t_(i+p) - t_i) B_i^(p-1)
///       + (t_(i+p+1) - s) / (t_(i+p+1) - t_(i+1)) B_(i+1)^(p-1).
/// All terms are non-negative, so that no digits cancel.
std::pair<unsigned int, std::vector<double>> Spline::values(const double s) const
{
  // The span satisfies knots[span] <= s < knots[span + 1]. The last span contains s = 1.
  const unsigned int span =
    std::upper_bound(knots.begin() + degree, knots.begin() + size, s) - knots.begin() - 1;
  std::vector<double> values(degree + 1, 0.);
  values[0] = 1.;
  for (unsigned int p = 1; p <= degree; ++p)
    {
      double saved = 0.;
      for (unsigned int r = 0; r < p; ++r)
        {
          const double left  = knots[span + 1 + r - p];
          const double right = knots[span + 1 + r];
          // left <= knots[span] < knots[span + 1] <= right, so right - left is never zero.
          const double part = values[r] / (right - left);
          values[r]         = saved + (right - s) * part;
          saved             = (s - left) * part;
        }
      values[p] = saved;
    }
  return {span - degree, values};
}

/// For degree 0 the result is the middle of the span, because there is no inner knot.
double Spline::greville(const unsigned int i) const
{
  if (degree == 0)
    return (knots[i] + knots[i + 1]) / 2.;
  double sum = 0.;
  for (unsigned int k = 1; k <= degree; ++k)
    sum += knots[i + k];
  return sum / degree;
}

SplineNet::SplineNet(const std::vector<unsigned int> &n, const unsigned int degree)
{
  for (const unsigned int points : n)
    // The degree points - 1 gives one span with Bernstein polynomials. A single control point has
    // degree 0 and moves all points by the same amount.
    axes.emplace_back(points, degree == 0 || points == 1 ? points - 1 : degree);
}

unsigned int SplineNet::n_points() const
{
  unsigned int product = 1;
  for (const Spline &axis : axes)
    product *= axis.n();
  return product;
}

std::vector<std::pair<unsigned int, double>> SplineNet::values(const std::vector<double> &s) const
{
  AssertDimension(s.size(), n_axes());
  std::vector<std::pair<unsigned int, double>> products = {{0, 1.}};
  unsigned int                                 stride   = 1;
  for (unsigned int axis = 0; axis < n_axes(); ++axis)
    {
      const auto                                   along = axes[axis].values(s[axis]);
      std::vector<std::pair<unsigned int, double>> longer;
      for (unsigned int k = 0; k < along.second.size(); ++k)
        for (const auto &product : products)
          // The first axis is fastest, so the products of the axes before stay consecutive.
          longer.emplace_back(product.first + stride * (along.first + k),
                              product.second * along.second[k]);
      products = longer;
      stride *= axes[axis].n();
    }
  return products;
}

/// The indices satisfy i = i_0 + n_0 (i_1 + n_1 (i_2 + ..)).
std::vector<unsigned int> SplineNet::indices(unsigned int i) const
{
  std::vector<unsigned int> result;
  for (const Spline &axis : axes)
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
    if (axes[axis].n() > 1 && (on_side(i, axis, 0) || on_side(i, axis, 1)))
      return true;
  return false;
}

bool SplineNet::on_side(const unsigned int i,
                        const unsigned int axis,
                        const unsigned int side) const
{
  return indices(i)[axis] == (side == 0 ? 0 : axes[axis].n() - 1);
}
} // namespace snug::shape
