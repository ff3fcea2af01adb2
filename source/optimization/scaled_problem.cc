#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/optimization/dense_vectors.h>
#include <snug/optimization/scaled_problem.h>


#include <algorithm>
#include <cmath>
#include <string>

namespace snug::optimization {
namespace {
/// Number of designs that are kept, more than a line search evaluates.
constexpr unsigned int n_remembered = 32;

/// A variable closer to a bound, relative to its length, is at the bound.
constexpr double at_bound = 1e-8;

/// An inequality with less left, relative to its scale, is active.
constexpr double at_limit = 1e-6;

/// Designs closer than this, relative to the lengths, are one design, because NLopt often requests
/// designs that differ in their last bits only.
constexpr double resolution = 1e-13;

bool is_same(const std::vector<double> &a, const std::vector<double> &b)
{
  for (unsigned int i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) <= resolution))
      return false;
  return true;
}

bool all_finite(const std::vector<double> &v)
{
  return std::all_of(v.begin(), v.end(), [](double entry) { return std::isfinite(entry); });
}

void check_bounds(const DesignProblem &problem)
{
  SNUG_ASSERT_EQUAL(problem.lower.size(), problem.start.size());
  SNUG_ASSERT_EQUAL(problem.upper.size(), problem.start.size());
  for (unsigned int i = 0; i < problem.start.size(); ++i)
    {
      const double lower = problem.lower[i], upper = problem.upper[i];
      const auto   variable = "design variable " + std::to_string(i);
      if (!std::isfinite(lower) || !std::isfinite(upper) || lower > upper)
        throw InputError(variable + ": bounds " + std::to_string(lower) + ", " +
                         std::to_string(upper) + ": must be finite, the lower one first");
      if (!std::isfinite(problem.start[i]))
        throw InputError(variable + ": the start must be finite");
    }
}

void check_finite(const bool is_finite)
{
  if (!is_finite)
    throw SolveError("the objective, a constraint or one of their "
                     "derivatives is not a finite number");
}

void check_derivatives(const Evaluation &evaluation, const std::size_t n_variables)
{
  (void)n_variables;
  SNUG_ASSERT_EQUAL(evaluation.gradient.size(), n_variables);
  SNUG_ASSERT_EQUAL(evaluation.jacobian.size(), evaluation.constraints.size());
  check_finite(all_finite(evaluation.gradient));
  for (const auto &row : evaluation.jacobian)
    {
      SNUG_ASSERT_EQUAL(row.size(), n_variables);
      check_finite(all_finite(row));
    }
}
} // namespace

ScaledProblem::ScaledProblem(const DesignProblem &the_problem)
  : problem(the_problem), constraint_relations(problem.relations)
{
  check_bounds(problem);
  for (unsigned int i = 0; i < problem.start.size(); ++i)
    {
      const double lower = problem.lower[i], upper = problem.upper[i];
      x_start.push_back(std::clamp(problem.start[i], lower, upper));
      const double width = upper > lower ? upper - lower : 1.;
      lengths.push_back(problem.lengths.empty() ? width / 10.
                                                : std::min(width, problem.lengths[i]));
      y_lower.push_back((lower - x_start[i]) / lengths[i]);
      y_upper.push_back((upper - x_start[i]) / lengths[i]);
    }
  const auto start = evaluated(std::vector<double>(x_start.size(), 0.));
  scale_constraints(*start);
  start_point = remembered(start);

  const double slope = norm(gradient(*start_point));
  scale              = std::abs(start_point->evaluation.objective);
  if (slope > 0.)
    scale = std::clamp(scale, slope / 100., slope * 100.);
  else if (scale == 0.)
    scale = 1.;
  start_gradient_norm = slope / scale;
}

