#include <snug/app/evaluator.h>

#include <algorithm>
#include <map>

namespace snug::app {
using optimization::Evaluation;

namespace {
/// Step of the differences by which areas are differentiated, relative to the first
/// steps of the search.
constexpr double area_step = 1e-3;

/// Areas do not fall below this part of what they were.
constexpr double least_area = 1e-3;

/// The contact rows of one load case as linear functions of the design: for each row its force and
/// its area, and then for each variable their derivatives.
class LinearRows
{
public:
  LinearRows(const double *numbers, const unsigned int n_rows, const unsigned int n_variables)
    : numbers(numbers), n_rows(n_rows), n_variables(n_variables)
  {}

  static unsigned int size(unsigned int n_rows, unsigned int n_variables)
  {
    return 2 * n_rows * (1 + n_variables);
  }

  /// Forces below zero are those of open rows.
  response::PressureRows at(const std::vector<double> &dx) const
  {
    response::PressureRows rows{{force(0), force(0) + n_rows}, {area(0), area(0) + n_rows}};
    for (unsigned int j = 0; j < n_variables; ++j)
      for (unsigned int i = 0; i < n_rows; ++i)
        {
          rows.force[i] += dx[j] * force(1 + j)[i];
          rows.area[i] += dx[j] * area(1 + j)[i];
        }
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        rows.force[i] = std::max(0., rows.force[i]);
        rows.area[i]  = std::max(least_area * area(0)[i], rows.area[i]);
      }
    return rows;
  }

  /// gradient_j += factor dJ/dx_j.
  void
  add(const response::Measured &measured, const double factor, std::vector<double> &gradient) const
  {
    for (unsigned int j = 0; j < n_variables; ++j)
      for (unsigned int i = 0; i < n_rows; ++i)
        gradient[j] +=
          factor * (measured.by_force[i] * force(1 + j)[i] + measured.by_area[i] * area(1 + j)[i]);
  }

private:
  const double *numbers;
  unsigned int  n_rows, n_variables;

  /// Return the forces of @p place: the values at place 0, then the derivatives with respect to
  /// each variable.
  const double *force(unsigned int place) const { return numbers + 2 * place * n_rows; }
  const double *area(unsigned int place) const { return force(place) + n_rows; }
};
} // namespace

template <int dim>
bool Evaluator<dim>::measures_contact(const response::Response<dim> &response) const
{
  const std::vector<double> none(problem.solver->contact(0).n_rows(), 0.);
  return response.of_contact(*problem.solver, 0, {none, none}).has_value();
}

template <int dim>
bool Evaluator<dim>::is_predicted() const
{
  const auto &method = problem.scene.gradient.method;
  if (method ? *method != sensitivity::Method::direct
             : problem.shapes->n_variables() > most_predicted)
    return false;
  return measures_contact(*problem.objective) ||
         std::any_of(constraints.begin(), constraints.end(), [&](const Constraint &constraint) {
           return measures_contact(*constraint.response);
         });
}

/// Return the LinearRows of all load cases at a design, one after the other. Collective.
template <int dim>
std::vector<double> Evaluator<dim>::linearized_contact(const Analysis<dim> &at) const
{
  using Numbers                                       = std::vector<double>;
  const unsigned int                           n      = problem.shapes->n_variables();
  const auto                                   steps  = problem.shapes->first_steps();
  const auto                                  &solver = *problem.solver;
  std::map<const void *, std::vector<Numbers>> by_area; // per contact of a position and variable
  for (const unsigned int c : solver.positions())
    for (unsigned int j = 0; j < n; ++j)
      {
        const auto areas_at = [&](const double h) {
          auto moved = at.design;
          moved[j] += h;
          return solver.contact(c).areas(solver.surface().gather(problem.positions(moved)));
        };
        const double h     = area_step * steps[j];
        auto         areas = areas_at(h);
        const auto   other = areas_at(-h);
        for (unsigned int i = 0; i < areas.size(); ++i)
          areas[i] = (areas[i] - other[i]) / (2. * h);
        by_area[&solver.contact(c)].push_back(std::move(areas));
      }
  std::vector<double> result;
  for (unsigned int c = 0; c < at.states.size(); ++c)
    {
      for (const auto &point : at.states[c].contact)
        result.push_back(point.force);
      for (const auto &point : at.states[c].contact)
        result.push_back(point.area);
      for (unsigned int j = 0; j < n; ++j)
        {
          const auto &forces = at.gradients.forces[c * n + j];
          result.insert(result.end(), forces.begin(), forces.end());
          const auto &areas = by_area.at(&solver.contact(c))[j];
          result.insert(result.end(), areas.begin(), areas.end());
        }
    }
  return result;
}

/**
 * Return the prediction at the distance @p dx from a design. Responses that are functions of
 * contact forces and areas are computed from the forces and areas of LinearRows; other responses
 * are linear. A peak or a norm of pressures has far more curvature within a step than the
 * pressures.
 */
template <int dim>
Evaluation Evaluator<dim>::predicted(const Evaluation &at, const std::vector<double> &dx) const
{
  const auto                         &solver = *problem.solver;
  const unsigned int                  n      = dx.size();
  std::vector<LinearRows>             of_cases;
  std::vector<response::PressureRows> rows;
  const double                       *numbers = at.linearization.data();
  for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
    {
      const unsigned int n_rows = solver.contact(c).n_rows();
      of_cases.emplace_back(numbers, n_rows, n);
      numbers += LinearRows::size(n_rows, n);
      rows.push_back(of_cases.back().at(dx));
    }
  const auto linear = [&](const double value, const std::vector<double> &gradient) {
    double sum = value;
    for (unsigned int j = 0; j < n; ++j)
      sum += gradient[j] * dx[j];
    return sum;
  };
  Evaluation result = at;
  if (measures_contact(*problem.objective))
    {
      std::vector<response::Measured> measured;
      std::vector<double>             values;
      for (unsigned int c = 0; c < rows.size(); ++c)
        {
          measured.push_back(*problem.objective->of_contact(solver, c, rows[c]));
          values.push_back(measured.back().value);
        }
      const auto combined = problem.combined(values);
      result.objective    = combined.value;
      result.gradient.assign(n, 0.);
      for (unsigned int c = 0; c < rows.size(); ++c)
        of_cases[c].add(measured[c], combined.factors[c], result.gradient);
    }
  else
    result.objective = linear(at.objective, at.gradient);
  for (unsigned int k = 0; k < constraints.size(); ++k)
    {
      const auto &constraint = constraints[k];
      const auto  measured =
        constraint.response->of_contact(solver, constraint.load_case, rows[constraint.load_case]);
      if (!measured)
        {
          result.constraints[k] = linear(at.constraints[k], at.jacobian[k]);
          continue;
        }
      result.constraints[k] = constraint.sign() * (measured->value - constraint.target);
      result.jacobian[k].assign(n, 0.);
      of_cases[constraint.load_case].add(*measured, constraint.sign(), result.jacobian[k]);
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                                    \
  template bool Evaluator<dim>::measures_contact(const response::Response<dim> &) const;         \
  template bool Evaluator<dim>::is_predicted() const;                                            \
  template std::vector<double> Evaluator<dim>::linearized_contact(const Analysis<dim> &) const;  \
  template Evaluation Evaluator<dim>::predicted(const Evaluation &, const std::vector<double> &) \
    const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
