#include <snug/response/pressure_measures.h>

#include <algorithm>
#include <cmath>

namespace snug::response {
namespace {
/// Return J = 0 with zero derivatives. The formulas below would be 0 / 0 without pressure.
Measured nothing(const PressureRows &rows)
{
  const std::vector<double> zero(rows.force.size(), 0.);
  return {0., zero, zero};
}

/// S = sum_i A_i (q_i / m)^p, where the maximum pressure m is a constant, and the derivatives
/// of S. A_i q_i^p = p_i^p A_i^(1-p) gives the factors p and 1 - p of the derivatives.
/// Division by the maximum pressure avoids overflow of large powers. The derivatives may
/// treat m as a constant, because m cancels in all measures below.
struct PowerSum : Measured
{
  PowerSum(const PressureRows &rows, const double p) : Measured(nothing(rows))
  {
    for (unsigned int i = 0; i < rows.force.size(); ++i)
      largest = std::max(largest, rows.force[i] / rows.area[i]);
    if (largest == 0.)
      return;
    for (unsigned int i = 0; i < rows.force.size(); ++i)
      {
        // Rounding makes pressures of open contacts slightly negative.
        const double q = std::max(0., rows.force[i] / rows.area[i] / largest);
        value += rows.area[i] * std::pow(q, p);
        by_force[i] = p * std::pow(q, p - 1.) / largest;
        by_area[i]  = (1. - p) * std::pow(q, p);
      }
  }

  double largest = 0.;
};
} // namespace

Measured contact_area(const PressureRows &rows, const double e)
{
  const PowerSum force(rows, 1.), square(rows, 2.);
  auto           result = nothing(rows);
  if (force.largest == 0.)
    return result;
  // All pressures are divided by the maximum pressure. The threshold e m with
  // m = int q^2 dA / int q dA depends on all rows. The loop sums dJ/d(threshold) in slope. The
  // derivatives of the threshold times slope are added to all derivatives at the end.
  const double threshold = e * square.value / force.value;
  // For a uniform pressure q = m and even * q^2 / (q^2 + e^2 m^2) = 1.
  const double even  = 1. + e * e;
  double       slope = 0.; // dJ/d(threshold)
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      const double q     = rows.force[i] / rows.area[i] / force.largest;
      const double sum   = q * q + threshold * threshold;
      const double share = even * q * q / sum;
      const double by_q  = even * 2. * q * threshold * threshold / (sum * sum);
      result.value += rows.area[i] * share;
      // The terms are the derivatives of share(q_i) A_i with q_i = p_i / A_i at a fixed threshold.
      result.by_force[i] = by_q / force.largest;
      result.by_area[i]  = share - q * by_q;
      slope -= even * rows.area[i] * 2. * q * q * threshold / (sum * sum);
    }
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      const auto by = [&](double of_square, double of_force) {
        return slope * threshold * (of_square / square.value - of_force / force.value);
      };
      result.by_force[i] += by(square.by_force[i], force.by_force[i]);
      result.by_area[i] += by(square.by_area[i], force.by_area[i]);
    }
  return result;
}

/// Compute J = m S^(1/p) and J' = J / (p S) S'.
Measured pressure_norm(const PressureRows &rows, const double p)
{
  const PowerSum sum(rows, p);
  if (sum.largest == 0.)
    return nothing(rows);
  Measured result = sum;
  result.value    = sum.largest * std::pow(sum.value, 1. / p);
  for (auto *slopes : {&result.by_force, &result.by_area})
    for (double &slope : *slopes)
      slope *= result.value / (p * sum.value);
  return result;
}

/// Compute J = m (S_(p+1) / S_1)^(1/p) and J' = J / p (S_(p+1)' / S_(p+1) - S_1' / S_1).
Measured peak_pressure(const PressureRows &rows, const double p)
{
  const PowerSum sum(rows, p + 1.), force(rows, 1.);
  if (sum.largest == 0.)
    return nothing(rows);
  Measured result = sum;
  result.value    = sum.largest * std::pow(sum.value / force.value, 1. / p);
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      const auto by = [&](double of_sum, double of_force) {
        return result.value / p * (of_sum / sum.value - of_force / force.value);
      };
      result.by_force[i] = by(sum.by_force[i], force.by_force[i]);
      result.by_area[i]  = by(sum.by_area[i], force.by_area[i]);
    }
  return result;
}

/// Compute the variance over all rows, including open rows, because an open part of the side
/// makes the pressure nonuniform too.
Measured pressure_variance(const PressureRows &rows)
{
  auto   result = nothing(rows);
  double force = 0., area = 0.;
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      force += rows.force[i];
      area += rows.area[i];
    }
  if (force == 0.)
    return result;
  const double mean = force / area;
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      const double q = rows.force[i] / rows.area[i];
      result.value += rows.area[i] * (q - mean) * (q - mean) / area;
    }
  // The mean m may be treated as a constant, because it makes the integral stationary:
  // int (q - m) dA = 0.
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      const double q     = rows.force[i] / rows.area[i];
      result.by_force[i] = 2. * (q - mean) / area;
      result.by_area[i]  = ((q - mean) * (q - mean) - 2. * (q - mean) * q - result.value) / area;
    }
  return result;
}

Measured total(const PressureRows &rows)
{
  Measured result{0., std::vector<double>(rows.force.size(), 1.),
                  std::vector<double>(rows.force.size(), 0.)};
  for (const double force : rows.force)
    result.value += force;
  return result;
}
} // namespace snug::response
