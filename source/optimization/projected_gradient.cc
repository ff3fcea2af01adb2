#include <snug/base/assertions.h>
#include <snug/optimization/dense_vectors.h>
#include <snug/optimization/projected_gradient.h>


#include <cmath>
#include <limits>

namespace snug::optimization {
namespace {
using Rows = std::vector<std::vector<double>>;

std::vector<double> restricted(const std::vector<double> &v, const std::vector<bool> &used)
{
  std::vector<double> result(v.size(), 0.);
  for (unsigned int i = 0; i < v.size(); ++i)
    if (used[i])
      result[i] = v[i];
  return result;
}

/**
 * Compute an orthonormal basis q_k of the rows restricted to the @p used entries, and the same
 * combinations of the full rows: t_k = sum_j T_kj A_j agrees with q_k on the used entries. In @p t,
 * the factors T_kj follow the entries of t_k. Dependent rows are left out. Each row is
 * orthogonalized twice because of round-off.
 */
void orthonormalize(const std::vector<ConstraintGradient> &constraint_gradients,
                    const std::vector<bool>               &used,
                    Rows                                  &q,
                    Rows                                  &t)
{
  for (unsigned int j = 0; j < constraint_gradients.size(); ++j)
    {
      auto v    = restricted(constraint_gradients[j].gradient, used);
      auto full = constraint_gradients[j].gradient;
      full.resize(v.size() + constraint_gradients.size(), 0.);
      full[v.size() + j] = 1.;
      const double size  = std::sqrt(dot(v, v));
      for (unsigned int pass = 0; pass < 2; ++pass)
        for (unsigned int k = 0; k < q.size(); ++k)
          {
            const double share = dot(v, q[k]);
            add(v, -share, q[k]);
            add(full, -share, t[k]);
          }
      const double rest = std::sqrt(dot(v, v));
      if (rest <= 1e-12 * size)
        continue;
      for (double &entry : v)
        entry /= rest;
      for (double &entry : full)
        entry /= rest;
      q.push_back(v);
      t.push_back(full);
    }
}

/// This struct holds r = g + A' mu for the mu that minimizes the norm of the used entries of r.
struct Reduced
{
  std::vector<double> r, mu;
};

Reduced reduced_gradient(const std::vector<double>             &g,
                         const std::vector<ConstraintGradient> &constraint_gradients,
                         const std::vector<bool>               &used)
{
  Rows q, t;
  orthonormalize(constraint_gradients, used, q, t);
  auto all = g;
  all.resize(g.size() + constraint_gradients.size(), 0.);
  for (unsigned int pass = 0; pass < 2; ++pass)
    for (unsigned int k = 0; k < q.size(); ++k)
      add(all, -dot(q[k], all), t[k]);
  const auto end = all.begin() + g.size();
  return {{all.begin(), end}, {end, all.end()}};
}

/// Return whether the bound at @p place permits a move against @p r, that is, a descent.
bool counts(const double r, const BoundState place)
{
  switch (place)
    {
      case BoundState::inside:
        return true;
      case BoundState::at_lower:
        return r < 0.;
      case BoundState::at_upper:
        return r > 0.;
      case BoundState::fixed:
        return false;
    }
  return false;
}

/// Return the multipliers mu, of any sign, that minimize the norm of P(g + A' mu), and set
/// @p smallest to the minimum.
std::vector<double> minimize_pieces(const std::vector<double>             &g,
                                    const std::vector<ConstraintGradient> &constraint_gradients,
                                    const std::vector<BoundState>         &at_bounds,
                                    double                                &smallest)
{
  std::vector<bool> used(g.size());
  for (unsigned int i = 0; i < g.size(); ++i)
    used[i] = at_bounds[i] == BoundState::inside;
  smallest = std::numeric_limits<double>::max();
  std::vector<double>    mu;
  constexpr unsigned int max_pieces = 50;
  for (unsigned int piece = 0; piece < max_pieces; ++piece)
    {
      const auto        reduced = reduced_gradient(g, constraint_gradients, used);
      std::vector<bool> next(g.size());
      for (unsigned int i = 0; i < g.size(); ++i)
        next[i] = counts(reduced.r[i], at_bounds[i]);
      const auto   p    = restricted(reduced.r, next);
      const double norm = std::sqrt(dot(p, p));
      if (norm < smallest)
        {
          smallest = norm;
          mu       = reduced.mu;
        }
      if (next == used)
        break;
      used = next;
    }
  return mu;
}
} // namespace

ProjectedGradient projected_gradient(const std::vector<double>      &g,
                                     std::vector<ConstraintGradient> constraint_gradients,
                                     const std::vector<BoundState>  &at_bounds)
{
  SNUG_ASSERT_EQUAL(g.size(), at_bounds.size());
  ProjectedGradient         result{0., std::vector<double>(constraint_gradients.size(), 0.)};
  std::vector<unsigned int> numbers(constraint_gradients.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  for (;;)
    {
      const auto  mu    = minimize_pieces(g, constraint_gradients, at_bounds, result.norm);
      std::size_t worst = constraint_gradients.size();
      for (unsigned int j = 0; j < constraint_gradients.size(); ++j)
        if (constraint_gradients[j].pushes && mu[j] < 0. &&
            (worst == constraint_gradients.size() || mu[j] < mu[worst]))
          worst = j;
      if (worst == constraint_gradients.size())
        {
          for (unsigned int j = 0; j < numbers.size(); ++j)
            result.multipliers[numbers[j]] = mu[j];
          return result;
        }
      constraint_gradients.erase(constraint_gradients.begin() + worst);
      numbers.erase(numbers.begin() + worst);
    }
}
} // namespace snug::optimization
