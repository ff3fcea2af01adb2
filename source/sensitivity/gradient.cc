#include <snug/sensitivity/gradient.h>
#include <snug/sensitivity/methods.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace snug::sensitivity {
namespace {
template <int dim>
using Method = Gradients<dim>(const GradientProblem<dim> &, const Responses<dim> &);

/// Each response by its method, those of one method together.
template <int dim>
Gradients<dim> by_methods(const GradientProblem<dim>      &problem,
                          const Responses<dim>            &responses,
                          const std::vector<MethodChoice> &choices)
{
  const std::pair<std::string, Method<dim> *> methods[] = {{"energy", energy_gradients<dim>},
                                                           {"adjoint", adjoint_gradients<dim>},
                                                           {"direct", direct_gradients<dim>}};
  Gradients<dim>                              result;
  result.of_response.resize(responses.size());
  for (const auto &[name, method] : methods)
    {
      Responses<dim> group;
      for (unsigned int i = 0; i < responses.size(); ++i)
        if (choices[i].method == name)
          group.push_back(responses[i]);
      if (group.empty())
        continue;
      auto of_group = method(problem, group);
      auto next     = of_group.of_response.begin();
      for (unsigned int i = 0; i < responses.size(); ++i)
        if (choices[i].method == name)
          {
            result.of_response[i]        = *next++;
            result.of_response[i].reason = choices[i].reason;
          }
      if (!of_group.displacement.empty())
        result.displacement = of_group.displacement;
    }
  return result;
}

/// All by @p method, but what depends on the geometry alone.
template <int dim>
std::function<Method<dim>> solving(const std::string &method)
{
  return [method](const GradientProblem<dim> &problem, const Responses<dim> &responses) {
    std::vector<MethodChoice> choices;
    for (const auto *response : responses)
      choices.push_back({response->needs_solution() ? method : "energy", ""});
    return by_methods(problem, responses, choices);
  };
}

/// The field in the span of the velocities that has the products
/// @p values with them, V (V'V)^+ values: this rank's share.
template <int dim>
typename mesh::BodyMesh<dim>::Field spanned_field(const GradientProblem<dim> &problem,
                                                  const std::vector<double>  &values)
{
  const auto        &mesh = problem.solver.mesh();
  const unsigned int k    = values.size();
  const unsigned int rank = problem.solver.context().rank();
  const auto         own  = [&](auto field) {
    for (unsigned int node = 0; node < field.size(); ++node)
      if (mesh.owner(node) != rank)
        field[node] = 0.;
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
                                           const unsigned int    n_variables)
{
  unsigned int n_solves = 0;
  for (const auto *response : responses)
    n_solves += needs_solve(*response);
  const MethodChoice solving{n_solves < n_variables ? "adjoint" : "direct",
                             "solves for " + std::to_string(n_solves) + " responses against " +
                               std::to_string(n_variables) + " variables"};
  std::vector<MethodChoice> choices;
  for (const auto *response : responses)
    if (!response->needs_solution())
      choices.push_back({"energy", "depends on the geometry alone"});
    else if (response->stationary())
      choices.push_back({"energy", "stationary at the state, no solve"});
    else
      choices.push_back(solving);
  return choices;
}

template <int dim>
const ChoiceTable<Method<dim>> &gradient_table()
{
  static const ChoiceTable<Method<dim>> table = {
    {"auto",
     "the cheapest exact one: energy where it applies, else adjoint for "
     "fewer responses than variables, else direct",
     [](const GradientProblem<dim> &problem, const Responses<dim> &responses) {
       return by_methods(problem, responses,
                         cheapest_methods(responses, problem.basis.n_variables()));
     }},
    {"energy", "without any solve, for potential energy and volume", energy_gradients<dim>},
    {"adjoint", "one linear solve per response with the state's factorizations",
     solving<dim>("adjoint")},
    {"direct",
     "the derivatives of the state, one linear solve per variable with the "
     "state's factorizations",
     solving<dim>("direct")},
    {"finite differences", "differences of cold-started states, a baseline",
     difference_gradients<dim>}};
  return table;
}

template <int dim>
Gradients<dim> gradients(const GradientProblem<dim> &problem, const Responses<dim> &responses)
{
  RunContext             &context = problem.solver.context();
  const RunContext::Timer timer(context, "gradient");
  const double            start  = context.seconds();
  const Work              before = context.total_work();
  auto result = choose(gradient_table<dim>(), problem.parameters.method).make(problem, responses);
  for (unsigned int i = 0; i < responses.size(); ++i)
    {
      auto &gradient          = result.of_response[i];
      gradient.differentiable = problem.state.weak_contacts == 0 || !needs_solve(*responses[i]);
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
  template std::vector<MethodChoice> cheapest_methods(const Responses<dim> &, unsigned int);       \
  template const ChoiceTable<Gradients<dim>(const GradientProblem<dim> &, const Responses<dim> &)> \
                         &gradient_table<dim>();                                                   \
  template Gradients<dim> gradients(const GradientProblem<dim> &, const Responses<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