/// Set the scales of the constraints. Their minimum is a hundredth of the slope, as for the
/// objective, because the scale of a limit that is round-off, such as of a displacement that
/// symmetry forbids, would magnify the errors of states.
void ScaledProblem::scale_constraints(const Point &start)
{
  const auto slopes = jacobian(start); // with scales 1
  if (problem.constraint_scales.empty())
    {
      scales.assign(slopes.size(), 1.);
      return;
    }
  scales = problem.constraint_scales;
  for (unsigned int j = 0; j < scales.size(); ++j)
    {
      const double slope = norm(slopes[j]);
      scales[j]          = scales[j] > 0. ? std::max(scales[j], slope / 100.) : slope;
      if (scales[j] == 0.)
        scales[j] = 1.;
    }
}

std::vector<double> ScaledProblem::design(const std::vector<double> &y) const
{
  std::vector<double> x(y.size());
  for (unsigned int i = 0; i < y.size(); ++i)
    if (y[i] <= y_lower[i])
      x[i] = problem.lower[i];
    else if (y[i] >= y_upper[i])
      x[i] = problem.upper[i];
    else
      x[i] = std::clamp(x_start[i] + lengths[i] * y[i], problem.lower[i], problem.upper[i]);
  return x;
}

std::vector<double> ScaledProblem::scaled(const std::vector<double> &x) const
{
  std::vector<double> y(x.size());
  for (unsigned int i = 0; i < x.size(); ++i)
    y[i] = (x[i] - x_start[i]) / lengths[i];
  return y;
}

std::shared_ptr<const ScaledProblem::Point> ScaledProblem::find(const std::vector<double> &y) const
{
  for (const auto &point : recent)
    if (is_same(point->y, y))
      return point;
  return nullptr;
}

std::shared_ptr<const ScaledProblem::Point> ScaledProblem::at(const std::vector<double> &y)
{
  if (auto known = find(y))
    return known;
  return remembered(evaluated(y));
}

std::shared_ptr<const ScaledProblem::Point> ScaledProblem::settled_at(const std::vector<double> &y)
{
  return at(problem.settle ? scaled(problem.settle(design(y))) : y);
}

std::shared_ptr<ScaledProblem::Point> ScaledProblem::evaluated(const std::vector<double> &y)
{
  auto point = std::make_shared<Point>();
  point->y   = y;
  point->x   = design(y);
  ++evaluations;
  point->evaluation = problem.evaluate(point->x);
  check_finite(std::isfinite(point->evaluation.objective) &&
               all_finite(point->evaluation.constraints));
  if (!problem.differentiate)
    check_derivatives(point->evaluation, y.size());
  return point;
}

const Evaluation &ScaledProblem::differentiated(const Point &point) const
{
  if (point.evaluation.gradient.empty() && problem.differentiate)
    {
      problem.differentiate(point.x, point.evaluation);
      check_derivatives(point.evaluation, point.x.size());
    }
  return point.evaluation;
}

std::shared_ptr<const ScaledProblem::Point>
ScaledProblem::remembered(const std::shared_ptr<Point> &point)
{
  const auto c = constraints(point->evaluation);
  if (constraint_relations.empty()) // the first design
    constraint_relations.resize(c.size(), Relation::equal);
  SNUG_ASSERT_EQUAL(constraint_relations.size(), c.size());
  for (unsigned int j = 0; j < c.size(); ++j)
    point->violation =
      std::max(point->violation, optimization::violation(constraint_relations[j], c[j]));
  recent.push_front(point);
  if (recent.size() > n_remembered)
    recent.pop_back();
  return point;
}

double ScaledProblem::length(const std::vector<double> &d) const
{
  return largest(std::vector<double>(d.begin(), d.begin() + n_nonlinear()));
}

std::vector<double> ScaledProblem::gradient(const Point &point) const
{
  const auto         &evaluation = differentiated(point);
  std::vector<double> result(lengths.size());
  for (unsigned int i = 0; i < lengths.size(); ++i)
    result[i] = lengths[i] * evaluation.gradient[i] / scale;
  return result;
}

std::vector<std::vector<double>> ScaledProblem::jacobian(const Point &point) const
{
  auto result = differentiated(point).jacobian;
  for (unsigned int j = 0; j < result.size(); ++j)
    for (unsigned int i = 0; i < lengths.size(); ++i)
      result[j][i] *= lengths[i] / (scales.empty() ? 1. : scales[j]);
  return result;
}

