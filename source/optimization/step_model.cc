#include <snug/base/narrow.h>
#include <snug/optimization/dense_vectors.h>
#include <snug/optimization/step_model.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlopt.hpp>

namespace snug::optimization {
namespace {
using Vector = std::vector<double>;

/// Constraints that are predicted to be violated by less, relative to their scales, are met.
constexpr double is_met = 1e-9;

/// NLopt's tolerances are for steps that are longer than this part of the unit.
constexpr double well_scaled = 1e-2;

/// A variable of a step closer to the end of its box, relative to the radius, is there.
constexpr double at_end = 1e-6;

/// This struct provides the callbacks of NLopt for a model, in steps z = d / unit and functions
/// whose slopes are 1.
struct Subproblem
{
  const StepModel             &model;
  const std::vector<Relation> &relations;
  double                       unit, scale, value; ///< the objective is (f - value) / scale
  Vector                       slopes;             ///< of the constraints at z = 0
  Vector                       allowed;            ///< violations
  /// @name If variables enter linearly, the best of all steps that NLopt tries, after settle().
  /// NLopt itself returns the best step that meets all constraints. This may be the first step,
  /// because NLopt meets constraints with kinks to about 1e-6 only.
  /// @{
  std::function<void(Vector &)> settle         = {};
  mutable Vector                best           = {};
  mutable double                best_objective = std::numeric_limits<double>::infinity();
  /// @}

  Vector settled(const double *z) const
  {
    Vector d(z, z + model.size());
    for (double &entry : d)
      entry *= unit;
    settle(d);
    for (double &entry : d)
      entry /= unit;
    return d;
  }

  void try_settled(const double *z) const
  {
    const auto  step  = settled(z);
    const auto &there = at(step.data());
    for (unsigned int j = 0; j < relations.size(); ++j)
      if (optimization::violation(relations[j], there.constraints[j]) > allowed[j] + is_met)
        return;
    if (!(there.objective < best_objective))
      return;
    best_objective = there.objective;
    best           = step;
  }

  const ScaledProblem::Prediction &at(const double *z) const
  {
    Vector d(z, z + model.size());
    for (double &entry : d)
      entry *= unit;
    return model(d);
  }

  static double objective(unsigned int n, const double *z, double *gradient, void *data)
  {
    const auto &self = *static_cast<Subproblem *>(data);
    if (self.settle)
      self.try_settled(z);
    const auto &predicted = self.at(z);
    if (gradient != nullptr)
      for (unsigned int i = 0; i < n; ++i)
        gradient[i] = predicted.gradient[i] * self.unit / self.scale;
    return (predicted.objective - self.value) / self.scale;
  }

  template <Relation relation>
  static void constraints(unsigned int,
                          double       *values,
                          unsigned int  n,
                          const double *z,
                          double       *jacobian,
                          void         *data)
  {
    const auto &self      = *static_cast<Subproblem *>(data);
    const auto &predicted = self.at(z);
    for (unsigned int j = 0; j < self.relations.size(); ++j)
      if (self.relations[j] == relation)
        {
          *values++ = (predicted.constraints[j] - self.allowed[j]) / self.slopes[j];
          if (jacobian != nullptr)
            for (unsigned int i = 0; i < n; ++i)
              *jacobian++ = predicted.jacobian[j][i] * self.unit / self.slopes[j];
        }
  }

  Vector violations(const Vector &z) const
  {
    Vector result = at(z.data()).constraints;
    for (unsigned int j = 0; j < relations.size(); ++j)
      result[j] = optimization::violation(relations[j], result[j]);
    return result;
  }

