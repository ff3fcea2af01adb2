#include <snug/app/evaluator.h>

#include <algorithm>
#include <cmath>

namespace snug::app {
template <int dim>
Evaluator<dim>::Evaluator(ShapeProblem<dim> &problem)
  : problem(problem), starts(problem.shapes->first_steps())
{
  for (const auto &[name, limit] : problem.scene.optimization.constraints)
    constraints.push_back(make_constraint(name, limit));
  for (const Constraint &constraint : constraints)
    measured.push_back({constraint.response.get(), constraint.load_case});
  // its scale is that of the first design, whatever a journal replays
  if (problem.scene.optimization.combine == optimization::Combination::worst &&
      problem.n_load_cases() > 1)
    problem.combined_objective(first_states());
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
optimization::Evaluation Evaluator<dim>::evaluate(const Design &at)
{
  states = problem.solve(at, starts.at(at));
  design = at;
  std::vector<qp::MultiVector> forces;
  for (const auto &state : states)
    forces.push_back(state.dual.lambda);
  starts.add(at, std::move(forces));
  gradients = {};

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
void Evaluator<dim>::differentiate(const Design &at, optimization::Evaluation &evaluation)
{
  if (states.empty() || design != at)
    {
      states = problem.solve(at, starts.at(at));
      design = at;
    }
  auto parameters = problem.scene.gradient;
  if (parameters.method == sensitivity::Method::energy) // not for every constraint
    parameters.method.reset();
  if (is_predicted())
    parameters.method = sensitivity::Method::direct;
  gradients = sensitivity::combined_gradients(problem.load_cases(states, design, parameters),
                                              *problem.objective,
                                              problem.combined_objective(states).factors, measured);
  evaluation.gradient = gradients.of_response.front().values;
  evaluation.jacobian.clear();
  for (unsigned int i = 0; i < constraints.size(); ++i)
    {
      evaluation.jacobian.push_back(gradients.of_response[1 + i].values);
      for (double &entry : evaluation.jacobian.back())
        entry *= constraints[i].sign();
    }
  if (is_predicted())
    evaluation.linearization = linearized_contact();
  evaluation.f_mults += gradients.f_mults;
  evaluation.seconds = problem.context.seconds();
}

template <int dim>
typename Evaluator<dim>::Values Evaluator<dim>::values(const States &states)
{
  Values result;
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
    return starts.read(bytes, problem.solver->gluing().layout().n_owned(), problem.n_load_cases());
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
  states.clear();
  gradients = {};
  starts.clear();
}

template class Evaluator<2>;
template class Evaluator<3>;
} // namespace snug::app
