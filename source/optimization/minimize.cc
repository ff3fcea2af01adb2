#include <snug/base/entries.h>
#include <snug/optimization/epigraph.h>
#include <snug/optimization/minimize.h>
#include <snug/optimization/mma_search.h>
#include <snug/optimization/trust_region.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::optimization {
namespace {
/// Length of the first step from a start at which a constraint has no gradient, in y.
constexpr double first_step = 1e-2;

double largest_entry(const std::vector<double> &x)
{
  double largest = 0.;
  for (const double entry : x)
    largest = std::max(largest, std::abs(entry));
  return largest;
}

void check_equalities(const ScaledProblem &problem, const Algorithm algorithm)
{
  const auto &relations = problem.relations();
  const auto  n_equal =
    static_cast<std::size_t>(std::count(relations.begin(), relations.end(), Relation::equal));
  if (!takes_equalities(algorithm) && n_equal > 0)
    throw InputError(to_text(algorithm) + " takes no equality constraints");
  if (n_equal > problem.size())
    throw InputError("the number of equality constraints, " + std::to_string(n_equal) +
                     ", must not exceed the number of design variables, " +
                     std::to_string(problem.size()));
}

/// Take a small step of steepest descent from a start at which a constraint has no gradient, as the
/// volume of a symmetric body has none. A model of such a constraint allows no step, or any step.
/// If the evaluation fails, the start remains the iterate.
void step_from_blind_start(ScaledProblem                &problem,
                           Progress                     &progress,
                           const OptimizationParameters &parameters)
{
  const auto  &start   = *problem.start();
  const auto   g       = problem.gradient(start);
  const double largest = largest_entry(g);
  if (largest == 0. || parameters.maximum_evaluations < 2 || !problem.is_blind(start))
    return;
  auto y = start.y;
  for (unsigned int i = 0; i < y.size(); ++i)
    y[i] = std::clamp(-first_step * g[i] / largest, problem.lower()[i], problem.upper()[i]);
  try
    {
      const auto point = problem.at(y);
      progress.consider(point);
      progress.accept(point, true);
    }
  catch (const SolveError &)
    {}
}

/// Mark the result as failed if the search came back to a start at which a constraint has no
/// gradient: where the constraint is an equality, that start may be the only feasible design.
void check_blind_start(const ScaledProblem &problem, OptimizationResult &result)
{
  const auto &start = *problem.start();
  if (!problem.is_blind(start) || problem.projected_gradient(start) <= steep_gradient ||
      largest_entry(problem.scaled(result.x)) > first_step)
    return;
  result.success = false;
  result.stop_reason =
    "the gradient of a constraint vanishes at the initial design, and no design nearby satisfies "
    "the constraint: change 'Initial' of the shape, or use <= or >=";
}

/// Run the search with the algorithm of the parameters. If MMA stalls, SQP continues the search.
OptimizationResult search(ScaledProblem                &problem,
                          Progress                     &progress,
                          const OptimizationParameters &parameters,
                          const Hooks                  &hooks)
{
  Algorithm   algorithm = parameters.algorithm;
  StopReason  end       = StopReason::none;
  std::string failure;
  try
    {
      progress.report();
      step_from_blind_start(problem, progress, parameters);
      if (problem.size() > 0 && algorithm == Algorithm::MMA)
        {
          MmaSearch mma(problem, progress, parameters, hooks);
          end     = mma.run();
          failure = mma.failure;
          if (end == StopReason::round_off)
            {
              if (hooks.log)
                hooks.log("MMA stalled: continuing with SQP from iteration " +
                          std::to_string(progress.n_iterations()));
              algorithm = Algorithm::SQP;
            }
        }
      if (problem.size() > 0 && algorithm == Algorithm::SQP)
        {
          progress.begin_run();
          TrustRegion sqp(problem, progress, parameters, hooks);
          end     = sqp.run();
          failure = sqp.failure;
        }
    }
  catch (const Interrupted &)
    {
      end = StopReason::interrupted;
    }
  auto result      = progress.finish(end, failure);
  result.algorithm = algorithm;
  if (end != StopReason::interrupted)
    check_blind_start(problem, result);
  return result;
}
} // namespace

std::string failure_reason(const OptimizationResult     &result,
                           const OptimizationParameters &parameters)
{
  const bool is_feasible = result.constraint_violation <= parameters.constraint_tolerance;
  const bool is_cut_short =
    result.end == StopReason::interrupted || result.end == StopReason::evaluations;
  if (result.success ||
      (is_cut_short && (is_feasible || result.constraint_violation <= usable_violation)))
    return "";
  std::ostringstream text;
  text << "the optimization has not converged: it stopped by " << result.stop_reason;
  if (!is_feasible)
    text << "; the final design violates "
         << (result.violated.empty() ? "a constraint" : "'" + result.violated + "'") << " by "
         << result.constraint_violation << " of its limit";
  return text.str();
}

bool takes_equalities(const Algorithm algorithm)
{
  return algorithm == Algorithm::SQP;
}

OptimizationResult
minimize(const DesignProblem &problem, const OptimizationParameters &parameters, const Hooks &hooks)
{
  OptimizationParameters checked = parameters;
  Entries                entries;
  checked.declare(entries);
  entries.check(Origins(), 0);
  const auto minimize_smooth = [&](const DesignProblem &smooth, const Hooks &its_hooks) {
    ScaledProblem scaled(smooth);
    check_equalities(scaled, parameters.algorithm);
    Progress progress(scaled, parameters, its_hooks);
    return search(scaled, progress, parameters, its_hooks);
  };
  if (problem.maxima.empty())
    return minimize_smooth(problem, hooks);
  const Epigraph epigraph(problem);
  return epigraph.result(minimize_smooth(epigraph.smooth_problem(), epigraph.hooks(hooks)));
}
} // namespace snug::optimization