  /// Return half the sum of the squares of the violations, relative to the slopes.
  static double squared_violation(unsigned int n, const double *z, double *gradient, void *data)
  {
    const auto &self      = *static_cast<Subproblem *>(data);
    const auto &predicted = self.at(z);
    double      sum       = 0.;
    if (gradient != nullptr)
      std::fill(gradient, gradient + n, 0.);
    for (unsigned int j = 0; j < self.relations.size(); ++j)
      {
        const double v =
          optimization::violation(self.relations[j], predicted.constraints[j]) / self.slopes[j];
        sum += v * v / 2.;
        if (gradient != nullptr)
          for (unsigned int i = 0; i < n; ++i)
            gradient[i] += v * predicted.jacobian[j][i] * self.unit / self.slopes[j];
      }
    return sum;
  }
};

/// Return NLopt's SLSQP in a box, with at most a thousand evaluations of the model.
nlopt::opt optimizer(const Vector &lower, const Vector &upper)
{
  nlopt::opt result(nlopt::LD_SLSQP, narrow<unsigned int>(lower.size()));
  result.set_lower_bounds(lower);
  result.set_upper_bounds(upper);
  result.set_ftol_rel(1e-12);
  result.set_maxeval(1000);
  return result;
}

/// Minimize from @p z on. If NLopt fails, @p z is its last result.
void minimize(nlopt::opt &optimizer, Vector &z)
{
  double f = 0.;
  try
    {
      optimizer.optimize(z, f);
    }
  catch (const std::runtime_error &)
    {
      // round-off, or constraints without a solution
    }
}
} // namespace

StepModel::StepModel(const ScaledProblem        &the_problem,
                     const ScaledProblem::Point &the_point,
                     const SecantHessian        &the_hessian)
  : problem(the_problem), at(the_point), hessian(the_hessian)
{}

const ScaledProblem::Prediction &StepModel::operator()(const Vector &d) const
{
  if (d != last)
    {
      predicted     = problem.predicted(at, d);
      const auto Bd = hessian.times(d);
      predicted.objective += dot(d, Bd) / 2.;
      add(predicted.gradient, 1., Bd);
      last = d;
    }
  return predicted;
}

void StepModel::box(const double radius, Vector &lower, Vector &upper) const
{
  for (unsigned int i = 0; i < size(); ++i)
    {
      // The model is exact in variables that enter linearly.
      const double reach =
        i < problem.n_nonlinear() ? radius : std::numeric_limits<double>::infinity();
      lower.push_back(std::max(-reach, problem.lower()[i] - at.y[i]));
      upper.push_back(std::min(reach, problem.upper()[i] - at.y[i]));
    }
}

Vector StepModel::minimizer(const double radius) const
{
  Vector d(size(), 0.);
  for (double unit = radius; unit > 1e-9 * radius;)
    {
      d                   = minimize_from(d, radius, unit);
      const double length = problem.length(d);
      if (length > well_scaled * unit)
        break;
      unit *= std::max(10. * length / unit, well_scaled);
    }
  return d;
}

/// Set the variables of @p d that enter linearly to the smallest values at which the constraints
/// that they relax are met. The objective and the other constraints increase with these variables.
void StepModel::settle(Vector &d) const
{
  const auto &there = (*this)(d);
  const auto &c     = there.constraints;
  for (unsigned int i = problem.n_nonlinear(); i < size(); ++i)
    {
      double change = -std::numeric_limits<double>::infinity();
      for (unsigned int j = 0; j < c.size(); ++j)
        if (const double slope = there.jacobian[j][i]; slope < 0.)
          change = std::max(change, -c[j] / slope);
      if (std::isfinite(change))
        d[i] += change;
    }
}

/// Return the minimizer that NLopt finds from @p d on, in steps d / @p unit.
Vector StepModel::minimize_from(const Vector &d, const double radius, const double unit) const
{
  const auto &relations = problem.relations();
  Vector      lower, upper, z(d);
  box(radius, lower, upper);
  for (auto *v : {&lower, &upper, &z})
    for (double &entry : *v)
      entry /= unit;
  // NLopt throws if rounding puts the first step outside of the box.
  for (unsigned int i = 0; i < size(); ++i)
    z[i] = std::clamp(z[i], lower[i], upper[i]);
  const auto here = (*this)(Vector(size(), 0.));
  Subproblem subproblem{*this,
                        relations,
                        unit,
                        std::max(norm(here.gradient) * unit, std::numeric_limits<double>::min()),
                        here.objective,
                        {},
                        Vector(relations.size(), 0.)};
  for (const auto &row : here.jacobian)
    subproblem.slopes.push_back(std::max(norm(row), ScaledProblem::no_slope) * unit);

  auto       best    = optimizer(lower, upper);
  const auto n_equal = std::count(relations.begin(), relations.end(), Relation::equal);
  const auto n_other = static_cast<std::ptrdiff_t>(relations.size()) - n_equal;
  best.set_ftol_abs(1e-14);
  best.set_xtol_abs(1e-9);
  best.set_min_objective(&Subproblem::objective, &subproblem);
  if (n_equal > 0)
    best.add_equality_mconstraint(&Subproblem::constraints<Relation::equal>, &subproblem,
                                  Vector(n_equal, 1e-12));
  if (n_other > 0)
    best.add_inequality_mconstraint(&Subproblem::constraints<Relation::at_most>, &subproblem,
                                    Vector(n_other, 1e-12));
  if (problem.n_nonlinear() < size())
    subproblem.settle = [this](Vector &step) { settle(step); };
  const auto minimize_and_settle = [&] {
    minimize(best, z);
    if (!subproblem.best.empty())
      z = subproblem.best;
  };
  minimize_and_settle();
  if (largest(subproblem.violations(z)) > is_met)
    {
      z.assign(size(), 0.);
      auto nearest = optimizer(lower, upper);
      nearest.set_min_objective(&Subproblem::squared_violation, &subproblem);
      minimize(nearest, z);
      // Violations of terms may be smaller than those of their maximum, which is what counts.
      if (subproblem.settle)
        z = subproblem.settled(z.data());
      subproblem.allowed = subproblem.violations(z);
      for (double &allowed : subproblem.allowed)
        if (std::abs(allowed) <= is_met)
          allowed = 0.;
      minimize_and_settle();
    }
  for (unsigned int i = 0; i < size(); ++i)
    z[i] = std::clamp(z[i], lower[i], upper[i]) * unit;
  return z;
}

Vector StepModel::multipliers(const Vector &d, const double radius) const
{
  const auto there = (*this)(d);
  Vector     lower, upper;
  box(radius, lower, upper);
  std::vector<BoundState> states;
  for (unsigned int i = 0; i < size(); ++i)
    states.push_back(d[i] <= lower[i] + at_end * radius   ? BoundState::at_lower
                     : d[i] >= upper[i] - at_end * radius ? BoundState::at_upper
                                                          : BoundState::inside);
  return problem.projected(there, states).multipliers;
}
} // namespace snug::optimization
