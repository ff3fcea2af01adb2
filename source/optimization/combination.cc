#include <snug/base/values.h>
#include <snug/optimization/combination.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace snug::optimization {
namespace {
using Kind    = Combination::Kind;
using Numbers = std::vector<double>;

const std::vector<std::pair<std::string, Kind>> &simple_kinds()
{
  static const std::vector<std::pair<std::string, Kind>> kinds = {{"sum", Kind::sum},
                                                                  {"mean", Kind::mean},
                                                                  {"worst", Kind::worst},
                                                                  {"range", Kind::range}};
  return kinds;
}

Combined weighted_sum(const Numbers &values, const Numbers &weights)
{
  return {std::inner_product(values.begin(), values.end(), weights.begin(), 0.), weights};
}

/// Add sign w_c J_c for the c at which sign w_c J_c is largest.
void add_maximum(const double sign, const Numbers &values, const Numbers &weights, Combined &to)
{
  std::size_t best = 0;
  for (std::size_t c = 1; c < values.size(); ++c)
    if (sign * weights[c] * values[c] > sign * weights[best] * values[best])
      best = c;
  to.value += sign * weights[best] * values[best];
  to.factors[best] += sign * weights[best];
}

Combined deviation(const Combination &combination, const Numbers &values, const Numbers &p)
{
  const double mean     = weighted_sum(values, p).value;
  double       variance = 0.;
  for (std::size_t c = 0; c < values.size(); ++c)
    variance += p[c] * (values[c] - mean) * (values[c] - mean);
  const double sigma = std::sqrt(variance), k = combination.deviations;
  Combined     result{k * sigma + (combination.with_mean ? mean : 0.), Numbers(values.size(), 0.)};
  for (std::size_t c = 0; c < values.size(); ++c)
    {
      // Where all values are equal, the deviation has a minimum.
      if (sigma > 0.)
        result.factors[c] = k * p[c] * (values[c] - mean) / sigma;
      if (combination.with_mean)
        result.factors[c] += p[c];
    }
  return result;
}
} // namespace

std::string Combination::text() const
{
  for (const auto &[name, simple] : simple_kinds())
    if (simple == kind)
      return name;
  return (with_mean ? "mean + " : "") +
         (deviations == 1. ? std::string() : to_text(deviations) + " ") + "deviation";
}

Combination Combination::read(const std::string &text)
{
  Combination combination;
  for (const auto &[name, kind] : simple_kinds())
    if (name == text)
      {
        combination.kind = kind;
        return combination;
      }
  auto words       = components(text);
  combination.kind = Kind::deviation;
  if (words.size() > 2 && words[0] == "mean" && words[1] == "+")
    {
      combination.with_mean = true;
      words.erase(words.begin(), words.begin() + 2);
    }
  if (words.empty() || words.size() > 2 || words.back() != "deviation")
    throw std::invalid_argument("no combination");
  if (words.size() == 2)
    from_text(words.front(), combination.deviations);
  if (!(combination.deviations > 0.))
    throw std::invalid_argument("the number of deviations is not positive");
  return combination;
}

Combined combined(const Combination &combination, const Numbers &values, const Numbers &weights)
{
  auto         p   = weights;
  const double sum = std::accumulate(p.begin(), p.end(), 0.);
  for (double &probability : p)
    probability /= sum;
  Combined result{0., Numbers(values.size(), 0.)};
  switch (combination.kind)
    {
      case Kind::sum:
        return weighted_sum(values, weights);
      case Kind::mean:
        return weighted_sum(values, p);
      case Kind::deviation:
        return deviation(combination, values, p);
      case Kind::range:
        add_maximum(-1., values, weights, result);
        [[fallthrough]];
      case Kind::worst:
        add_maximum(1., values, weights, result);
    }
  return result;
}
} // namespace snug::optimization
