#include <snug/optimization/dense_vectors.h>
#include <snug/optimization/secant_hessian.h>

namespace snug::optimization {
namespace {
/// A change of the gradient is used undamped if its curvature is at least this part of that of B.
constexpr double least_part = 0.2;

/// Minimum factor by which one step with less curvature may reduce B.
constexpr double least_left = 0.6;
} // namespace

void SecantHessian::guess(const double curvature)
{
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      rows[i].assign(rows.size(), 0.);
      rows[i][i] = curvature;
    }
  measured = false;
}

void SecantHessian::raise(const std::vector<double> &d, const double product)
{
  const auto   v  = nonlinear(d);
  const double vv = dot(v, v), missing = product - dot(d, times(d));
  if (missing > 0. && vv > 0.)
    add(missing / (vv * vv), v);
}

void SecantHessian::update(std::vector<double> s, std::vector<double> y)
{
  s               = nonlinear(s);
  y               = nonlinear(y);
  const double ys = dot(y, s);
  if (!measured && ys > 0.)
    guess(norm(y) / norm(s));
  else if (const double seen = ys / dot(s, nonlinear(times(s))); seen < 1.)
    for (auto &row : rows)
      for (double &entry : row)
        entry *= std::max(seen, least_left);
  measured          = true;
  const auto   Bs   = nonlinear(times(s));
  const double sBs  = dot(s, Bs);
  const double part = ys >= least_part * sBs ? 1. : (1. - least_part) * sBs / (sBs - ys);
  auto         r    = Bs;
  for (unsigned int i = 0; i < r.size(); ++i)
    r[i] += part * (y[i] - Bs[i]);
  const double rs = dot(r, s);
  if (!(rs > 0.) || !(sBs > 0.))
    return;
  add(1. / rs, r);
  add(-1. / sBs, Bs);
}

std::vector<double> SecantHessian::times(const std::vector<double> &d) const
{
  const auto          v = nonlinear(d);
  std::vector<double> result;
  for (const auto &row : rows)
    result.push_back(dot(row, v));
  result.resize(n, 0.);
  return result;
}

std::vector<double> SecantHessian::nonlinear(const std::vector<double> &v) const
{
  return {v.begin(), v.begin() + rows.size()};
}

/// Add factor v v' to B.
void SecantHessian::add(const double factor, const std::vector<double> &v)
{
  for (unsigned int i = 0; i < rows.size(); ++i)
    optimization::add(rows[i], factor * v[i], v);
}
} // namespace snug::optimization
