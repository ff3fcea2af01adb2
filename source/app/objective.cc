#include <snug/app/objective.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace snug::app {
namespace {
/// Relative tolerance of the derivatives of states in a search. Measured: 1e-6 takes the same
/// designs as 1e-8 with a fifth of the F-mults less, and 1e-4 takes more designs.
constexpr double derivative_tolerance = 1e-6;
} // namespace

template <int dim>
Objective<dim>::Objective(const ShapeProblem<dim> &problem,
                          Analyses<dim>           &analyses,
                          const Design            &paired)
  : problem(problem), analyses(analyses)
{
  const auto start    = problem.shapes->start();
  const bool re_pairs = is_relative_to_first() && paired != start;
  if (re_pairs)
    analyses.pair(start);
  Quantity objective;
  // The problem owns the objective.
  objective.response    = {std::shared_ptr<void>(), problem.objective.get()};
  objective.combination = problem.scene.optimization.combine;
  for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
    objective.load_cases.push_back(c);
  add_quantity(std::move(objective));
  for (const auto &[name, limit] : problem.scene.optimization.constraints)
    add_quantity(make_constraint(name, limit));
  if (re_pairs)
    analyses.pair(paired);
}

template <int dim>
Objective<dim>
Objective<dim>::with_objective(std::shared_ptr<const response::Response<dim>> response) const
{
  Objective result = *this;
  for (std::size_t i = 0; i < quantities.front().load_cases.size(); ++i)
    result.measured[i].response = response.get();
  result.quantities.front().response = std::move(response);
  result.differentiated.clear();
  return result;
}

template <int dim>
bool Objective<dim>::limits_geometry() const
{
  return std::any_of(quantities.begin() + 1, quantities.end(), [](const Quantity &constraint) {
    return !constraint.response->needs_solution();
  });
}

template <int dim>
void Objective<dim>::add_quantity(Quantity quantity)
{
  if (quantity.load_cases.size() == 1 && quantity.combination.n_maxima() == 1)
    quantity.combination = {}; // a maximum of one value
  quantity.first = measured.size();
  if (quantity.weights.empty())
    for (const unsigned int c : quantity.load_cases)
      quantity.weights.push_back(problem.weight(c));
  for (const unsigned int c : quantity.load_cases)
    measured.push_back({quantity.response.get(), c});
  quantities.push_back(std::move(quantity));
}

template <int dim>
std::vector<double> Objective<dim>::Quantity::term_factors(const unsigned int k) const
{
  auto factors = weights;
  // The second maximum of a range is that of the negative values.
  for (double &factor : factors)
    factor *= k == 0 ? 1. : -1.;
  return factors;
}

/// Return whether a limit needs the states of the first design.
template <int dim>
bool Objective<dim>::is_relative_to_first() const
{
  const auto &constraints = problem.scene.optimization.constraints;
  return std::any_of(constraints.begin(), constraints.end(), [&](const auto &constraint) {
    const auto of = scene::constraint_name(problem.scene, constraint.first);
    return optimization::read_limit(constraint.second).of_initial &&
           problem.make_response(of.response)->needs_solution();
  });
}

template <int dim>
typename Objective<dim>::Quantity Objective<dim>::make_constraint(const std::string &name,
                                                                  const std::string &limit)
{
  const auto of    = scene::constraint_name(problem.scene, name);
  const auto bound = optimization::read_limit(limit);
  Quantity   constraint;
  constraint.name     = optimization::constraint_text(name, limit);
  constraint.of       = of.response;
  constraint.response = problem.make_response(of.response);
  constraint.target   = bound.value;
  constraint.side     = bound.side;
  if (of.combination)
    {
      constraint.combination = *of.combination;
      for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
        constraint.load_cases.push_back(c);
    }
  else
    {
      constraint.load_cases = {of.load_case.value_or(0)};
      constraint.weights    = {1.};
    }
  if (!bound.of_initial)
    return constraint;
  States geometry(1); // without a solution
  geometry.front().positions = problem.positions(problem.shapes->start());
  if (constraint.response->needs_solution())
    constraint.target *= constraint.combined(values(constraint, analyses.first_states())).value;
  else
    constraint.target *= constraint.response->value(*problem.solver, geometry.front());
  return constraint;
}

