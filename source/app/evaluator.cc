#include <snug/app/evaluator.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace snug::app {
template <int dim>
Evaluator<dim>::Evaluator(ShapeProblem<dim> &problem, const Design &paired)
  : problem(problem), starts(problem.shapes->first_steps())
{
  const auto start    = problem.shapes->start();
  const bool re_pairs = is_relative_to_first() && paired != start;
  if (re_pairs)
    pair(start);
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
    pair(paired);
}

template <int dim>
void Evaluator<dim>::add_quantity(Quantity quantity)
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
std::vector<double> Evaluator<dim>::Quantity::term_factors(const unsigned int k) const
{
  auto factors = weights;
  // The second maximum of a range is that of the negative values.
  for (double &factor : factors)
    factor *= k == 0 ? 1. : -1.;
  return factors;
}

/// Return whether a limit needs the states of the first design.
template <int dim>
bool Evaluator<dim>::is_relative_to_first() const
{
  const auto &constraints = problem.scene.optimization.constraints;
  return std::any_of(constraints.begin(), constraints.end(), [&](const auto &constraint) {
    const auto of = scene::constraint_name(problem.scene, constraint.first);
    return optimization::read_limit(constraint.second).of_initial &&
           problem.make_response(of.response)->needs_solution();
  });
}

template <int dim>
const typename Evaluator<dim>::States &Evaluator<dim>::first_states()
{
  if (of_first.empty())
    of_first = problem.solve(problem.shapes->start());
  return of_first;
}

template <int dim>
typename Evaluator<dim>::Quantity Evaluator<dim>::make_constraint(const std::string &name,
                                                                  const std::string &limit)
{
  const auto of    = scene::constraint_name(problem.scene, name);
  const auto bound = optimization::read_limit(limit);
  Quantity   constraint;
  constraint.name     = name + ' ' + limit;
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
    constraint.target *= constraint.combined(values(constraint, first_states())).value;
  else
    constraint.target *= constraint.response->value(*problem.solver, geometry.front());
  return constraint;
}

/// Return the values of the response of a quantity in its load cases.
template <int dim>
std::vector<double> Evaluator<dim>::values(const Quantity &quantity, const States &states) const
{
  std::vector<double> result;
  for (const unsigned int c : quantity.load_cases)
    result.push_back(quantity.response->value(*problem.solver, states[c]));
  return result;
}

template <int dim>
optimization::Evaluation Evaluator<dim>::evaluate(const Design &design)
{
  current = Analysis<dim>{design, problem.solve(design, starts.at(design))};
  const auto                  &states = current->states;
  std::vector<qp::MultiVector> forces;
  for (const auto &state : states)
    forces.push_back(state.dual.lambda);
  starts.add(design, std::move(forces));

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
Analysis<dim> &Evaluator<dim>::analysis(const Design &design)
{
  if (!last(design))
    current = Analysis<dim>{design, problem.solve(design, starts.at(design))};
  if (current->gradients.of_response.empty())
    {
      auto parameters = problem.scene.gradient;
      if (parameters.method == sensitivity::Method::energy) // does not hold for every constraint
        parameters.method.reset();
      if (is_predicted())
        parameters.method = sensitivity::Method::direct;
      current->gradients =
        sensitivity::gradients(problem.load_cases(current->states, design, parameters), measured);
      auto                                   &of_cases = current->gradients.of_response;
      std::vector<sensitivity::Gradient<dim>> combined, terms;
      for (const Quantity &quantity : quantities)
        {
          const auto factors = quantity.combined(values(quantity, current->states)).factors;
          combined.push_back(sensitivity::weighted_sum(factors, of_cases, quantity.first));
          for (unsigned int k = 0; k < quantity.combination.n_maxima(); ++k)
            for (unsigned int c = 0; c < factors.size(); ++c)
              terms.push_back(sensitivity::weighted_sum({quantity.term_factors(k)[c]}, of_cases,
                                                        quantity.first + c));
        }
      combined.insert(combined.end(), terms.begin(), terms.end());
      of_cases = std::move(combined);
    }
  // The solver may have been at another design since, for example at the first one.
  for (const auto &state : current->states)
    problem.solver->restore(state);
  return *current;
}

template <int dim>
void Evaluator<dim>::differentiate(const Design &design, optimization::Evaluation &evaluation)
{
  const auto &at      = analysis(design);
  evaluation.gradient = at.gradients.of_response.front().values;
  evaluation.jacobian.clear();
  for (unsigned int i = 1; i < at.gradients.of_response.size(); ++i)
    {
      evaluation.jacobian.push_back(at.gradients.of_response[i].values);
      if (i < quantities.size())
        for (double &entry : evaluation.jacobian.back())
          entry *= quantities[i].sign();
    }
  if (is_predicted())
    evaluation.linearization = linearized_contact(at);
  evaluation.f_mults += at.gradients.f_mults;
  evaluation.seconds = problem.context.seconds();
}

template <int dim>
DesignValues Evaluator<dim>::values(const States &states) const
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
std::pair<double, std::string>
Evaluator<dim>::most_violated(const std::vector<double> &values) const
{
  std::pair<double, std::string> result = {0., ""};
  const std::size_t              first  = values.size() + 1 - quantities.size();
  for (unsigned int i = 1; i < quantities.size(); ++i)
    {
      const Quantity &quantity = quantities[i];
      const double    c        = quantity.sign() * (values[first + i - 1] - quantity.target);
      const double    size =
        quantity.side == optimization::Limit::Side::equal ? std::abs(c) : std::max(0., c);
      const double violation = size / (quantity.target == 0. ? 1. : std::abs(quantity.target));
      if (violation > result.first)
        result = {violation, quantity.name};
    }
  return result;
}

/// Return the maxima in the objective and the constraints. Their terms follow the constraints.
template <int dim>
std::vector<optimization::Maximum> Evaluator<dim>::maxima() const
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
optimization::DesignProblem Evaluator<dim>::design_problem(const Design &start)
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
  result.memory   = [this]() { return starts.bytes(); };
  result.remember = [this](const std::string &bytes) {
    std::vector<unsigned int> n_owned; // per load case
    for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
      n_owned.push_back(problem.solver->gluing(c).layout().n_owned());
    return starts.read(bytes, n_owned);
  };
  if (is_predicted())
    result.predict = [this](const optimization::Evaluation &at, const std::vector<double> &dx) {
      return predicted(at, dx);
    };
  result.predicts_objective = is_predicted() && measures_contact(*problem.objective);
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

template <int dim>
void Evaluator<dim>::pair(const Design &at)
{
  problem.solver->pair(problem.positions(at));
  current.reset();
  of_first.clear();
  starts.clear();
}

template class Evaluator<2>;
template class Evaluator<3>;
} // namespace snug::app
