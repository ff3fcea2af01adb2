#include <snug/optimization/combination.h>

#include <algorithm>
#include <cmath>

namespace snug::optimization {
namespace {
using Numbers = std::vector<double>;

const double sharpness = 100.; // p

Combined weighted_sum(const Numbers &values, const Numbers &weights)
{
  Combined combined{0., weights};
  for (unsigned int c = 0; c < values.size(); ++c)
    combined.value += weights[c] * values[c];
  return combined;
}

Combined smooth_maximum(const Numbers &values, const Numbers &weights, const double scale)
{
  Numbers weighted;
  for (unsigned int c = 0; c < values.size(); ++c)
    weighted.push_back(weights[c] * values[c]);
  const double m = *std::max_element(weighted.begin(), weighted.end());
  const double s = scale > 0. ? scale : 1.;
  Combined     combined;
  double       sum = 0.;
  for (const double value : weighted)
    {
      combined.factors.push_back(std::exp(sharpness * (value - m) / s));
      sum += combined.factors.back();
    }
  for (unsigned int c = 0; c < values.size(); ++c)
    combined.factors[c] *= weights[c] / sum;
  combined.value = m + s / sharpness * std::log(sum);
  return combined;
}
} // namespace

Combined combined(const Combination combination,
                  const Numbers    &values,
                  const Numbers    &weights,
                  const double      scale)
{
  return combination == Combination::sum ? weighted_sum(values, weights)
                                         : smooth_maximum(values, weights, scale);
}
} // namespace snug::optimization