std::vector<double> ScaledProblem::constraints(const Evaluation &evaluation) const
{
  auto result = evaluation.constraints;
  SNUG_ASSERT(scales.empty() || scales.size() == result.size(), "each constraint has a scale");
  for (unsigned int j = 0; j < scales.size(); ++j)
    result[j] /= scales[j];
  return result;
}

/// Return whether constraint @p j with the value @p c / s_j restricts the design.
bool ScaledProblem::is_active(const unsigned int j, const double c) const
{
  return constraint_relations[j] == Relation::equal || c >= -at_limit;
}

bool ScaledProblem::is_blind(const Point &point) const
{
  const auto A = jacobian(point);
  const auto c = constraints(point.evaluation);
  for (unsigned int j = 0; j < A.size(); ++j)
    if (is_active(j, c[j]) && norm(A[j]) <= no_slope)
      return true;
  return false;
}

ScaledProblem::Prediction ScaledProblem::predicted(const Point               &at,
                                                   const std::vector<double> &d) const
{
  const auto         &known = differentiated(at);
  std::vector<double> dx;
  for (unsigned int i = 0; i < lengths.size(); ++i)
    dx.push_back(lengths[i] * d[i]);
  Evaluation expected;
  if (problem.predict && !known.linearization.empty())
    expected = problem.predict(known, dx);
  else
    {
      expected = known;
      expected.objective += dot(known.gradient, dx);
      for (unsigned int j = 0; j < known.constraints.size(); ++j)
        expected.constraints[j] += dot(known.jacobian[j], dx);
    }
  Prediction result{expected.objective / scale, std::move(expected.gradient), constraints(expected),
                    std::move(expected.jacobian)};
  for (unsigned int i = 0; i < lengths.size(); ++i)
    {
      result.gradient[i] *= lengths[i] / scale;
      for (unsigned int j = 0; j < result.jacobian.size(); ++j)
        result.jacobian[j][i] *= lengths[i] / scales[j];
    }
  return result;
}

ProjectedGradient ScaledProblem::projected(const Prediction              &at,
                                           const std::vector<BoundState> &at_bounds) const
{
  std::vector<ConstraintGradient> active;
  std::vector<unsigned int>       numbers;
  for (unsigned int j = 0; j < at.jacobian.size(); ++j)
    // a direction made of round-off would take its part of the gradient
    if (is_active(j, at.constraints[j]) && norm(at.jacobian[j]) > no_slope)
      {
        active.push_back({at.jacobian[j], constraint_relations[j] == Relation::at_most});
        numbers.push_back(j);
      }
  const auto        found = optimization::projected_gradient(at.gradient, active, at_bounds);
  ProjectedGradient result{found.norm, std::vector<double>(constraint_relations.size(), 0.)};
  for (unsigned int k = 0; k < numbers.size(); ++k)
    result.multipliers[numbers[k]] = found.multipliers[k];
  return result;
}

ProjectedGradient ScaledProblem::projected(const Point &point) const
{
  std::vector<BoundState> at_bounds(lengths.size(), BoundState::inside);
  for (unsigned int i = 0; i < lengths.size(); ++i)
    {
      const bool below = point.y[i] <= y_lower[i] + at_bound;
      const bool above = point.y[i] >= y_upper[i] - at_bound;
      if (below || above)
        at_bounds[i] = below && above ? BoundState::fixed
                       : below        ? BoundState::at_lower
                                      : BoundState::at_upper;
    }
  return projected({point.evaluation.objective / scale, gradient(point),
                    constraints(point.evaluation), jacobian(point)},
                   at_bounds);
}

double ScaledProblem::projected_gradient(const Point &point) const
{
  const double size = std::max(norm(gradient(point)), start_gradient_norm);
  return size == 0. ? 0. : projected(point).norm / size;
}

std::vector<double> ScaledProblem::multipliers(const Point &point) const
{
  return projected(point).multipliers;
}
} // namespace snug::optimization
