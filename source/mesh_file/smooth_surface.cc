#include <snug/mesh_file/smooth_surface.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace snug::mesh_file {
namespace {
template <int dim>
struct Neighbour
{
  dealii::Tensor<1, dim> from; ///< position relative to x
  double                 s;    ///< signed arc length from x
};

template <int dim>
std::vector<Neighbour<dim>>
along(const dealii::Point<dim> &x, const std::vector<dealii::Point<dim>> &points, double sign)
{
  std::vector<Neighbour<dim>> result;
  double                      s    = 0.;
  dealii::Point<dim>          last = x;
  for (const auto &point : points)
    {
      s += sign * last.distance(point);
      last = point;
      result.push_back({point - x, s});
    }
  return result;
}

/// Return the unit tangent at x of the circle through x and two neighbours.
template <int dim>
dealii::Tensor<1, dim> circle_tangent(const Neighbour<dim> &a, const Neighbour<dim> &b)
{
  // An inversion about x maps the circle to a line along the tangent.
  const dealii::Tensor<1, dim> t = b.from / b.from.norm_square() - a.from / a.from.norm_square();
  // The tangent points towards larger s. The inversion reverses the order of points on one side.
  return (a.s < 0. ? 1. : -1.) / t.norm() * t;
}
} // namespace

template <int dim>
dealii::Tensor<1, dim> curve_tangent(const std::vector<dealii::Point<dim>> &before,
                                     const dealii::Point<dim>              &x,
                                     const std::vector<dealii::Point<dim>> &behind)
{
  const auto up = along(x, behind, 1.), down = along(x, before, -1.);
  if (down.empty() && up.size() == 1)
    return up[0].from / up[0].from.norm();
  // Points of a pair are in ascending order of s, except for two points before x.
  using Pair = std::pair<Neighbour<dim>, Neighbour<dim>>;
  std::vector<Pair> pairs;
  if (down.empty())
    {
      pairs.emplace_back(up[0], up[1]);
      if (up.size() > 2)
        pairs.emplace_back(up[1], up[2]);
    }
  else
    {
      pairs.emplace_back(down[0], up[0]);
      if (down.size() > 1 && up.size() > 1)
        pairs.emplace_back(down[1], up[1]);
      else if (up.size() > 1)
        pairs.emplace_back(up[0], up[1]);
      else if (down.size() > 1)
        pairs.emplace_back(down[1], down[0]);
    }
  const auto             product = [](const Pair &pair) { return pair.first.s * pair.second.s; };
  dealii::Tensor<1, dim> t       = circle_tangent(pairs[0].first, pairs[0].second);
  if (pairs.size() > 1)
    {
      auto other = circle_tangent(pairs[1].first, pairs[1].second);
      if (other * t < 0.)
        other *= -1.;
      t = product(pairs[1]) * t - product(pairs[0]) * other;
      t *= (product(pairs[1]) > product(pairs[0]) ? 1. : -1.) / t.norm();
    }
  return t;
}

dealii::Tensor<1, 3> surface_normal(const dealii::Point<3>              &x,
                                    const std::vector<dealii::Point<3>> &neighbours,
                                    const dealii::Tensor<1, 3>          &guess)
{
  using Vector = dealii::Tensor<1, 3>;
  // The frame about the guess is arbitrary.
  Vector e1;
  e1[std::abs(guess[0]) < 0.6 ? 0 : 1] = 1.;
  e1 -= (e1 * guess) * guess;
  e1 /= e1.norm();
  const Vector e2   = cross_product_3d(guess, e1);
  double       size = 0.;
  for (const auto &point : neighbours)
    size = std::max(size, point.distance(x));
  // The height above the tangent plane is a polynomial without a constant term.
  const unsigned int         n = neighbours.size() < 12 ? 5 : 9;
  dealii::FullMatrix<double> A(n, n);
  dealii::Vector<double>     b(n), c(n);
  for (const auto &point : neighbours)
    {
      const Vector                d = (point - x) / size;
      const double                u = d * e1, v = d * e2, weight = 1. / d.norm_square();
      const std::array<double, 9> row = {
        {u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v}};
      for (unsigned int i = 0; i < n; ++i)
        {
          for (unsigned int j = 0; j < n; ++j)
            A(i, j) += weight * row[i] * row[j];
          b(i) += weight * row[i] * (d * guess);
        }
    }
  // The shift reduces coefficients of higher degree that few or regular neighbours hardly
  // determine. It changes well determined coefficients by this fraction.
  for (unsigned int i = 2; i < n; ++i)
    A(i, i) += neighbours.size() * (i < 5 ? 1e-7 : 1e-3);
  A.gauss_jordan();
  A.vmult(c, b);
  const Vector result = guess - c(0) * e1 - c(1) * e2;
  return result / result.norm();
}

template <int dim>
std::array<dealii::Tensor<1, dim>, 2> cubic(const dealii::Tensor<1, dim> &chord,
                                            const dealii::Tensor<1, dim> &first,
                                            const dealii::Tensor<1, dim> &last)
{
  const double length = chord.norm();
  // The lever is 3 times the distance of a control point from its end. This length approximates
  // circles best.
  const auto lever = [&](const dealii::Tensor<1, dim> &t) {
    const double cosine = t * chord / length;
    return cosine < 0.5 ? chord : 2. * length / (1. + cosine) * t;
  };
  return {{lever(first) - chord, chord - lever(last)}};
}

template dealii::Tensor<1, 2> curve_tangent(const std::vector<dealii::Point<2>> &,
                                            const dealii::Point<2> &,
                                            const std::vector<dealii::Point<2>> &);
template dealii::Tensor<1, 3> curve_tangent(const std::vector<dealii::Point<3>> &,
                                            const dealii::Point<3> &,
                                            const std::vector<dealii::Point<3>> &);
template std::array<dealii::Tensor<1, 2>, 2>
cubic(const dealii::Tensor<1, 2> &, const dealii::Tensor<1, 2> &, const dealii::Tensor<1, 2> &);
template std::array<dealii::Tensor<1, 3>, 2>
cubic(const dealii::Tensor<1, 3> &, const dealii::Tensor<1, 3> &, const dealii::Tensor<1, 3> &);
} // namespace snug::mesh_file