/// Return the values of the response of a quantity in its load cases.
template <int dim>
std::vector<double> Objective<dim>::values(const Quantity &quantity, const States &states) const
{
  std::vector<double> result;
  for (const unsigned int c : quantity.load_cases)
    result.push_back(quantity.response->value(*problem.solver, states[c]));
  return result;
}

template <int dim>
optimization::Evaluation Objective<dim>::evaluate(const Design &design)
{
  const States            &states = analyses.solve(design).states;
  optimization::Evaluation evaluation;
  const auto               found = values(states);
  evaluation.objective           = found.objective;
  evaluation.constraints         = found.constraints;
  evaluation.reported            = problem.reported_values(states);
  evaluation.reported.insert(evaluation.reported.end(), found.constrained.begin(),
                             found.constrained.end());
  for (const auto &state : states)
    {
      evaluation.active_contacts += state.active_contacts;
      evaluation.f_mults += state.f_mults;
    }
  evaluation.least_scaled_jacobian = states.front().least_scaled_jacobian;
  evaluation.seconds               = problem.context.seconds();
  return evaluation;
}

template <int dim>
const sensitivity::Gradients<dim> &Objective<dim>::gradients(const Design &design)
{
  const auto *last       = analyses.last(design);
  const bool  is_known   = last && !last->gradients.of_response.empty() && differentiated == design;
  auto        parameters = problem.scene.gradient;
  if (parameters.method == sensitivity::Method::energy) // does not hold for every constraint
    parameters.method.reset();
  if (is_predicted())
    {
      parameters.method          = sensitivity::Method::direct;
      parameters.state_tolerance = derivative_tolerance;
    }
  const auto &found = analyses.gradients(design, measured, parameters);
  if (is_known)
    return combined;
  combined             = {};
  combined.f_mults     = found.f_mults;
  combined.seconds     = found.seconds;
  combined.of_response = combined_gradients(analyses.at(design).states, found.of_response);
  differentiated       = design;
  return combined;
}

template <int dim>
std::vector<sensitivity::Gradient<dim>>
Objective<dim>::combined_gradients(const States                                  &states,
                                   const std::vector<sensitivity::Gradient<dim>> &found) const
{
  std::vector<sensitivity::Gradient<dim>> result, terms;
  for (const Quantity &quantity : quantities)
    {
      const auto factors = quantity.combined(values(quantity, states)).factors;
      result.push_back(sensitivity::weighted_sum(factors, found, quantity.first));
      for (unsigned int k = 0; k < quantity.combination.n_maxima(); ++k)
        for (unsigned int c = 0; c < factors.size(); ++c)
          terms.push_back(
            sensitivity::weighted_sum({quantity.term_factors(k)[c]}, found, quantity.first + c));
    }
  result.insert(result.end(), terms.begin(), terms.end());
  return result;
}

template <int dim>
std::vector<std::pair<std::string, unsigned int>> Objective<dim>::measured_names() const
{
  std::vector<std::pair<std::string, unsigned int>> result;
  for (const Quantity &quantity : quantities)
    for (const unsigned int c : quantity.load_cases)
      result.emplace_back(quantity.of.empty() ? problem.scene.optimization.objective : quantity.of,
                          c);
  return result;
}

template <int dim>
void Objective<dim>::differentiate(const Design &design, optimization::Evaluation &evaluation)
{
  const auto &found   = gradients(design);
  evaluation.gradient = found.of_response.front().values;
  evaluation.jacobian.clear();
  for (unsigned int i = 1; i < found.of_response.size(); ++i)
    {
      evaluation.jacobian.push_back(found.of_response[i].values);
      if (i < quantities.size())
        for (double &entry : evaluation.jacobian.back())
          entry *= quantities[i].sign();
    }
  if (is_predicted())
    evaluation.linearization = linearized_contact(analyses.at(design));
  evaluation.f_mults += found.f_mults;
  evaluation.seconds = problem.context.seconds();
}

template <int dim>
DesignValues Objective<dim>::values(const States &states) const
{
  DesignValues        result;
  std::vector<double> terms;
  for (unsigned int i = 0; i < quantities.size(); ++i)
    {
      const Quantity &quantity = quantities[i];
      const auto      of_cases = values(quantity, states);
      const double    J        = quantity.combined(of_cases).value;
      for (unsigned int k = 0; k < quantity.combination.n_maxima(); ++k)
        for (unsigned int c = 0; c < of_cases.size(); ++c)
          terms.push_back(quantity.term_factors(k)[c] * of_cases[c]);
      if (i == 0)
        {
          result.objective = J;
          continue;
        }
      result.constraints.push_back(quantity.sign() * (J - quantity.target));
      result.constrained.push_back(J);
    }
  std::tie(result.violation, result.violated) = most_violated(result.constrained);
  result.constraints.insert(result.constraints.end(), terms.begin(), terms.end());
  return result;
}

