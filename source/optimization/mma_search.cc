#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/optimization/mma_search.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::optimization {
namespace {
constexpr unsigned int max_failures = 5;

/// Maximum number of callbacks in a row without an evaluation, because NLopt may repeat evaluations
/// indefinitely.
constexpr unsigned int max_repeated = 100;

/// A run that gains less than this part of the objective, or half of the violation, in this number
/// of evaluations has stalled: near a minimum of a peak pressure, MMA may take hundreds, because
/// its separable models hold no curvature across variables.
constexpr unsigned int patience = 30;
constexpr double       gain     = 0.01;
} // namespace

MmaSearch::MmaSearch(ScaledProblem                &the_problem,
                     Progress                     &the_progress,
                     const OptimizationParameters &the_parameters,
                     const Hooks                  &the_hooks)
  : problem(the_problem)
  , progress(the_progress)
  , parameters(the_parameters)
  , hooks(the_hooks)
  , centre(progress.iterate()->y)
{}

StopReason MmaSearch::run()
{
  do
    {
      progress.begin_run();
      end            = StopReason::round_off;
      n_repeated     = 0;
      milestone      = progress.iterate();
      n_at_milestone = problem.n_evaluations();
      try
        {
          run_nlopt();
        }
      catch (const nlopt::forced_stop &)
        {}
      if (error)
        std::rethrow_exception(error);
  } while (shall_continue());
  return end;
}

void MmaSearch::run_nlopt()
{
  const auto          n = problem.size();
  std::vector<double> lower(n), upper(n), smallest_change(n);
  for (unsigned int i = 0; i < n; ++i)
    {
      lower[i]           = std::max(problem.lower()[i], centre[i] - reach);
      upper[i]           = std::min(problem.upper()[i], centre[i] + reach);
      smallest_change[i] = parameters.design_tolerance * problem.bound_width(i);
    }
  nlopt::opt optimizer(nlopt::LD_MMA, n);
  optimizer.set_lower_bounds(lower);
  optimizer.set_upper_bounds(upper);
  optimizer.set_ftol_rel(parameters.objective_tolerance);
  optimizer.set_xtol_abs(smallest_change);
  optimizer.set_min_objective(&MmaSearch::call_objective, this);
  if (!problem.relations().empty())
    optimizer.add_inequality_mconstraint(&MmaSearch::call_constraints, this,
                                         std::vector<double>(problem.relations().size(),
                                                             parameters.constraint_tolerance));
  auto   y = progress.iterate()->y;
  double f = 0.;
  try
    {
      const auto  why   = optimizer.optimize(y, f);
      const auto &found = *progress.iterate();
      if (progress.is_feasible(found) && problem.projected_gradient(found) <= steep_gradient)
        end = why == nlopt::FTOL_REACHED   ? StopReason::objective
              : why == nlopt::XTOL_REACHED ? StopReason::design
                                           : StopReason::round_off;
    }
  catch (const nlopt::forced_stop &)
    {
      throw;
    }
  catch (const std::runtime_error &)
    {
      // NLopt fails by round-off, or because constraints exclude one another.
    }
}

/// Return whether another run of NLopt shall follow, and prepare it.
bool MmaSearch::shall_continue()
{
  if (end == StopReason::no_value)
    return reduce_moves();
  if ((end != StopReason::objective && end != StopReason::design) || !is_at_move_limit())
    return false;
  centre = progress.iterate()->y;
  return true;
}

/// Limit the moves to half the move to the design whose evaluation failed. Failures count from the
/// last run that has gained. @return false after too many failures.
bool MmaSearch::reduce_moves()
{
  if (progress.has_gained())
    failures = 0;
  if (failures == max_failures)
    return false;
  ++failures;
  centre      = progress.iterate()->y;
  double move = 0.;
  for (unsigned int i = 0; i < centre.size(); ++i)
    move = std::max(move, std::abs(failed_design[i] - centre[i]));
  reach = move / 2.;
  std::ostringstream line;
  line << "evaluation failed (" << failure << "): restart " << failures << " of " << max_failures
       << " from iteration " << progress.n_iterations() << ", moves limited to " << reach
       << " of the first steps";
  if (hooks.log)
    hooks.log(line.str());
  return true;
}

