#include <snug/sensitivity/gradient.h>
#include <snug/sensitivity/load_steps.h>
#include <snug/sensitivity/methods.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace snug::sensitivity {
namespace {
/// Compute the gradient of each response by its method. Responses with the same
/// method are differentiated together.
template <int dim>
Gradients<dim> by_methods(const LoadCases<dim>            &load_cases,
                          const MeasuredResponses<dim>    &responses,
                          const std::vector<MethodChoice> &choices)
{
  using By = Gradients<dim>(const LoadCases<dim> &, const MeasuredResponses<dim> &);
  const std::pair<Method, By *> methods[] = {{Method::energy, energy_gradients},
                                             {Method::adjoint, adjoint_gradients},
                                             {Method::direct, direct_gradients},
                                             {Method::finite_differences, difference_gradients}};
  Gradients<dim>                result;
  result.of_response.resize(responses.size());
  for (const auto &[method, gradients_by] : methods)
    {
      MeasuredResponses<dim> group;
      for (unsigned int i = 0; i < responses.size(); ++i)
        if (choices[i].method == method)
          group.push_back(responses[i]);
      if (group.empty())
        continue;
      auto of_group = gradients_by(load_cases, group);
      auto next     = of_group.of_response.begin();
      for (unsigned int i = 0; i < responses.size(); ++i)
        if (choices[i].method == method)
          {
            result.of_response[i]        = *next++;
            result.of_response[i].reason = choices[i].reason;
          }
      if (!of_group.displacement.empty())
        result.displacement = of_group.displacement;
      if (!of_group.forces.empty())
        result.forces = of_group.forces;
    }
  return result;
}

/// Return the method of each response. If the method is adjoint or direct, a response that depends
/// on the geometry alone takes the energy method, because it needs no solve.
template <int dim>
std::vector<MethodChoice> methods(const LoadCases<dim>         &load_cases,
                                  const MeasuredResponses<dim> &measured)
{
  const auto               &problem = load_cases.front();
  const auto               &wanted  = problem.parameters.method;
  const bool                solves  = wanted == Method::adjoint || wanted == Method::direct;
  std::vector<MethodChoice> choices(measured.size());
  for (unsigned int c = 0; c < load_cases.size(); ++c)
    {
      const auto [places, of_case] = responses_of(measured, c);
      const auto cheapest =
        cheapest_methods(of_case, problem.basis.n_variables(), problem.solver.has_potential());
      for (unsigned int i = 0; i < places.size(); ++i)
        choices[places[i]] =
          !wanted
            ? cheapest[i]
            : MethodChoice{solves && !of_case[i]->needs_solution() ? Method::energy : *wanted, ""};
    }
  return choices;
}

/// Return this rank's share of the field V (V'V)^+ values. This field lies in the
/// span of the velocities V and has the products @p values with them.
template <int dim>
mesh::Field<dim> spanned_field(const GradientProblem<dim> &problem,
                               const std::vector<double>  &values)
{
  const auto        &mesh = problem.solver.mesh();
  const unsigned int k    = values.size();
  const unsigned int rank = problem.solver.context().rank();
  const auto         own  = [&](auto field) {
    for (unsigned int point = 0; point < field.size(); ++point)
      // Set the values at samples to zero, because the products are sums over nodes.
      if (point >= mesh.n_local_nodes() || mesh.owner(point) != rank)
        field[point] = 0.;
    return field;
  };
  dealii::LAPACKFullMatrix<double> gram(k);
  for (unsigned int j = 0; j < k; ++j)
    {
      const auto column = problem.basis.transpose(own(problem.basis.column(j)));
      for (unsigned int i = 0; i < k; ++i)
        gram(i, j) = column[i];
    }
  gram.compute_inverse_svd(1e-12);
  dealii::Vector<double> right(values.begin(), values.end()), weights(k);
  gram.vmult(weights, right);
  return own(problem.basis.apply(std::vector<double>(weights.begin(), weights.end())));
}
} // namespace

template <int dim>
std::vector<MethodChoice> cheapest_methods(const Responses<dim> &responses,
                                           const unsigned int    n_variables,
                                           const bool            has_potential)
{
  unsigned int n_solves = 0;
  for (const auto *response : responses)
    n_solves += needs_solve(*response, has_potential);
  const MethodChoice solving{n_solves < n_variables ? Method::adjoint : Method::direct,
                             counted(n_solves, "response") + ", " +
                               counted(n_variables, "variable")};
  std::vector<MethodChoice> choices;
  for (const auto *response : responses)
    if (!response->needs_solution())
      choices.push_back({Method::energy, "depends only on the geometry"});
    else if (!needs_solve(*response, has_potential))
      choices.push_back({Method::energy, "needs no linear solve"});
    else
      choices.push_back(solving);
  return choices;
}

template <int dim>
Gradients<dim> gradients(const LoadCases<dim> &load_cases, const MeasuredResponses<dim> &responses)
{
  const auto             &problem = load_cases.front();
  RunContext             &context = problem.solver.context();
  const RunContext::Timer timer(context, "gradient");
  const double            start  = context.seconds();
  const Work              before = context.total_work();
  auto result = by_methods(load_cases, responses, methods(load_cases, responses));
  for (unsigned int i = 0; i < responses.size(); ++i)
    {
      auto       &gradient = result.of_response[i];
      const auto &state    = load_cases[responses[i].load_case].state;
      gradient.differentiable =
        state.weak_contacts == 0 ||
        !needs_solve(*responses[i].response, problem.solver.has_potential());
      if (!problem.parameters.shape_gradient)
        gradient.shape.reset();
      else if (!gradient.shape)
        gradient.shape = spanned_field(problem, gradient.values);
    }
  const Work after              = context.total_work();
  result.f_mults                = after.f_mults - before.f_mults;
  result.numeric_factorizations = after.numeric_factorizations - before.numeric_factorizations;
  result.seconds                = context.seconds() - start;
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template std::vector<MethodChoice> cheapest_methods(const Responses<dim> &, unsigned int, bool); \
  template Gradients<dim> gradients(const LoadCases<dim> &, const MeasuredResponses<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
