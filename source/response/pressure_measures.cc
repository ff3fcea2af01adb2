#include <snug/response/pressure_measures.h>

#include <algorithm>
#include <cmath>

namespace snug::response {
namespace {
Measured nothing(const PressureRows &rows)
{
  const std::vector<double> zero(rows.force.size(), 0.);
  return {0., zero, zero};
}

/// S = sum_i A_i (q_i / m)^p with the largest pressure m taken as a
/// constant, and its derivatives.
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
  // all pressures over the largest one
  const double threshold = e * square.value / force.value;
  const double even      = 1. + e * e;
  double       slope     = 0.; // dJ/d(threshold)
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      const double q     = rows.force[i] / rows.area[i] / force.largest;
      const double sum   = q * q + threshold * threshold;
      const double share = even * q * q / sum;
      const double by_q  = even * 2. * q * threshold * threshold / (sum * sum);
      result.value += rows.area[i] * share;
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
  // the mean makes the integral stationary
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    {
      const double q     = rows.force[i] / rows.area[i];
      result.by_force[i] = 2. * (q - mean) / area;
      result.by_area[i]  = ((q - mean) * (q - mean) - 2. * (q - mean) * q - result.value) / area;
    }
  return result;
}
} // namespace snug::response
