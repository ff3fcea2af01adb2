#include <snug/geometry/axis_spacing.h>

#include <cmath>

namespace snug::geometry {
namespace {
/// Return (q^s - 1) / (q - 1), or s if q = 1.
/// The function expm1 avoids the cancellation of the differences for q near 1.
double geometric_sum(double log_q, double s)
{
  return std::abs(log_q) < 1e-12 ? s : std::expm1(log_q * s) / std::expm1(log_q);
}

/// Return log q with q (q^k - 1) / (q - 1) = sum. The left side is the sum of k sizes that grow by
/// q from the size 1, which is not counted. Bisection finds q, because the left side grows
/// with q.
double growth(unsigned int k, double sum)
{
  // The ratio of neighbouring cells of any mesh lies between e^-50 and e^50.
  double lower = -50., upper = 50.;
  while (upper - lower > 1e-15 * (1. + std::abs(lower)))
    {
      const double middle = 0.5 * (lower + upper);
      // The ends are adjacent doubles.
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
    // n cells have n - 1 ratios between the first size and the last size.
    spacing.log_q = std::log(ratio) / (n_cells - 1);
  return spacing;
}

AxisSpacing AxisSpacing::with_fine_part(unsigned int n_cells, double fine)
{
  AxisSpacing spacing(n_cells);
  spacing.m     = (n_cells + 1) / 2;
  spacing.first = fine;
  // The sum is the rest of the axis in units of the size c / m of the fine cells.
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
