#include <snug/app/evaluator.h>

#include <algorithm>
#include <cmath>

namespace snug::app {
template <int dim>
Evaluator<dim>::Evaluator(ShapeProblem<dim> &problem, const Design &paired)
  : problem(problem), starts(problem.shapes->first_steps())
{
  const auto start    = problem.shapes->start();
  const bool re_pairs = is_relative_to_first() && paired != start;
  if (re_pairs)
    pair(start);
  for (const auto &[name, limit] : problem.scene.optimization.constraints)
    constraints.push_back(make_constraint(name, limit));
  for (const Constraint &constraint : constraints)
    measured.push_back({constraint.response.get(), constraint.load_case});
  if (problem.scene.optimization.combine == optimization::Combination::worst &&
      problem.n_load_cases() > 1)
    problem.scale_objective(first_states());
  if (re_pairs)
    pair(paired);
}

/// Return whether a limit or the scale of 'worst' needs the states of the first design.
template <int dim>
bool Evaluator<dim>::is_relative_to_first() const
{
  const auto &parameters  = problem.scene.optimization;
  const auto  is_relative = [&](const auto &constraint) {
    const auto of = scene::constraint_name(problem.scene, constraint.first);
    return optimization::read_limit(constraint.second).of_initial &&
           problem.make_response(of.response)->needs_solution();
  };
  return (parameters.combine == optimization::Combination::worst && problem.n_load_cases() > 1) ||
         std::any_of(parameters.constraints.begin(), parameters.constraints.end(), is_relative);
}

template <int dim>
const typename Evaluator<dim>::States &Evaluator<dim>::first_states()
{
  if (of_first.empty())
    of_first = problem.solve(problem.shapes->start());
  return of_first;
}

template <int dim>
typename Evaluator<dim>::Constraint Evaluator<dim>::make_constraint(const std::string &name,
                                                                    const std::string &limit)
{
  const auto of    = scene::constraint_name(problem.scene, name);
  const auto bound = optimization::read_limit(limit);
  Constraint constraint{problem.make_response(of.response), of.load_case.value_or(0), bound.value,
                        bound.side};
  if (!bound.of_initial)
    return constraint;
  state::ContactState<dim> geometry; // without a solution
  geometry.positions  = problem.positions(problem.shapes->start());
  const bool of_state = constraint.response->needs_solution();
  constraint.target *=
    constraint.response->value(*problem.solver,
                               of_state ? first_states()[constraint.load_case] : geometry);
  return constraint;
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
        sensitivity::combined_gradients(problem.load_cases(current->states, design, parameters),
                                        *problem.objective,
                                        problem.combined_objective(current->states).factors,
                                        measured);
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
  for (unsigned int i = 0; i < constraints.size(); ++i)
    {
      evaluation.jacobian.push_back(at.gradients.of_response[1 + i].values);
      for (double &entry : evaluation.jacobian.back())
        entry *= constraints[i].sign();
    }
  if (is_predicted())
    evaluation.linearization = linearized_contact(at);
  evaluation.f_mults += at.gradients.f_mults;
  evaluation.seconds = problem.context.seconds();
}

template <int dim>
DesignValues Evaluator<dim>::values(const States &states) const
{
  DesignValues result;
  result.objective = problem.combined_objective(states).value;
  for (const Constraint &constraint : constraints)
    {
      const double J = constraint.response->value(*problem.solver, states[constraint.load_case]);
      const double c = constraint.sign() * (J - constraint.target);
      result.constraints.push_back(c);
      const double size =
        constraint.side == optimization::Limit::Side::equal ? std::abs(c) : std::max(0., c);
      result.violation =
        std::max(result.violation,
                 size / (constraint.target == 0. ? 1. : std::abs(constraint.target)));
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
  for (const Constraint &constraint : constraints)
    {
      result.constraint_scales.push_back(std::abs(constraint.target));
      result.relations.push_back(constraint.side == optimization::Limit::Side::equal
                                   ? optimization::Relation::equal
                                   : optimization::Relation::at_most);
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
