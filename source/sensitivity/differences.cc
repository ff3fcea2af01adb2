#include <snug/sensitivity/load_steps.h>
#include <snug/sensitivity/methods.h>

namespace snug::sensitivity {
namespace {
/// Return the states of the needed load cases at a design; others are empty.
template <int dim>
std::vector<state::ContactState<dim>> states_at(const LoadCases<dim>      &load_cases,
                                                const std::vector<bool>   &needed,
                                                const std::vector<double> &design)
{
  const auto &[solver, basis, state, here, widths, parameters] = load_cases.front();
  const auto x = shape::positions(solver.mesh(), basis, design);
  // The solver finds the state that a load step continues by its load case.
  std::vector<state::ContactState<dim>> by_case(solver.model().load_cases.size()), result;
  for (unsigned int k = 0; k < load_cases.size(); ++k)
    {
      const unsigned int c = load_cases[k].state.load_case;
      if (needed[k])
        // Use a cold start, because a warm start would converge at once and hide u'.
        by_case[c] = solver.solve(x, qp::WarmStart(), c, by_case);
      result.push_back(by_case[c]);
    }
  return result;
}

template <int dim>
std::vector<double> values_of(const LoadCases<dim>                        &load_cases,
                              const MeasuredResponses<dim>                &measured,
                              const std::vector<state::ContactState<dim>> &states)
{
  std::vector<double> values;
  for (const auto &[response, load_case] : measured)
    values.push_back(response->value(load_cases[load_case].solver, states[load_case]));
  return values;
}
} // namespace

template <int dim>
Gradients<dim> difference_gradients(const LoadCases<dim>         &load_cases,
                                    const MeasuredResponses<dim> &measured)
{
  const auto &[solver, basis, first, design, widths, parameters] = load_cases.front();
  const auto                            stencil = elasticity::stencil(parameters.differences);
  const auto                            needed  = needed_cases(load_cases, measured);
  std::vector<state::ContactState<dim>> here;
  for (const auto &problem : load_cases)
    here.push_back(problem.state);
  Gradients<dim> result;
  for (unsigned int i = 0; i < measured.size(); ++i)
    result.of_response.push_back({Method::finite_differences, "", {}});
  std::vector<std::vector<mesh::Field<dim>>> fields(load_cases.size()); // by case, variable
  for (unsigned int j = 0; j < basis.n_variables(); ++j)
    {
      const double        step = parameters.step * widths[j];
      std::vector<double> slopes(measured.size());
      for (unsigned int k = 0; k < stencil.places.size(); ++k)
        {
          auto moved = design;
          moved[j] += stencil.places[k] * step;
          const auto there  = stencil.places[k] == 0. ? here : states_at(load_cases, needed, moved);
          const auto values = values_of(load_cases, measured, there);
          const double weight = stencil.weights[k] / step;
          for (unsigned int i = 0; i < measured.size(); ++i)
            slopes[i] += weight * values[i];
          for (unsigned int c = 0; c < load_cases.size(); ++c)
            {
              fields[c].resize(j + 1, mesh::Field<dim>(here[c].displacement.size()));
              for (unsigned int node = 0; needed[c] && node < fields[c][j].size(); ++node)
                fields[c][j][node] += weight * there[c].displacement[node];
            }
        }
      for (unsigned int i = 0; i < measured.size(); ++i)
        result.of_response[i].values.push_back(slopes[i]);
    }
  for (unsigned int c = 0; c < load_cases.size(); ++c)
    if (needed[c])
      result.displacement.insert(result.displacement.end(), fields[c].begin(), fields[c].end());
  for (const auto &problem : load_cases)
    problem.solver.restore(problem.state);
  return result;
}

template Gradients<2> difference_gradients(const LoadCases<2> &, const MeasuredResponses<2> &);
template Gradients<3> difference_gradients(const LoadCases<3> &, const MeasuredResponses<3> &);
} // namespace snug::sensitivity
