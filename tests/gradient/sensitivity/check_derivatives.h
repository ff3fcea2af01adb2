#ifndef snug_tests_gradient_sensitivity_check_derivatives_h
#define snug_tests_gradient_sensitivity_check_derivatives_h

#include <snug/state/contact_results.h>

#include <gradient/sensitivity/differences.h>

namespace snug::test {
/// Relative errors against differences of states solved to 1e-12: u' and
/// what follows from it is limited by round-off over the step, the energy's
/// error is of second order.
constexpr double direct_tolerance = 1e-7;
constexpr double energy_tolerance = 1e-8;
/// between the methods, which solve the same system or its transpose
constexpr double method_tolerance = 1e-10;
constexpr double difference_step  = 2e-4;

/// Displacement derivative along @p direction at the nodes of this rank's
/// cells.
template <int dim>
typename mesh::BodyMesh<dim>::Field nodal(const Problem<dim>            &problem,
                                          const sensitivity::KktVectors &derivatives,
                                          const std::vector<double>     &direction)
{
  typename mesh::BodyMesh<dim>::Field field(problem.mesh.n_local_nodes());
  for (unsigned int j = 0; j < direction.size(); ++j)
    {
      const auto column = state::nodal_values(problem.solver, derivatives.primal, j);
      for (unsigned int node = 0; node < field.size(); ++node)
        field[node] += direction[j] * column[node];
    }
  return field;
}

template <int dim>
double field_error(const Problem<dim>                        &problem,
                   const typename mesh::BodyMesh<dim>::Field &a,
                   const typename mesh::BodyMesh<dim>::Field &b)
{
  double error = 0., largest = 0.;
  for (const auto &cell : problem.mesh.cells())
    for (const unsigned int node : cell.nodes)
      {
        error   = std::max(error, (a[node] - b[node]).norm());
        largest = std::max(largest, b[node].norm());
      }
  const MPI_Comm comm = problem.mesh.communicator();
  return dealii::Utilities::MPI::max(error, comm) / dealii::Utilities::MPI::max(largest, comm);
}

/// Gradients of all responses by all exact methods that apply.
template <int dim>
std::map<std::pair<std::string, sensitivity::Method>, std::vector<double>>
all_gradients(GradientScene<dim> &scene, const state::ContactState<dim> &state)
{
  using sensitivity::Method;
  std::map<std::pair<std::string, Method>, std::vector<double>> result;
  sensitivity::GradientParameters                               parameters;
  for (const auto method : {Method::adjoint, Method::direct, Method::energy})
    {
      std::vector<std::string> names;
      for (const auto &[name, response] : scene.responses)
        if (method != Method::energy ||
            !sensitivity::needs_solve(*response, scene.problem.solver.has_potential()))
          names.push_back(name);
      parameters.method = method;
      const auto found  = scene.gradients(state, names, parameters);
      for (unsigned int i = 0; i < names.size(); ++i)
        result[{names[i], method}] = found.of_response[i].values;
    }
  return result;
}

template <int dim>
void check_derivatives(GradientScene<dim> &scene,
                       double              step      = difference_step,
                       double              tolerance = direct_tolerance)
{
  const auto state = scene.solve(scene.design);
  ASSERT_EQ(state.weak_contacts, 0u);
  ASSERT_GT(state.active_contacts, 1u);
  ASSERT_LT(state.active_contacts, state.contact.size());
  const sensitivity::GradientParameters parameters;
  const auto                            problem = scene.at(state, parameters);
  const auto                            derivatives =
    sensitivity::state_derivatives(problem, sensitivity::residual_derivatives(problem));
  const auto gradients = all_gradients(scene, state);
  for (const auto &[name, response] : scene.responses)
    EXPECT_LT(relative_error(gradients.at({name, sensitivity::Method::adjoint}),
                             gradients.at({name, sensitivity::Method::direct})),
              method_tolerance)
      << name;
  for (const auto &direction : test_directions(scene.basis->n_variables()))
    {
      const auto exact = scene.differences(direction, step);
      EXPECT_LT(field_error(scene.problem, nodal(scene.problem, derivatives, direction),
                            exact.displacement),
                tolerance);
      for (const auto &[key, gradient] : gradients)
        EXPECT_LT(std::abs(dot(gradient, direction) - exact.responses.at(key.first)) /
                    (norm(gradient) * norm(direction)),
                  key.second == sensitivity::Method::energy ? energy_tolerance : tolerance)
          << key.first << " by " << to_text(key.second);
    }
}
} // namespace snug::test

#endif
