#include <snug/qp/independent_columns.h>
#include <snug/qp/kkt.h>
#include <snug/qp/krylov_columns.h>

#include <algorithm>

namespace snug::qp {
namespace {
/// A column converges with the others if the distance of its residual from the span of the other
/// residuals is at most this part of its tolerance.
const double negligible = 0.5;

/// Columns whose distance from this span is less than this part of the longest column give no
/// direction yet, because later directions of the others may suffice.
const double minor = 0.3;

/// Number of iterations without a smaller residual after which the residual has stalled.
const unsigned int patience = 40;
} // namespace

bool KrylovColumns::ends(const MultiVector         &r,
                         const MultiVector         &residual,
                         const std::vector<double> &tolerances,
                         const unsigned int         max_iterations,
                         KrylovResult              &result)
{
  const unsigned int k    = r.n_columns();
  MultiVector        both = r;
  both.append(residual);
  const auto sizes       = norms(both, comm);
  double     worst       = 0.;
  bool       is_rounding = true;
  if (result.iterations == 0)
    first = sizes;
  remaining.clear();
  goals.resize(k);
  for (unsigned int j = 0; j < k; ++j)
    {
      // The projection subtracts numbers of the size of the residual, most of which may be rigid
      // motion. Its result cannot be brought below their rounding error.
      goals[j] = std::max(tolerances[j], projection_rounding * sizes[k + j]);
      if (sizes[j] <= goals[j])
        continue;
      remaining.push_back(j);
      worst       = std::max(worst, sizes[j] / first[j]);
      is_rounding = is_rounding && sizes[j] <= residual_rounding * sizes[k + j];
    }
  result.residual_norms.assign(sizes.begin(), sizes.begin() + k);
  result.converged = remaining.empty();
  if (result.converged || result.iterations == max_iterations)
    return true;
  if (!stagnates(worst, is_rounding))
    return false;
  result.converged = result.at_rounding = is_rounding;
  return true;
}

MultiVector KrylovColumns::leading_part(const MultiVector &r) const
{
  MultiVector scaled(r.n_rows(), 0);
  for (const unsigned int j : remaining)
    {
      MultiVector column(r.n_rows());
      column.add(1. / goals[j], r.columns_from(j, 1));
      scaled.append(column);
    }
  MultiVector part(r.n_rows(), 0);
  for (const unsigned int j :
       leading_columns(inner_products(scaled, scaled, comm), negligible, minor))
    part.append(scaled.columns_from(j, 1));
  return part;
}

/// Return whether the residual has stalled. If only rounding is left (@p is_rounding), one
/// iteration without a smaller residual suffices: further directions would be rounding errors as
/// well, and soon no longer orthogonal.
bool KrylovColumns::stagnates(const double worst, const bool is_rounding)
{
  ++waited;
  if (worst < 0.99 * best)
    {
      best   = worst;
      waited = 0;
    }
  return waited > (is_rounding ? 0 : patience);
}
} // namespace snug::qp
