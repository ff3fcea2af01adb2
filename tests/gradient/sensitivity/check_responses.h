#ifndef snug_tests_gradient_sensitivity_check_responses_h
#define snug_tests_gradient_sensitivity_check_responses_h

#include <gradient/sensitivity/check_derivatives.h>

#include <set>

namespace snug::test {
/// Add all responses of the table; those of friction only where there is friction.
template <int dim>
void add_all_responses(GradientScene<dim> &scene)
{
  const std::set<std::string> of_friction = {"dissipation",    "slip norm",      "peak slip",
                                             "shear norm",     "peak shear",     "stick area",
                                             "friction force", "friction moment"};
  for (const auto &[name, parameters] : all_responses<dim>())
    if (of_friction.count(name) == 0 || scene.problem.solver.has_friction())
      scene.responses[name] = response::make_response<dim>(parameters);
}

/// Adjoint and direct gradients of all responses against each other and
/// against differences along one direction. Those of @p sensitive must be
/// able to change by more than a hundredth of their value within the
/// bounds.
template <int dim>
void check_responses(GradientScene<dim>          &scene,
                     const std::set<std::string> &sensitive = {},
                     double                       step      = difference_step / 2,
                     double                       tolerance = direct_tolerance)
{
  std::vector<std::string> names;
  const auto               state = scene.solve(scene.design);
  add_all_responses(scene);
  for (const auto &[name, response] : scene.responses)
    names.push_back(name);
  ASSERT_EQ(state.weak_contacts, 0u);
  ASSERT_GT(state.active_contacts, 1u);

  sensitivity::GradientParameters parameters;
  parameters.method  = sensitivity::Method::adjoint;
  const auto adjoint = scene.gradients(state, names, parameters).of_response;
  parameters.method  = sensitivity::Method::direct;
  const auto direct  = scene.gradients(state, names, parameters).of_response;

  const auto direction = test_directions(scene.basis->n_variables()).front();
  const auto exact     = scene.differences(direction, step);
  for (unsigned int i = 0; i < names.size(); ++i)
    {
      SCOPED_TRACE(names[i]);
      const auto &gradient = adjoint[i].values;
      EXPECT_LT(relative_error(gradient, direct[i].values), method_tolerance);
      EXPECT_LT(std::abs(dot(gradient, direction) - exact.responses.at(names[i])) /
                  (norm(gradient) * norm(direction)),
                tolerance);
      if (sensitive.count(names[i]) > 0)
        {
          const double value = scene.responses.at(names[i])->value(scene.problem.solver, state);
          EXPECT_GT(norm(gradient) * scene.widths[0], 0.01 * std::abs(value));
        }
    }
}
} // namespace snug::test

#endif