template <int dim>
double Objective<dim>::Quantity::violation(const double value) const
{
  const double c    = sign() * (value - target);
  const double size = side == optimization::Limit::Side::equal ? std::abs(c) : std::max(0., c);
  return size / (target == 0. ? 1. : std::abs(target));
}

template <int dim>
std::vector<typename Objective<dim>::ConstraintValue>
Objective<dim>::constraint_values(const std::vector<double> &initial,
                                  const std::vector<double> &reported) const
{
  // Values closer to a limit than the optimizer's tolerance usually leaves them are at the limit.
  const double tolerance = std::max(1e-4, problem.scene.optimization.constraint_tolerance);
  std::vector<ConstraintValue> result;
  for (std::size_t i = 1; i < quantities.size(); ++i)
    {
      const auto       &quantity = quantities[i];
      const std::size_t back     = quantities.size() - i;
      const double      value    = reported[reported.size() - back];
      const double      distance = std::abs(value - quantity.target);
      result.push_back({quantity.name, scene::unit_after_number(problem.scene, quantity.of),
                        initial[initial.size() - back], value, quantity.target, quantity.side,
                        quantity.violation(value),
                        quantity.violation(value) > 0. ||
                          distance <= tolerance * std::max(1e-300, std::abs(quantity.target))});
    }
  return result;
}

template <int dim>
std::pair<double, std::string>
Objective<dim>::most_violated(const std::vector<double> &values) const
{
  std::pair<double, std::string> result = {0., ""};
  const std::size_t              first  = values.size() + 1 - quantities.size();
  for (unsigned int i = 1; i < quantities.size(); ++i)
    {
      const Quantity &quantity  = quantities[i];
      const double    violation = quantity.violation(values[first + i - 1]);
      if (violation > result.first)
        result = {violation, quantity.name};
    }
  return result;
}

/// Return the maxima in the objective and the constraints. Their terms follow the constraints.
template <int dim>
std::vector<optimization::Maximum> Objective<dim>::maxima() const
{
  std::vector<optimization::Maximum> result;
  auto                               begin = static_cast<unsigned int>(quantities.size()) - 1;
  for (unsigned int i = 0; i < quantities.size(); ++i)
    for (unsigned int k = 0; k < quantities[i].combination.n_maxima(); ++k)
      {
        const auto n = static_cast<unsigned int>(quantities[i].load_cases.size());
        result.push_back({static_cast<int>(i) - 1, begin, begin + n});
        begin += n;
      }
  return result;
}

template <int dim>
optimization::DesignProblem Objective<dim>::design_problem(const Design &start)
{
  optimization::DesignProblem result;
  result.lower         = problem.shapes->lower_bounds();
  result.upper         = problem.shapes->upper_bounds();
  result.start         = start;
  result.lengths       = problem.shapes->first_steps();
  result.evaluate      = [this](const Design &x) { return evaluate(x); };
  result.differentiate = [this](const Design &x, optimization::Evaluation &evaluation) {
    differentiate(x, evaluation);
  };
  result.memory   = [this]() { return analyses.memory(); };
  result.remember = [this](const std::string &bytes) { return analyses.remember(bytes); };
  if (is_predicted())
    result.predict = [this](const optimization::Evaluation &at, const std::vector<double> &dx) {
      return predicted(at, dx);
    };
  result.predicts_objective = is_predicted() && measures_contact(response());
  for (unsigned int i = 1; i < quantities.size(); ++i)
    {
      result.constraint_scales.push_back(std::abs(quantities[i].target));
      result.relations.push_back(quantities[i].side == optimization::Limit::Side::equal
                                   ? optimization::Relation::equal
                                   : optimization::Relation::at_most);
    }
  result.maxima = maxima();
  if (!result.maxima.empty())
    {
      result.constraint_scales.resize(result.maxima.back().end, 1.);
      result.relations.resize(result.maxima.back().end, optimization::Relation::term);
    }
  return result;
}

template class Objective<2>;
template class Objective<3>;
} // namespace snug::app
