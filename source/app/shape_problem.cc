#include <snug/app/mesh_checks.h>
#include <snug/app/shape_problem.h>
#include <snug/state/validity_checks.h>

#include <algorithm>
#include <cmath>

namespace snug::app {
template <int dim>
ShapeProblem<dim>::ShapeProblem(RunContext                          &context,
                                const scene::Scene                  &scene,
                                std::unique_ptr<mesh::BodyMesh<dim>> the_mesh)
  : context(context), scene(scene), mesh(std::move(the_mesh))
{
  {
    const RunContext::Timer timer(context, "setup");
    check_distances(scene, *mesh);
    // Only the active set method knows clusters, see scene::check().
    tearing =
      mesh::tear(*mesh, scene.solver.method == "active set" ? scene.tearing.cluster_edge : 1);
    shape::BodyNames names;
    for (const auto &body : scene.bodies)
      names.names.push_back(body.name);
    shapes = with_file_context(scene, [&]() {
      return std::make_unique<shape::Shapes<dim>>(*mesh, names, scene.shapes);
    });
  }
  // contact is paired where the optimization starts, not at the reference
  solver    = with_file_context(scene, [&]() {
    return std::make_unique<state::StateSolver<dim>>(*mesh, tearing, build_model(scene, *mesh),
                                                        positions(shapes->start()), context);
  });
  objective = make_response(scene.optimization.objective);
  for (const auto &response : scene.responses)
    responses.push_back(make_response(response.name));
}

template <int dim>
void ShapeProblem<dim>::check_overlaps() const
{
  with_file_context(scene, [&]() {
    for (const unsigned int c : solver->positions())
      state::check_overlaps(solver->contact(c).pairs(), solver->contact(c).paired_gaps(),
                            state::place_of(solver->model(), c));
  });
}

template <int dim>
std::unique_ptr<response::Response<dim>>
ShapeProblem<dim>::make_response(const std::string &name) const
{
  auto response = response::make_response<dim>(*scene::response_called(scene, name));
  with_file_context(scene, [&]() { response->check(*solver); });
  return response;
}

template <int dim>
typename ShapeProblem<dim>::States
ShapeProblem<dim>::solve(const Design &design, const std::vector<qp::WarmStart> &starts)
{
  States     states;
  const auto x = positions(design);
  for (unsigned int c = 0; c < n_load_cases(); ++c)
    states.push_back(with_file_context(scene, [&]() {
      return solver->solve(x, starts.empty() ? solver->scaled_start(states, x, c) : starts[c], c,
                           states);
    }));
  return states;
}

template <int dim>
optimization::Combined ShapeProblem<dim>::combined_objective(const States &states) const
{
  std::vector<double> values, weights;
  for (unsigned int c = 0; c < states.size(); ++c)
    {
      values.push_back(objective->value(*solver, states[c]));
      weights.push_back(weight(c));
    }
  return optimization::combined(scene.optimization.combine, values, weights);
}

template <int dim>
std::vector<std::string> ShapeProblem<dim>::value_names() const
{
  std::vector<std::string> names;
  for (unsigned int c = 0; c < n_load_cases(); ++c)
    {
      const auto prefix = n_load_cases() == 1 ? "" : scene.load_cases[c].name + ".";
      names.push_back(prefix + scene.optimization.objective);
      for (const auto &response : scene.responses)
        if (response.name != scene.optimization.objective)
          names.push_back(prefix + response.name);
      for (const char *name : {"max_pressure", "max_von_mises", "max_displacement"})
        names.push_back(prefix + name);
    }
  return names;
}

template <int dim>
std::vector<double> ShapeProblem<dim>::reported_values(const States &states) const
{
  std::vector<double> values;
  for (const auto &state : states)
    {
      values.push_back(objective->value(*solver, state));
      for (unsigned int i = 0; i < responses.size(); ++i)
        if (scene.responses[i].name != scene.optimization.objective)
          values.push_back(responses[i]->value(*solver, state));
      values.insert(values.end(), {state.max_pressure, state.stress_peak().von_mises,
                                   state.displacement_peak.size});
    }
  return values;
}

template <int dim>
double ShapeProblem<dim>::weight(const unsigned int load_case) const
{
  return scene.load_cases.empty() ? 1. : scene.load_cases[load_case].weight;
}

template <int dim>
sensitivity::LoadCases<dim>
ShapeProblem<dim>::load_cases(const States                          &states,
                              const Design                          &design,
                              const sensitivity::GradientParameters &parameters) const
{
  std::vector<double> widths;
  for (unsigned int i = 0; i < shapes->n_variables(); ++i)
    widths.push_back(shapes->upper_bounds()[i] - shapes->lower_bounds()[i]);
  sensitivity::LoadCases<dim> result;
  for (const auto &state : states)
    result.push_back({*solver, *shapes, state, design, widths, parameters});
  return result;
}

template <int dim>
double ShapeProblem<dim>::drift(const Design &design) const
{
  const auto x       = solver->surface().gather(positions(design));
  double     largest = 0.;
  for (const unsigned int c : solver->positions())
    for (const double drift : solver->contact(c).pairing_drifts(x, solver->contact(c).rows(x)))
      largest = std::max(largest, drift);
  return largest;
}

template class ShapeProblem<2>;
template class ShapeProblem<3>;
} // namespace snug::app
