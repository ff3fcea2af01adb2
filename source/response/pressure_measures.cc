#include <snug/response/pressure_measures.h>

#include <algorithm>
#include <cmath>

namespace snug::response {
namespace {
/// J = 0 with zero derivatives: without any pressure the formulas below are 0 / 0.
Measured nothing(const PressureRows &rows)
{
  const std::vector<double> zero(rows.force.size(), 0.);
  return {0., zero, zero};
}

/// S = sum_i A_i (q_i / m)^p with the largest pressure m taken as a
/// constant, and its derivatives.
/// A_i q_i^p = p_i^p A_i^(1-p), hence the factors p and 1 - p of the derivatives. Over the largest
/// pressure large powers do not overflow. m cancels in all the measures below, so that their
/// derivatives may take it as a constant.
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
        // rounded below zero where contacts are open
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
  // All pressures are over the largest one. The threshold e m, m = int q^2 dA / int q dA, depends
  // on all rows: slope sums up what it makes, which is added to all derivatives in the end.
  const double threshold = e * square.value / force.value;
  // Of an even pressure q = m, and even q^2 / (q^2 + e^2 m^2) = 1.
  const double even  = 1. + e * e;
  double       slope = 0.; // dJ/d(threshold)
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      const double q     = rows.force[i] / rows.area[i] / force.largest;
      const double sum   = q * q + threshold * threshold;
      const double share = even * q * q / sum;
      const double by_q  = even * 2. * q * threshold * threshold / (sum * sum);
      result.value += rows.area[i] * share;
      // share(q_i) A_i with q_i = p_i / A_i at a fixed threshold
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

/// J = m S^(1/p), J' = J / (p S) S'.
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

/// J = m (S_(p+1) / S_1)^(1/p), J' = J / p (S_(p+1)' / S_(p+1) - S_1' / S_1).
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

/// Of all rows, also those that are open: a bare part of the side is uneven, too.
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
  // m may count as a constant, as it makes the integral stationary: int (q - m) dA = 0.
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      const double q     = rows.force[i] / rows.area[i];
      result.by_force[i] = 2. * (q - mean) / area;
      result.by_area[i]  = ((q - mean) * (q - mean) - 2. * (q - mean) * q - result.value) / area;
    }
  return result;
}
} // namespace snug::response
