#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/optimization/nlopt_answers.h>

#include <algorithm>
#include <cmath>

namespace snug::optimization {
namespace {
/// NLopt may repeat a question for ever.
constexpr unsigned int max_idle_questions = 100;

/// An algorithm that takes more evaluations than this for a gain crawls: of the objective by
/// `gain`, or of the violation by half. MMA's separable models see no curvature across
/// variables, and near a minimum of a peak it may need hundreds.
constexpr unsigned int patience = 30;
constexpr double       gain     = 0.01;
} // namespace

NloptAnswers::NloptAnswers(ScaledProblem                &the_problem,
                           Progress                     &the_progress,
                           const OptimizationParameters &the_parameters)
  : progress(the_progress)
  , problem(the_problem)
  , parameters(the_parameters)
  , n_variables(narrow<unsigned int>(problem.start()->y.size()))
{}

void NloptAnswers::begin_run()
{
  end            = End::round_off;
  idle_questions = 0;
  milestone      = progress.iterate();
  reached        = problem.n_evaluations();
}

void NloptAnswers::attach(nlopt::opt &optimizer)
{
  optimizer.set_min_objective(&NloptAnswers::call_objective, this);
  const auto &relations = problem.relations();
  const auto  n_equal =
    static_cast<std::size_t>(std::count(relations.begin(), relations.end(), Relation::equal));
  const auto tolerances = [this](const std::size_t n) {
    return std::vector<double>(n, parameters.constraint_tolerance);
  };
  if (n_equal > 0)
    optimizer.add_equality_mconstraint(&NloptAnswers::call_constraints<Relation::equal>, this,
                                       tolerances(n_equal));
  if (n_equal < relations.size())
    optimizer.add_inequality_mconstraint(&NloptAnswers::call_constraints<Relation::at_most>, this,
                                         tolerances(relations.size() - n_equal));
}

double NloptAnswers::objective(const double *values, double *gradient)
{
  const std::vector<double> y(values, values + n_variables);
  const unsigned int        before = problem.n_evaluations();
  const auto                point  = values_at(y, gradient != nullptr);
  idle_questions                   = problem.n_evaluations() > before ? 0 : idle_questions + 1;
  if (idle_questions > max_idle_questions)
    stop(End::round_off);
  if (progress.is_better(*point, *progress.iterate()) &&
      progress.accept(point, true) == End::gradient)
    stop(End::gradient);
  watch();
  if (gradient != nullptr)
    {
      const auto g = problem.gradient(*point);
      std::copy(g.begin(), g.end(), gradient);
    }
  return point->evaluation.objective / problem.objective_scale();
}

/// Values and derivatives of the constraints of one relation. NLopt asks for
/// them and for the objective one by one at the same design; the problem
/// remembers its last designs and evaluates each once.
void NloptAnswers::constraints(const Relation relation,
                               double        *values,
                               const double  *y,
                               double        *jacobian)
{
  const auto  point     = values_at(std::vector<double>(y, y + n_variables), jacobian != nullptr);
  const auto  c         = problem.constraints(point->evaluation);
  const auto &relations = problem.relations();
  for (unsigned int j = 0; j < c.size(); ++j)
    if (relations[j] == relation)
      *values++ = c[j];
  if (jacobian == nullptr)
    return;
  const auto rows = problem.jacobian(*point);
  for (unsigned int j = 0; j < c.size(); ++j)
    if (relations[j] == relation)
      jacobian = std::copy(rows[j].begin(), rows[j].end(), jacobian);
}

Progress::Point NloptAnswers::values_at(const std::vector<double> &y, const bool with_gradient)
{
  if (!problem.is_known(y) && problem.n_evaluations() >= parameters.maximum_evaluations)
    stop(End::evaluations);
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
      stop(End::no_value);
    }
}

void NloptAnswers::stop(const End reason)
{
  end = reason;
  throw nlopt::forced_stop();
}

/// NLopt forgets the message and type of exceptions: keep them.
template <typename Function>
void NloptAnswers::guarded(const Function &work)
{
  try
    {
      work();
    }
  catch (const nlopt::forced_stop &)
    {
      throw;
    }
  catch (const Interrupted &)
    {
      stop(End::interrupted);
    }
  catch (...)
    {
      error = std::current_exception();
      throw nlopt::forced_stop();
    }
}

double NloptAnswers::call_objective(unsigned int, const double *y, double *gradient, void *answers)
{
  auto  &self  = *static_cast<NloptAnswers *>(answers);
  double value = 0.;
  self.guarded([&] { value = self.objective(y, gradient); });
  return value;
}

template <Relation relation>
void NloptAnswers::call_constraints(unsigned int,
                                    double *values,
                                    unsigned int,
                                    const double *y,
                                    double       *jacobian,
                                    void         *answers)
{
  auto &self = *static_cast<NloptAnswers *>(answers);
  self.guarded([&] { self.constraints(relation, values, y, jacobian); });
}

/// End a run that crawls. AUGLAG's inner search is of quasi-Newton type.
void NloptAnswers::watch()
{
  if (parameters.algorithm == Algorithm::AUGLAG)
    return;
  const auto  &best    = *progress.iterate();
  const double f       = best.evaluation.objective;
  const bool   is_gain = progress.is_feasible(*milestone)
                           ? milestone->evaluation.objective - f > gain * std::abs(f)
                           : progress.is_feasible(best) || best.violation < milestone->violation / 2.;
  if (is_gain)
    {
      milestone = progress.iterate();
      reached   = problem.n_evaluations();
    }
  else if (problem.n_evaluations() > reached + patience)
    stop(End::round_off);
}
} // namespace snug::optimization
