#include <snug/optimization/dense_vectors.h>
#include <snug/optimization/epigraph.h>

#include <algorithm>
#include <cmath>

namespace snug::optimization {
namespace {
using Vector = std::vector<double>;

/// Number of designs whose values are kept: as many as ScaledProblem keeps, because a rejected step
/// may be followed by a return to the iterate.
constexpr unsigned int n_kept = 32;

/// A maximum may change by this many times its size at the start.
constexpr double reach = 1e4;

double &value(Evaluation &evaluation, const int of)
{
  return of < 0 ? evaluation.objective : evaluation.constraints[of];
}

Vector &gradient(Evaluation &evaluation, const int of)
{
  return of < 0 ? evaluation.gradient : evaluation.jacobian[of];
}
} // namespace

Epigraph::Epigraph(const DesignProblem &the_problem) : problem(the_problem), smooth(the_problem)
{
  Vector start;
  for (unsigned int i = 0; i < problem.start.size(); ++i)
    start.push_back(std::clamp(problem.start[i], problem.lower[i], problem.upper[i]));
  const auto first = evaluated(start);
  if (first->gradient.empty())
    problem.differentiate(start, *first);
  objective_initial = first->objective;
  smooth.lengths    = problem.lengths;
  for (std::size_t i = smooth.lengths.size(); i < start.size(); ++i)
    smooth.lengths.push_back((problem.upper[i] - problem.lower[i]) / 10.);
  for (const Maximum &maximum : problem.maxima)
    {
      const double tau  = first->constraints[largest(*first, maximum)];
      double       size = 0.;
      for (unsigned int j = maximum.begin; j < maximum.end; ++j)
        size = std::max(size, std::abs(first->constraints[j]));
      size = size > 0. ? size : 1.;
      smooth.start.push_back(tau);
      smooth.lower.push_back(tau - reach * size);
      smooth.upper.push_back(tau + reach * size);
      // A step of the first length changes the maximum by about as much as a step of the others.
      double slope = 0.;
      for (unsigned int i = 0; i < start.size(); ++i)
        slope += std::pow(smooth.lengths[i] * first->jacobian[largest(*first, maximum)][i], 2);
      smooth.lengths.push_back(slope > 0. ? std::sqrt(slope) : size);
      if (!smooth.constraint_scales.empty())
        std::fill(smooth.constraint_scales.begin() + maximum.begin,
                  smooth.constraint_scales.begin() + maximum.end, size);
    }
  smooth.maxima.clear();
  std::replace(smooth.relations.begin(), smooth.relations.end(), Relation::term, Relation::at_most);
  smooth.n_linear = static_cast<unsigned int>(problem.maxima.size());
  smooth.settle   = [this](const Vector &x) {
    auto       result = design(x);
    const auto at     = evaluated(result);
    for (const Maximum &maximum : problem.maxima)
      result.push_back(at->constraints[largest(*at, maximum)]);
    return result;
  };
  smooth.evaluate = [this](const Vector &x) { return to_smooth(*evaluated(design(x)), tau(x)); };
  if (problem.differentiate)
    smooth.differentiate = [this](const Vector &x, Evaluation &evaluation) {
      const auto at = evaluated(design(x));
      if (at->gradient.empty())
        problem.differentiate(design(x), *at);
      evaluation = to_smooth(*at, tau(x));
    };
  if (problem.predict)
    smooth.predict = [this](const Evaluation &at, const Vector &dx) {
      Vector       there = tau(dx);
      const Vector here(at.linearization.end() - there.size(), at.linearization.end());
      add(there, 1., here);
      return to_smooth(problem.predict(from_smooth(at), design(dx)), there);
    };
}

/// Return the values at @p x, which the problem evaluates once for all values of the new variables.
Epigraph::Values Epigraph::evaluated(const Vector &x)
{
  for (const auto &[design, values] : recent)
    if (design == x)
      return values;
  recent.emplace_front(x, std::make_shared<Evaluation>(problem.evaluate(x)));
  if (recent.size() > n_kept)
    recent.pop_back();
  return recent.front().second;
}

Vector Epigraph::design(const Vector &with_tau) const
{
  return {with_tau.begin(), with_tau.end() - problem.maxima.size()};
}

Vector Epigraph::tau(const Vector &with_tau) const
{
  return {with_tau.end() - problem.maxima.size(), with_tau.end()};
}

/// Return the first of the largest terms.
unsigned int Epigraph::largest(const Evaluation &at, const Maximum &maximum) const
{
  const auto &c = at.constraints;
  return static_cast<unsigned int>(
    std::max_element(c.begin() + maximum.begin, c.begin() + maximum.end) - c.begin());
}

Evaluation Epigraph::to_smooth(const Evaluation &at, const Vector &tau) const
{
  Evaluation   result = at;
  const auto   n      = static_cast<unsigned int>(tau.size());
  const bool   slopes = !at.gradient.empty();
  const Vector zero(n, 0.);
  if (slopes)
    {
      result.gradient.insert(result.gradient.end(), zero.begin(), zero.end());
      for (auto &row : result.jacobian)
        row.insert(row.end(), zero.begin(), zero.end());
    }
  for (unsigned int k = 0; k < n; ++k)
    {
      const Maximum     &maximum = problem.maxima[k];
      const unsigned int first   = largest(at, maximum);
      value(result, maximum.of) += tau[k] - at.constraints[first];
      for (unsigned int j = maximum.begin; j < maximum.end; ++j)
        result.constraints[j] -= tau[k];
      if (!slopes)
        continue;
      const std::size_t of_tau = at.gradient.size() + k;
      auto             &of     = gradient(result, maximum.of);
      for (unsigned int i = 0; i < at.gradient.size(); ++i)
        of[i] -= at.jacobian[first][i];
      of[of_tau] = 1.;
      for (unsigned int j = maximum.begin; j < maximum.end; ++j)
        result.jacobian[j][of_tau] = -1.;
    }
  // The prediction starts from the values of the design problem.
  if (!result.linearization.empty())
    result.linearization.insert(result.linearization.end(), tau.begin(), tau.end());
  return result;
}

/// Undo to_smooth() for values with a linearization.
Evaluation Epigraph::from_smooth(const Evaluation &at) const
{
  Evaluation result    = at;
  const auto tau       = this->tau(at.linearization);
  result.linearization = design(at.linearization);
  result.gradient      = design(at.gradient);
  for (auto &row : result.jacobian)
    row = design(row);
  for (unsigned int k = 0; k < tau.size(); ++k)
    {
      const Maximum &maximum = problem.maxima[k];
      for (unsigned int j = maximum.begin; j < maximum.end; ++j)
        result.constraints[j] += tau[k];
      const unsigned int first = largest(result, maximum);
      value(result, maximum.of) += result.constraints[first] - tau[k];
      add(gradient(result, maximum.of), 1., result.jacobian[first]);
    }
  return result;
}

Hooks Epigraph::hooks(const Hooks &given) const
{
  Hooks result = given;
  if (given.on_iteration)
    result.on_iteration = [this, given](Iteration iteration) {
      iteration.x = design(iteration.x);
      for (const auto &[design, values] : recent)
        if (design == iteration.x)
          iteration.evaluation = *values;
      given.on_iteration(iteration);
    };
  return result;
}

OptimizationResult Epigraph::result(OptimizationResult of_smooth) const
{
  of_smooth.x = design(of_smooth.x);
  for (const auto &[design, values] : recent)
    if (design == of_smooth.x)
      of_smooth.evaluation = *values;
  of_smooth.objective_initial = objective_initial;
  of_smooth.objective_final   = of_smooth.evaluation.objective;
  return of_smooth;
}
} // namespace snug::optimization
