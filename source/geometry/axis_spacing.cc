#include <snug/geometry/axis_spacing.h>

#include <cmath>

namespace snug::geometry {
namespace {
/// (q^s - 1) / (q - 1), s where q = 1.
/// With expm1, or the differences would cancel for q near 1.
double geometric_sum(double log_q, double s)
{
  return std::abs(log_q) < 1e-12 ? s : std::expm1(log_q * s) / std::expm1(log_q);
}

/// log q with q (q^k - 1) / (q - 1) = sum: k sizes that grow by q from
/// 1 (not counted) have this sum. By bisection: the left side grows
/// with q.
double growth(unsigned int k, double sum)
{
  // ratios of neighbouring cells between e^-50 and e^50 are more than any mesh has
  double lower = -50., upper = 50.;
  while (upper - lower > 1e-15 * (1. + std::abs(lower)))
    {
      const double middle = 0.5 * (lower + upper);
      // the ends are neighbouring doubles
      if (middle == lower || middle == upper)
        break;
      if (std::exp(middle) * geometric_sum(middle, k) < sum)
        lower = middle;
      else
        upper = middle;
    }
  return 0.5 * (lower + upper);
}
} // namespace

AxisSpacing AxisSpacing::graded(unsigned int n_cells, double ratio)
{
  AxisSpacing spacing(n_cells);
  if (ratio != 1.)
    // n cells have n - 1 steps from the first size to the last
    spacing.log_q = std::log(ratio) / (n_cells - 1);
  return spacing;
}

AxisSpacing AxisSpacing::with_fine_part(unsigned int n_cells, double fine)
{
  AxisSpacing spacing(n_cells);
  spacing.m     = (n_cells + 1) / 2;
  spacing.first = fine;
  // the rest of the axis, in units of the size c / m of the fine cells
  spacing.log_q = growth(n_cells - spacing.m, (1. - fine) / (fine / spacing.m));
  return spacing;
}

double AxisSpacing::fraction(double xi) const
{
  if (m == 0)
    return log_q == 0. ? xi : std::expm1(log_q * n * xi) / std::expm1(log_q * n);
  const double size = first / m, beyond = n * xi - m;
  return beyond <= 0. ? size * n * xi
                      : first + size * std::exp(log_q) * geometric_sum(log_q, beyond);
}
} // namespace snug::geometry
