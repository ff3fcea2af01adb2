#include <snug/accuracy/targets.h>
#include <snug/base/values.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace snug::accuracy {
namespace {
/// Indicators above this share of the last marked indicator are marked too. Symmetric cells, whose
/// indicators differ only by the error of the solver, are refined together.
const double like_the_last = 0.99;
} // namespace

double Target::allowed(const double response) const
{
  return relative ? value * std::abs(response) : value;
}

Target read_target(const std::string &text)
{
  std::size_t       end = 0;
  Target            target{std::stod(text, &end), false};
  const std::string rest = trim(text.substr(end));
  target.relative        = rest == "%";
  if (target.relative)
    target.value /= 100.;
  if (!std::isfinite(target.value) || target.value <= 0. ||
      (target.relative && target.value < smallest_target) || !(rest.empty() || target.relative))
    throw std::invalid_argument("no target");
  return target;
}

std::vector<bool> mark(const std::vector<double> &indicators,
                       const double               error,
                       const double               allowed,
                       const Marking             &marking)
{
  std::vector<bool> marked(indicators.size(), false);
  const double      sum = std::accumulate(indicators.begin(), indicators.end(), 0.);
  if (error <= aim * allowed || sum <= 0.)
    return marked;
  std::vector<unsigned int> order(indicators.size());
  std::iota(order.begin(), order.end(), 0u);
  // Ties are broken by the order of the cells.
  std::stable_sort(order.begin(), order.end(),
                   [&](unsigned int a, unsigned int b) { return indicators[a] > indicators[b]; });
  const double falls  = 1. - std::pow(4., -1. * marking.degree);
  const double wanted = sum * std::min(marking.share, (1. - aim * allowed / error) / falls);
  double       so_far = 0., last = 0.;
  for (const unsigned int cell : order)
    {
      if (indicators[cell] <= 0. || (so_far >= wanted && indicators[cell] < like_the_last * last))
        break;
      if (so_far < wanted)
        last = indicators[cell];
      so_far += indicators[cell];
      marked[cell] = true;
    }
  return marked;
}

double step_tolerance(const double error, const bool is_energy, const double least)
{
  const double tenth = 0.1 * error;
  return std::max(least, std::min(maximum_tolerance, is_energy ? std::sqrt(tenth) : tenth));
}

bool is_unbounded(const std::vector<double> &errors)
{
  // Use three earlier errors, because the first mesh may be too coarse for a valid error.
  return errors.size() > 3 &&
         errors.back() > 2. / 3. * *std::max_element(errors.end() - 4, errors.end() - 1);
}

bool changes_sign(const std::vector<double> &values)
{
  return std::any_of(values.end() - std::min<std::ptrdiff_t>(4, values.size()), values.end(),
                     [&](const double value) { return value * values.back() < 0.; });
}
} // namespace snug::accuracy
