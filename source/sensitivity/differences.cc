#include <snug/sensitivity/methods.h>

namespace snug::sensitivity {
namespace {
/// The values at one design from which the differences are formed.
template <int dim>
struct Values
{
  std::vector<double> responses;
  mesh::Field<dim>    displacement;

  Values(const GradientProblem<dim>     &problem,
         const Responses<dim>           &to_evaluate,
         const state::ContactState<dim> &state)
    : displacement(state.displacement)
  {
    for (const auto *response : to_evaluate)
      responses.push_back(response->value(problem.solver, state));
  }
};

template <int dim>
Values<dim> values_at(const GradientProblem<dim> &problem,
                      const Responses<dim>       &responses,
                      const std::vector<double>  &design)
{
  // Use a cold start, because a warm start would converge at once and hide u'.
  const auto state =
    problem.solver.solve(shape::positions(problem.solver.mesh(), problem.basis, design),
                         qp::WarmStart(), problem.state.load_case);
  return Values<dim>(problem, responses, state);
}
} // namespace

template <int dim>
Gradients<dim> difference_gradients(const GradientProblem<dim> &problem,
                                    const Responses<dim>       &responses)
{
  const auto       &parameters = problem.parameters;
  const auto        stencil    = elasticity::stencil(parameters.differences);
  const Values<dim> here(problem, responses, problem.state);
  Gradients<dim>    result;
  for (unsigned int i = 0; i < responses.size(); ++i)
    result.of_response.push_back({Method::finite_differences, "", {}});
  for (unsigned int j = 0; j < problem.basis.n_variables(); ++j)
    {
      const double        step = parameters.step * problem.bound_widths[j];
      std::vector<double> slopes(responses.size());
      mesh::Field<dim>    field(here.displacement.size());
      for (unsigned int k = 0; k < stencil.places.size(); ++k)
        {
          auto design = problem.design;
          design[j] += stencil.places[k] * step;
          const auto there = stencil.places[k] == 0. ? here : values_at(problem, responses, design);
          const double weight = stencil.weights[k] / step;
          for (unsigned int i = 0; i < responses.size(); ++i)
            slopes[i] += weight * there.responses[i];
          for (unsigned int node = 0; node < field.size(); ++node)
            field[node] += weight * there.displacement[node];
        }
      for (unsigned int i = 0; i < responses.size(); ++i)
        result.of_response[i].values.push_back(slopes[i]);
      result.displacement.push_back(field);
    }
  problem.solver.restore(problem.state);
  return result;
}

template Gradients<2> difference_gradients(const GradientProblem<2> &, const Responses<2> &);
template Gradients<3> difference_gradients(const GradientProblem<3> &, const Responses<3> &);
} // namespace snug::sensitivity
