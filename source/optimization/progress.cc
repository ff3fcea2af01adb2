#include <snug/base/errors.h>
#include <snug/optimization/progress.h>

#include <algorithm>
#include <cmath>

namespace snug::optimization {
/// Return the names of the reasons in the summary and in the log.
static Names names(StopReason)
{
  return {{""},
          {"gradient tolerance"},
          {"objective tolerance"},
          {"design tolerance"},
          {"maximum evaluations"},
          {"round-off"},
          {"failed evaluations"},
          {"interrupted"}};
}

Progress::Progress(const ScaledProblem          &the_problem,
                   const OptimizationParameters &the_parameters,
                   const Hooks                  &the_hooks)
  : problem(the_problem)
  , parameters(the_parameters)
  , hooks(the_hooks)
  , last(problem.start())
  , best(last)
  , best_before(last)
{}

bool Progress::is_better(const ScaledProblem::Point &a, const ScaledProblem::Point &b) const
{
  if (is_feasible(a) && is_feasible(b))
    return a.evaluation.objective < b.evaluation.objective;
  return a.violation < b.violation;
}

/// Return whether the gradients of a design are available. A trial design from which no search
/// continued may have none.
bool Progress::has_gradients(const ScaledProblem::Point &point) const
{
  try
    {
      problem.differentiated(point);
      return true;
    }
  catch (const SolveError &)
    {
      return false;
    }
}

bool Progress::is_usable(const ScaledProblem::Point &point) const
{
  return point.violation <= std::max(parameters.constraint_tolerance, usable_violation);
}

void Progress::consider(const Point &point)
{
  if (is_usable(*point) && (!usable || point->evaluation.objective < usable->evaluation.objective))
    usable = point;
  if (!is_better(*point, *best))
    return;
  best             = point;
  best_is_accepted = false;
}

StopReason Progress::accept(const Point &point, const bool full)
{
  if (point->x == last->x)
    return StopReason::none;
  const auto previous = last;
  last                = point;
  best_is_accepted    = best_is_accepted || best->x == last->x;
  ++iterations;
  report();

  const bool feasible = is_feasible(*last);
  if (feasible && problem.projected_gradient(*last) <= parameters.gradient_tolerance)
    return StopReason::gradient;
  const double f  = last->evaluation.objective;
  const double df = std::abs(f - previous->evaluation.objective);
  double       dy = 0.;
  for (unsigned int i = 0; i < last->y.size(); ++i)
    if (const double width = problem.bound_width(i); width > 0.)
      dy = std::max(dy, std::abs(last->y[i] - previous->y[i]) / width);

  const bool by_objective = df <= parameters.objective_tolerance * std::abs(f);
  const bool by_design    = dy <= parameters.design_tolerance;
  const bool is_stuck     = !feasible && by_design && last->violation > previous->violation / 2.;
  const bool is_close     = is_stuck || (feasible && (by_objective || by_design));
  const bool is_enough    = is_close && (full || was_close);
  was_close               = is_close;
  if (!is_enough)
    return StopReason::none;
  return is_stuck       ? StopReason::round_off
         : by_objective ? StopReason::objective
                        : StopReason::design;
}

void Progress::report() const
{
  if (!hooks.on_iteration)
    return;
  Iteration iteration;
  iteration.number               = iterations;
  iteration.x                    = last->x;
  iteration.projected_gradient   = problem.projected_gradient(*last);
  iteration.evaluation           = last->evaluation; // with its gradients by now
  iteration.constraint_violation = last->violation;
  iteration.evaluations          = problem.n_evaluations();
  hooks.on_iteration(iteration);
}

void Progress::begin_run()
{
  best_before = best;
  was_close   = false;
}

bool Progress::has_gained() const
{
  if (!is_feasible(*best_before))
    return best->violation < best_before->violation / 2.;
  const double f = best->evaluation.objective;
  return best_before->evaluation.objective - f > parameters.objective_tolerance * std::abs(f);
}

std::string Progress::stop_reason(const StopReason end, const std::string &failure) const
{
  if (end == StopReason::none || end == StopReason::round_off)
    return is_feasible(*best) ? "round-off" : "no design satisfies the limits";
  return to_text(end) + (end == StopReason::no_value ? " (" + failure + ")" : "");
}

OptimizationResult Progress::finish(const StopReason end, const std::string &failure)
{
  const bool by_tolerance =
    end == StopReason::gradient || end == StopReason::objective || end == StopReason::design;
  const bool is_cut_short = end == StopReason::evaluations || end == StopReason::interrupted;
  if (is_cut_short && usable && usable->evaluation.objective < best->evaluation.objective &&
      has_gradients(*usable))
    {
      best             = usable;
      best_is_accepted = best->x == last->x;
    }
  const bool is_last = by_tolerance || !has_gradients(*best);
  if (!is_last && !best_is_accepted)
    accept(best, true);
  const auto        &point = is_last ? last : best;
  OptimizationResult result;
  result.x                    = point->x;
  result.projected_gradient   = problem.projected_gradient(*point);
  result.evaluation           = point->evaluation; // with its gradients by now
  result.iterations           = iterations;
  result.evaluations          = problem.n_evaluations();
  result.objective_initial    = problem.start()->evaluation.objective;
  result.objective_final      = point->evaluation.objective;
  result.constraint_violation = point->violation;
  result.end                  = end;
  result.stop_reason          = stop_reason(end, failure);
  const bool by_round_off     = end == StopReason::round_off &&
                            result.projected_gradient <= std::sqrt(parameters.objective_tolerance);
  result.success = is_feasible(*point) && (by_tolerance || by_round_off);
  return result;
}
} // namespace snug::optimization
