#include <snug/base/entries.h>
#include <snug/base/narrow.h>
#include <snug/optimization/nlopt_answers.h>
#include <snug/optimization/trust_region.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

namespace snug::optimization {
namespace {
constexpr unsigned int max_failures = 5;

/// Of the lengths: out of a design at which a constraint has no gradient.
constexpr double first_step = 1e-2;

/// A projected gradient above this is no solution, whatever NLopt's tests say.
constexpr double steep = 1e-3;

/**
 * A search, in variables scaled by their lengths and with objective and constraints scaled to
 * order one (ScaledProblem).
 *
 * With SLSQP it is one TrustRegion. It ends at an accepted design x that meets the
 * constraints to the constraint tolerance when its projected gradient is at most
 * gradient_tolerance or, since the accepted design before, the objective
 * changed by at most objective_tolerance |f(x)| or every variable by at
 * most design_tolerance of its bound width; if the trust region cut
 * that step short, the next one must agree.
 *
 * NLopt runs the other algorithms on the problem itself. They
 * do not tell their iterations: each design that is better than all before counts as
 * accepted, NLopt's tests end the search with the same tolerances, and a
 * design that violates the constraints is no success. They are of first order:
 * where they crawl, or end at a design with a large projected gradient, SLSQP goes on.
 * NLopt has no value for "this design cannot be solved" (NaN, infinity and
 * penalties all mislead it). Such a design ends NLopt's run; a new one
 * begins at the last accepted design, its moves limited to half the move
 * that failed, and is re-centred as long as it ends at such a limit. After
 * five failures in a row without a gain the search ends.
 *
 * Where a constraint that holds the start has no gradient there, as that
 * of the volume of a symmetric body, no model of it leads away: it allows no step, or any. The
 * search then begins with a small step of steepest descent.
 *
 * Sources: Kraft, A software package for sequential quadratic programming,
 * DFVLR-FB 88-28 (1988); Svanberg, SIAM J. Optim. 12 (2002) for MMA and
 * CCSA; Birgin, Martínez, Optim. Methods Softw. 23 (2008) for AUGLAG;
 * Johnson, The NLopt nonlinear-optimization package.
 */
class Search
{
public:
  Search(const DesignProblem          &problem,
         const OptimizationParameters &parameters,
         const Hooks                  &hooks);

  OptimizationResult run();

private:
  nlopt::opt make_optimizer() const;
  void       step_off_blind_start();

  OptimizationResult result();

  void descend();
  void ask_nlopt();
  bool begins_again();
  bool steps_back();
  bool is_at_move_limit() const;

  Algorithm                     algorithm;
  const OptimizationParameters &parameters;
  const Hooks                  &hooks;
  ScaledProblem                 problem;
  Progress                      progress;
  std::unique_ptr<NloptAnswers> answers; ///< null: SLSQP

