#include <snug/base/errors.h>
#include <snug/optimization/dense_vectors.h>
#include <snug/optimization/trust_region.h>

#include <sstream>

namespace snug::optimization {
namespace {
/// Limits of rho: a design is accepted, the radius shrinks, the radius grows.
constexpr double accepted = 1e-4, poor = 0.25, good = 0.75;

/// Factor of the radius after a good step.
constexpr double growth = 3.;

/// A predicted gain below this part of the objective is rounding.
constexpr double no_gain = 1e-15;

/// A step below this part of the first one is rounding.
constexpr double smallest_radius = 1e-10;

/// Number of failed evaluations without a gain in between after which the search ends.
constexpr unsigned int max_failed_evaluations = 5;

/// Weight of a constraint over its multiplier, the part of a weight that remains in a step, and the
/// minimum weight.
constexpr double above_multiplier = 1.5, forgetting = 0.5, least_weight = 1e-6;
} // namespace

TrustRegion::TrustRegion(ScaledProblem                &the_problem,
                         Progress                     &the_progress,
                         const OptimizationParameters &the_parameters,
                         const Hooks                  &the_hooks)
  : problem(the_problem)
  , progress(the_progress)
  , parameters(the_parameters)
  , hooks(the_hooks)
  , hessian(problem.size(), problem.n_nonlinear())
  , weights(problem.relations().size(), least_weight)
{}

StopReason TrustRegion::run()
{
  const auto &first = *progress.iterate();
  if (progress.is_feasible(first) &&
      problem.projected_gradient(first) <= parameters.gradient_tolerance)
    return StopReason::gradient;
  while (radius > smallest_radius)
    {
      const auto at = progress.iterate();
      const auto g  = problem.gradient(*at);
      if (!hessian.is_measured())
        hessian.guess(norm(g) * problem.projected_gradient(*at) / radius);
      const StepModel model(problem, *at, hessian);
      auto            trial = proposed(model);
      if (!(trial.predicted > no_gain * std::abs(trial.objective)))
        {
          if (!hessian.is_measured())
            return StopReason::round_off;
          hessian.guess(0.);
          continue;
        }
      if (!problem.is_cached(trial.y) && problem.n_evaluations() >= parameters.maximum_evaluations)
        return StopReason::evaluations;
      if (!evaluated(trial))
        {
          if (++n_failures > max_failed_evaluations)
            return StopReason::no_value;
        }
      else if (const StopReason end =
                 trial.actual < accepted * trial.predicted ? reject(trial) : accept(model, trial);
               end != StopReason::none)
        return end;
    }
  return failure.empty() ? StopReason::round_off : StopReason::no_value;
}

/// Return the minimizer of the model with the decrease of the merit that it predicts.
TrustRegion::Trial TrustRegion::proposed(const StepModel &model)
{
  Trial       trial;
  const auto &at    = *progress.iterate();
  trial.d           = model.minimizer(radius);
  const auto &there = model(trial.d);
  const auto  here  = problem.constraints(at.evaluation);
  const auto  mu    = model.multipliers(trial.d, radius);
  for (unsigned int j = 0; j < weights.size(); ++j)
    weights[j] =
      std::max({above_multiplier * std::abs(mu[j]), forgetting * weights[j], least_weight});
  trial.objective     = at.evaluation.objective / problem.objective_scale();
  trial.violation     = weighted_violation(here);
  const double gained = trial.violation - weighted_violation(there.constraints);
  trial.predicted     = trial.objective - there.objective + gained;
  trial.slope         = gained - dot(problem.gradient(at), trial.d);
  for (unsigned int i = 0; i < trial.d.size(); ++i)
    trial.y.push_back(std::clamp(at.y[i] + trial.d[i], problem.lower()[i], problem.upper()[i]));
  return trial;
}

/// Return sum_j nu_j |c_j|, with c_j^+ for inequalities.
double TrustRegion::weighted_violation(const std::vector<double> &constraints) const
{
  double sum = 0.;
  for (unsigned int j = 0; j < constraints.size(); ++j)
    sum += weights[j] * violation(problem.relations()[j], constraints[j]);
  return sum;
}

/// Evaluate the design of a step. @return false if it has no value.
bool TrustRegion::evaluated(Trial &trial)
{
  try
    {
      trial.point = problem.settled_at(trial.y);
    }
  catch (const SolveError &no_value)
    {
      failure = no_value.what();
      radius  = problem.length(trial.d) / 4.;
      failed  = true;
      if (progress.has_gained())
        n_failures = 0;
      progress.begin_run();
      if (hooks.log)
        {
          std::ostringstream line;
          line << "evaluation failed (" << failure << "): reducing the step from iteration "
               << progress.n_iterations() << " to a quarter";
          hooks.log(line.str());
        }
      return false;
    }
  progress.consider(trial.point);
  const auto &evaluation = trial.point->evaluation;
  trial.actual           = trial.objective - evaluation.objective / problem.objective_scale() +
                 trial.violation - weighted_violation(problem.constraints(evaluation));
  return true;
}

/// Reject a design and reduce the radius. Return StopReason::objective if even the predicted gain
/// is below the tolerance, as beside a kink.
StopReason TrustRegion::reject(const Trial &trial)
{
  if (progress.is_feasible(*progress.iterate()) &&
      trial.predicted <= parameters.objective_tolerance * std::abs(trial.objective))
    return StopReason::objective;
  const double left = trial.slope - trial.actual; // by the curvature along d
  radius            = problem.length(trial.d) *
           (trial.slope > 0. && left > 0. ? std::clamp(trial.slope / (2. * left), 0.1, 0.5) : 0.25);
  failure.clear();
  if (hessian.is_measured())
    hessian.raise(trial.d, 2. * left);
  return StopReason::none;
}

StopReason TrustRegion::accept(const StepModel &model, const Trial &trial)
{
  const double part = trial.actual / trial.predicted, length = problem.length(trial.d);
  const bool   is_at_end = length > 0.99 * radius;
  const bool   may_grow  = !failed;
  failed                 = false;
  if (!problem.predicts_objective())
    learn(model, trial);
  if (part < poor)
    radius = std::max(radius / 4., length / 2.);
  else if (may_grow && part > good && length > 0.8 * radius)
    radius *= growth;
  // A small change is no convergence if the box cut the step, or if a much larger gain was
  // predicted.
  const StopReason end = progress.accept(trial.point, !is_at_end && part > poor);
  // The step may be small only because the evaluation of a longer step failed.
  return end != StopReason::none && end != StopReason::gradient && is_at_end && !failure.empty()
           ? StopReason::no_value
           : end;
}

/// Update B by the change of the gradient of the Lagrangian that the prediction lacks.
void TrustRegion::learn(const StepModel &model, const Trial &trial)
{
  const auto  mu        = problem.multipliers(*trial.point);
  const auto &predicted = model(trial.d);
  const auto  Bd        = hessian.times(trial.d);
  auto        y         = problem.gradient(*trial.point);
  add(y, -1., predicted.gradient);
  add(y, 1., Bd); // which the model has added
  const auto jacobian = problem.jacobian(*trial.point);
  for (unsigned int j = 0; j < mu.size(); ++j)
    {
      add(y, mu[j], jacobian[j]);
      add(y, -mu[j], predicted.jacobian[j]);
    }
  hessian.update(trial.d, y);
}
} // namespace snug::optimization