bool MmaSearch::is_at_move_limit() const
{
  for (unsigned int i = 0; i < centre.size(); ++i)
    {
      const double y = progress.iterate()->y[i];
      if (std::abs(y - centre[i]) >= reach * (1. - 1e-8) && y > problem.lower()[i] &&
          y < problem.upper()[i])
        return true;
    }
  return false;
}

double MmaSearch::objective(const double *values, double *gradient)
{
  const std::vector<double> y(values, values + problem.size());
  const unsigned int        before = problem.n_evaluations();
  const auto                point  = values_at(y, gradient != nullptr);
  n_repeated                       = problem.n_evaluations() > before ? 0 : n_repeated + 1;
  if (n_repeated > max_repeated)
    stop(StopReason::round_off);
  if (progress.is_better(*point, *progress.iterate()) &&
      progress.accept(point, true) == StopReason::gradient)
    stop(StopReason::gradient);
  stop_if_stalled();
  if (gradient != nullptr)
    {
      const auto g = problem.gradient(*point);
      std::copy(g.begin(), g.end(), gradient);
    }
  return point->evaluation.objective / problem.objective_scale();
}

/// Set the values of the constraints and, if @p jacobian is not null, their derivatives, row by
/// row. NLopt asks for constraints and objective separately: the problem caches its last designs
/// and evaluates each once.
void MmaSearch::constraints(double *values, const double *y, double *jacobian)
{
  const auto point = values_at(std::vector<double>(y, y + problem.size()), jacobian != nullptr);
  const auto c     = problem.constraints(point->evaluation);
  std::copy(c.begin(), c.end(), values);
  if (jacobian != nullptr)
    for (const auto &row : problem.jacobian(*point))
      jacobian = std::copy(row.begin(), row.end(), jacobian);
}

Progress::Point MmaSearch::values_at(const std::vector<double> &y, const bool with_gradient)
{
  if (!problem.is_cached(y) && problem.n_evaluations() >= parameters.maximum_evaluations)
    stop(StopReason::evaluations);
  try
    {
      auto point = problem.at(y);
      if (with_gradient)
        problem.differentiated(*point);
      progress.consider(point);
      return point;
    }
  catch (const SolveError &no_value)
    {
      failure       = no_value.what();
      failed_design = y;
      stop(StopReason::no_value);
    }
}

void MmaSearch::stop_if_stalled()
{
  const auto  &best    = *progress.iterate();
  const double f       = best.evaluation.objective;
  const bool   is_gain = progress.is_feasible(*milestone)
                           ? milestone->evaluation.objective - f > gain * std::abs(f)
                           : progress.is_feasible(best) || best.violation < milestone->violation / 2.;
  if (is_gain)
    {
      milestone      = progress.iterate();
      n_at_milestone = problem.n_evaluations();
    }
  else if (problem.n_evaluations() > n_at_milestone + patience)
    stop(StopReason::round_off);
}

void MmaSearch::stop(const StopReason reason)
{
  end = reason;
  throw nlopt::forced_stop();
}

/// Keep exceptions of @p work in the members, because NLopt keeps neither their type nor their
/// message.
template <typename Function>
void MmaSearch::guarded(const Function &work)
{
  try
    {
      work();
    }
  catch (const nlopt::forced_stop &)
    {
      throw;
    }
  catch (...)
    {
      error = std::current_exception();
      throw nlopt::forced_stop();
    }
}

double MmaSearch::call_objective(unsigned int, const double *y, double *gradient, void *search)
{
  auto  &self  = *static_cast<MmaSearch *>(search);
  double value = 0.;
  self.guarded([&] { value = self.objective(y, gradient); });
  return value;
}

void MmaSearch::call_constraints(unsigned int,
                                 double *values,
                                 unsigned int,
                                 const double *y,
                                 double       *jacobian,
                                 void         *search)
{
  auto &self = *static_cast<MmaSearch *>(search);
  self.guarded([&] { self.constraints(values, y, jacobian); });
}
} // namespace snug::optimization