  End                 end = End::none; ///< of the last run
  std::string         failure;         ///< and the message of its last failed evaluation
  std::vector<double> centre;          ///< moves are limited to centre +- reach
  double              reach    = std::numeric_limits<double>::max();
  unsigned int        failures = 0;
};

Search::Search(const DesignProblem          &design_problem,
               const OptimizationParameters &the_parameters,
               const Hooks                  &the_hooks)
  : algorithm(the_parameters.algorithm)
  , parameters(the_parameters)
  , hooks(the_hooks)
  , problem(design_problem)
  , progress(problem, parameters, hooks)
  , centre(problem.start()->y)
{
  const auto &relations = problem.relations();
  const auto  n_equal =
    static_cast<std::size_t>(std::count(relations.begin(), relations.end(), Relation::equal));
  if (!takes_equalities(algorithm) && n_equal > 0)
    throw InputError(to_text(algorithm) + " takes no equality constraints");
  if (n_equal > centre.size())
    throw InputError("the number of equality constraints, " + std::to_string(n_equal) +
                     ", must not exceed the number of design variables, " +
                     std::to_string(centre.size()));
  if (algorithm != Algorithm::SLSQP)
    answers = std::make_unique<NloptAnswers>(problem, progress, parameters);
}

OptimizationResult Search::run()
{
  try
    {
      progress.report();
      step_off_blind_start();
      if (!centre.empty())
        do
          descend();
        while (begins_again());
      return result();
    }
  catch (const Interrupted &)
    {
      auto result      = progress.finish(End::interrupted, "");
      result.algorithm = algorithm;
      return result;
    }
}

/// A search that came back to a start where a constraint has no gradient has found nothing: where
/// the constraint is an equality, that start may be the only design that meets it.
OptimizationResult Search::result()
{
  auto result      = progress.finish(end, failure);
  result.algorithm = algorithm;
  if (!problem.is_blind(*problem.start()) || problem.projected_gradient(*problem.start()) <= steep)
    return result;
  double move = 0.;
  for (const double y : problem.scaled(result.x))
    move = std::max(move, std::abs(y));
  if (move > first_step)
    return result;
  result.success = false;
  result.stop_reason =
    "a constraint without a gradient at the first design, near which no other was found to meet "
    "it: begin elsewhere, by 'Initial' of the shape, or hold it by <= or >=";
  return result;
}

/// If that design has no value, the search begins at the start after all.
void Search::step_off_blind_start()
{
  const auto &start   = *problem.start();
  const auto  g       = problem.gradient(start);
  double      largest = 0.;
  for (const double entry : g)
    largest = std::max(largest, std::abs(entry));
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
      centre = y;
    }
  catch (const SolveError &)
    {}
}

nlopt::opt Search::make_optimizer() const
{
  const auto n               = narrow<unsigned int>(centre.size());
  const auto with_tolerances = [&](nlopt::opt optimizer, double part) {
    std::vector<double> smallest;
    for (unsigned int i = 0; i < n; ++i)
      smallest.push_back(part * parameters.design_tolerance * problem.bound_width(i));
    optimizer.set_ftol_rel(part * parameters.objective_tolerance);
    optimizer.set_xtol_abs(smallest);
    return optimizer;
  };
  if (algorithm == Algorithm::MMA)
    return with_tolerances(nlopt::opt(nlopt::LD_MMA, n), 1.);
  if (algorithm == Algorithm::CCSAQ)
    return with_tolerances(nlopt::opt(nlopt::LD_CCSAQ, n), 1.);
  auto optimizer = with_tolerances(nlopt::opt(nlopt::AUGLAG, n), 1.);
  optimizer.set_local_optimizer(with_tolerances(nlopt::opt(nlopt::LD_LBFGS, n), 0.1));
  return optimizer;
}

/// One run from the iterate.
void Search::descend()
{
  progress.begin_run();
  if (!answers)
    {
      TrustRegion steps(problem, progress, parameters, hooks);
      end     = steps.run();
      failure = steps.failure;
      return;
    }
  answers->begin_run();
  try
    {
      ask_nlopt();
    }
  catch (const nlopt::forced_stop &)
    {}
  if (answers->error)
    std::rethrow_exception(answers->error);
  end     = answers->end;
  failure = answers->failure;
}

void Search::ask_nlopt()
{
  const std::size_t   n = centre.size();
  std::vector<double> lower(n), upper(n);
  for (unsigned int i = 0; i < n; ++i)
    {
      lower[i] = std::max(problem.lower()[i], centre[i] - reach);
      upper[i] = std::min(problem.upper()[i], centre[i] + reach);
    }
  auto optimizer = make_optimizer();
  optimizer.set_lower_bounds(lower);
  optimizer.set_upper_bounds(upper);
  answers->attach(optimizer);
  auto   y = progress.iterate()->y;
  double f = 0.;
  try
    {
      const auto  why   = optimizer.optimize(y, f);
      const auto &found = *progress.iterate();
      // the multipliers of AUGLAG are as good as its constraint tolerance
      if (progress.is_feasible(found) &&
          problem.projected_gradient(found) <= std::max(steep, parameters.constraint_tolerance))
        answers->end = why == nlopt::FTOL_REACHED   ? End::objective
                       : why == nlopt::XTOL_REACHED ? End::design
                                                    : End::round_off;
    }
  catch (const nlopt::forced_stop &)
    {
      throw;
    }
  catch (const std::runtime_error &)
    {
      // Round-off, or NLopt's general failure: its quadratic program has
      // no solution, as for constraints that exclude one another.
    }
}

/// Whether another run should follow; prepares it.
bool Search::begins_again()
{
  if (!answers)
    return false;
  switch (end)
    {
      case End::no_value:
        return steps_back();
      case End::objective:
      case End::design:
        if (!is_at_move_limit())
          return false;
        centre = progress.iterate()->y;
        return true;
      case End::round_off:
        if (hooks.log)
          hooks.log(to_text(algorithm) + " makes no progress: SLSQP goes on from iteration " +
                    std::to_string(progress.n_iterations()));
        algorithm = Algorithm::SLSQP;
        answers.reset();
        return true;
      case End::none:
      case End::gradient:
      case End::evaluations:
      case End::interrupted:
        return false;
    }
  return false;
}

/// Limit the moves to half the move to the design whose evaluation failed.
bool Search::steps_back()
{
  // a run that has gained is worth as many more
  if (progress.has_gained())
    failures = 0;
  if (failures == max_failures)
    return false;
  ++failures;
  centre      = progress.iterate()->y;
  double move = 0.;
  for (unsigned int i = 0; i < centre.size(); ++i)
    move = std::max(move, std::abs(answers->failed_design[i] - centre[i]));
  reach = move / 2.;
  std::ostringstream line;
  line << "evaluation failed (" << failure << "): restart " << failures << " of " << max_failures
       << " from iteration " << progress.n_iterations() << ", moves limited to " << reach
       << " of the first steps";
  if (hooks.log)
    hooks.log(line.str());
  return true;
}

bool Search::is_at_move_limit() const
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
} // namespace

OptimizationResult
minimize(const DesignProblem &problem, const OptimizationParameters &parameters, const Hooks &hooks)
{
  OptimizationParameters checked = parameters;
  Entries                entries;
  checked.declare(entries);
  entries.check(Origins(), 0);
  return Search(problem, parameters, hooks).run();
}
} // namespace snug::optimization
