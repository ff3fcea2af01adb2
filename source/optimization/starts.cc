#include <snug/base/errors.h>
#include <snug/base/values.h>
#include <snug/optimization/starts.h>

#include <random>
#include <sstream>

namespace snug::optimization {
namespace {
/// Return random design number @p k. The standard defines the numbers of the generator, but not
/// those of its distributions.
std::vector<double> random_start(const DesignProblem &problem, const unsigned int k)
{
  std::mt19937        random(k);
  const double        range = 4294967296.; // 2^32
  std::vector<double> x;
  for (std::size_t i = 0; i < problem.lower.size(); ++i)
    x.push_back(problem.lower[i] +
                (problem.upper[i] - problem.lower[i]) * (double(random()) / range));
  return x;
}

/// Return @p hooks for a search after those of @p before, whose numbers continue.
Hooks counting_from(const OptimizationResult &before, const Hooks &hooks)
{
  auto result = hooks;
  if (hooks.on_iteration)
    result.on_iteration = [before, hooks](Iteration iteration) {
      iteration.number += before.iterations + 1;
      iteration.evaluations += before.evaluations;
      hooks.on_iteration(iteration);
    };
  return result;
}
} // namespace

bool is_better(const OptimizationResult     &a,
               const OptimizationResult     &b,
               const OptimizationParameters &parameters)
{
  const auto is_feasible = [&](const OptimizationResult &result) {
    return result.constraint_violation <= parameters.constraint_tolerance;
  };
  if (is_feasible(a) != is_feasible(b))
    return is_feasible(a);
  return is_feasible(a) ? a.objective_final < b.objective_final
                        : a.constraint_violation < b.constraint_violation;
}

OptimizationResult minimize_from_starts(const DesignProblem          &problem,
                                        const OptimizationParameters &parameters,
                                        const Hooks                  &hooks)
{
  auto               best       = minimize(problem, parameters, hooks);
  auto               total      = best; // iterations and evaluations of all searches
  const unsigned int of         = parameters.starts;
  unsigned int       best_start = 0;
  const auto         log        = [&hooks](const std::string &line) {
    if (hooks.log)
      hooks.log(line);
  };
  const auto name = [of](const unsigned int k) {
    return "search " + to_text(k + 1) + " of " + to_text(of);
  };
  for (unsigned int k = 1; k < of; ++k)
    {
      if (total.end == StopReason::interrupted ||
          total.evaluations >= parameters.maximum_evaluations)
        break;
      log(name(k) + ": from a random design within the bounds");
      auto from  = problem;
      from.start = random_start(problem, k);
      auto rest  = parameters;
      rest.maximum_evaluations -= total.evaluations;
      try
        {
          const auto next = minimize(from, rest, counting_from(total, hooks));
          total.end       = next.end;
          total.iterations += next.iterations + 1;
          total.evaluations += next.evaluations;
          if (is_better(next, best, parameters))
            {
              best       = next;
              best_start = k;
            }
        }
      catch (const Interrupted &)
        {
          total.end = StopReason::interrupted;
        }
      catch (const SolveError &error)
        {
          ++total.evaluations;
          log(name(k) + ": the random design cannot be evaluated: " + error.what());
        }
    }
  if (of > 1)
    {
      std::ostringstream line;
      line << "best objective: " << best.objective_final << " by " << name(best_start);
      log(line.str());
    }
  best.iterations        = total.iterations;
  best.evaluations       = total.evaluations;
  best.objective_initial = total.objective_initial;
  if (total.end == StopReason::interrupted)
    {
      best.end         = total.end;
      best.stop_reason = "interrupted";
      best.success     = false;
    }
  return best;
}
} // namespace snug::optimization
