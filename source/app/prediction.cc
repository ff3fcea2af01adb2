#include <snug/app/objective.h>

#include <algorithm>
#include <map>

namespace snug::app {
using optimization::Evaluation;

namespace {
/// Step of the differences by which areas are differentiated, relative to the first
/// steps of the search.
constexpr double area_step = 1e-3;

/// Minimum of predicted areas, relative to the areas of the design.
constexpr double least_area = 1e-3;

} // namespace

/// This class represents the contact rows of one load case as linear functions of the design. Its
/// numbers are the forces and the areas of all rows, and then for each variable their derivatives.
template <int dim>
class Objective<dim>::LinearRows
{
public:
  LinearRows(const double *numbers, const unsigned int n_rows, const unsigned int n_variables)
    : numbers(numbers), n_rows(n_rows), n_variables(n_variables)
  {}

  static unsigned int size(unsigned int n_rows, unsigned int n_variables)
  {
    return 2 * n_rows * (1 + n_variables);
  }

  /// Return the forces and the areas at the distance @p dx from the design. Forces below zero are
  /// those of open rows and become zero.
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

  /// Add factor dJ/dx_j to gradient_j.
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

template <int dim>
bool Objective<dim>::measures_contact(const response::Response<dim> &response) const
{
  const std::vector<double> none(problem.solver->contact(0).n_rows(), 0.);
  return response.of_contact(*problem.solver, 0, {none, none}).has_value();
}

template <int dim>
bool Objective<dim>::is_predicted() const
{
  const auto &method = problem.scene.gradient.method;
  if (method ? *method != sensitivity::Method::direct
             : problem.shapes->n_variables() > most_predicted)
    return false;
  return std::any_of(quantities.begin(), quantities.end(), [&](const Quantity &quantity) {
    return measures_contact(*quantity.response);
  });
}

/// Return the LinearRows of all load cases at a design, one after the other. Collective.
template <int dim>
std::vector<double> Objective<dim>::linearized_contact(const Analysis<dim> &at) const
{
  using Numbers             = std::vector<double>;
  const unsigned int n      = problem.shapes->n_variables();
  const auto         steps  = problem.shapes->first_steps();
  const auto        &solver = *problem.solver;
  std::map<const contact::Contact<dim> *, std::vector<Numbers>> by_area; // per variable
  const auto here = solver.surface().gather(problem.positions(at.design));
  for (unsigned int j = 0; j < n; ++j)
    {
      const double h        = area_step * steps[j];
      const auto   velocity = solver.surface().gather(problem.shapes->column(j));
      auto         after = here, before = here;
      for (unsigned int i = 0; i < here.size(); ++i)
        {
          after[i] += h * velocity[i];
          before[i] -= h * velocity[i];
        }
      for (const unsigned int c : solver.positions())
        {
          auto       areas = solver.contact(c).areas(after);
          const auto other = solver.contact(c).areas(before);
          for (unsigned int i = 0; i < areas.size(); ++i)
            areas[i] = (areas[i] - other[i]) / (2. * h);
          by_area[&solver.contact(c)].push_back(std::move(areas));
        }
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
Evaluation Objective<dim>::predicted(const Evaluation &at, const std::vector<double> &dx) const
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
  Evaluation result = at;
  const auto linear = [&](double &value, const std::vector<double> &gradient) {
    for (unsigned int j = 0; j < n; ++j)
      value += gradient[j] * dx[j];
  };
  linear(result.objective, at.gradient);
  for (unsigned int j = 0; j < at.constraints.size(); ++j)
    linear(result.constraints[j], at.jacobian[j]);
  for (unsigned int i = 0; i < quantities.size(); ++i)
    if (measures_contact(*quantities[i].response))
      predict(i, of_cases, rows, result);
  return result;
}

/// Predict quantity @p i and the terms of its maxima, of a response that measures contact.
template <int dim>
void Objective<dim>::predict(const unsigned int                         i,
                             const std::vector<LinearRows>             &of_cases,
                             const std::vector<response::PressureRows> &rows,
                             Evaluation                                &result) const
{
  const Quantity                 &quantity = quantities[i];
  const unsigned int              n        = problem.shapes->n_variables();
  std::vector<response::Measured> measured;
  std::vector<double>             values;
  for (const unsigned int c : quantity.load_cases)
    {
      measured.push_back(*quantity.response->of_contact(*problem.solver, c, rows[c]));
      values.push_back(measured.back().value);
    }
  const auto gradient = [&](const std::vector<double> &factors) {
    std::vector<double> sum(n, 0.);
    for (unsigned int k = 0; k < factors.size(); ++k)
      if (factors[k] != 0.)
        of_cases[quantity.load_cases[k]].add(measured[k], factors[k], sum);
    return sum;
  };
  const auto combined = quantity.combined(values);
  if (i == 0)
    {
      result.objective = combined.value;
      result.gradient  = gradient(combined.factors);
    }
  else
    {
      auto factors = combined.factors;
      for (double &factor : factors)
        factor *= quantity.sign();
      result.constraints[i - 1] = quantity.sign() * (combined.value - quantity.target);
      result.jacobian[i - 1]    = gradient(factors);
    }
  unsigned int k = 0;
  for (const auto &maximum : maxima())
    if (maximum.of == static_cast<int>(i) - 1)
      {
        const auto factors = quantity.term_factors(k++);
        for (unsigned int c = 0; c < factors.size(); ++c)
          {
            std::vector<double> factor(factors.size(), 0.);
            factor[c]                             = factors[c];
            result.constraints[maximum.begin + c] = factors[c] * values[c];
            result.jacobian[maximum.begin + c]    = gradient(factor);
          }
      }
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template bool Objective<dim>::measures_contact(const response::Response<dim> &) const;           \
  template bool Objective<dim>::is_predicted() const;                                              \
  template std::vector<double> Objective<dim>::linearized_contact(const Analysis<dim> &) const;    \
  template void Objective<dim>::predict(unsigned int, const std::vector<LinearRows> &,             \
                                        const std::vector<response::PressureRows> &, Evaluation &) \
    const;                                                                                         \
  template Evaluation Objective<dim>::predicted(const Evaluation &, const std::vector<double> &)   \
    const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
