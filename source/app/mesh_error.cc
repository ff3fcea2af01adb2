#include <snug/app/mesh_error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace snug::app {
namespace {
/// Return the objective and the responses of a scene with their names.
template <int dim>
std::vector<std::pair<std::string, const response::Response<dim> *>>
measured(const ShapeProblem<dim> &problem)
{
  std::vector<std::pair<std::string, const response::Response<dim> *>> result = {
    {problem.scene.optimization.objective, problem.objective.get()}};
  for (unsigned int i = 0; i < problem.responses.size(); ++i)
    if (problem.scene.responses[i].name != result.front().first)
      result.emplace_back(problem.scene.responses[i].name, problem.responses[i].get());
  return result;
}

/// Strain energies are equal up to this share. Rounding must not choose between load cases that
/// mirror each other.
const double equal_energies = 1e-6;

/// Return the load case with the largest strain energy, the first of equal ones.
template <int dim>
unsigned int largest_case(const typename ShapeProblem<dim>::States &states)
{
  unsigned int largest = 0;
  for (unsigned int c = 1; c < states.size(); ++c)
    if (states[c].strain_energy > (1. + equal_energies) * states[largest].strain_energy)
      largest = c;
  return largest;
}
} // namespace

template <int dim>
std::vector<MeshError> mesh_errors(const ShapeProblem<dim>                  &problem,
                                   const typename ShapeProblem<dim>::States &states,
                                   const accuracy::Estimate                  asked)
{
  std::vector<MeshError> result;
  if (asked == accuracy::Estimate::none)
    return result;
  const RunContext::Timer                      timer(problem.context, "accuracy");
  std::vector<const response::Response<dim> *> responses;
  if (asked == accuracy::Estimate::responses)
    for (const auto &of_name : measured(problem))
      responses.push_back(of_name.second);
  const bool all = asked == accuracy::Estimate::responses;
  for (unsigned int c = 0; c < states.size(); ++c)
    {
      if (!all && c != largest_case<dim>(states))
        continue;
      std::optional<state::ContactState<dim>> solved_on;
      auto estimates = accuracy::estimate(*problem.solver, states[c], responses,
                                          problem.scene.gradient.solves, solved_on);
      result.push_back({c, std::move(estimates.energy), {}});
      for (auto &of_response : estimates.responses)
        result.back().responses.emplace_back(
          measured(problem)[result.back().responses.size()].first, std::move(of_response));
    }
  return result;
}

template <int dim>
std::vector<std::string> described(const ShapeProblem<dim>                  &problem,
                                   const typename ShapeProblem<dim>::States &states,
                                   const std::vector<MeshError>             &errors)
{
  const auto               responses = measured(problem);
  std::vector<std::string> lines;
  for (const auto &of_case : errors)
    {
      const auto        &state = states[of_case.load_case];
      std::ostringstream line;
      line.precision(3);
      line << "estimated discretization error";
      if (states.size() > 1)
        line << " in load case " << problem.scene.load_cases[of_case.load_case].name;
      if (errors.size() < states.size())
        line << ", which has the largest strain energy";
      line << ": " << 100. * of_case.energy.relative << " % in the energy norm";
      for (unsigned int j = 0; j < of_case.responses.size(); ++j)
        {
          const double value = responses[j].second->value(*problem.solver, state),
                       error = of_case.responses[j].second.error();
          const auto unit    = scene::unit_after_number(problem.scene, responses[j].first);
          line << "; " << responses[j].first << " " << value << unit << ", ";
          if (std::isnan(error))
            line << "not estimated";
          else if (value != 0.)
            line << 100. * error / std::abs(value) << " %";
          else
            line << error << unit;
        }
      lines.push_back(line.str());
    }
  return lines;
}

const MeshError *find_errors(const std::vector<MeshError> &errors, const unsigned int load_case)
{
  const auto found = std::find_if(errors.begin(), errors.end(), [&](const MeshError &error) {
    return error.load_case == load_case;
  });
  return found == errors.end() ? nullptr : &*found;
}

double objective_error(const scene::Scene           &scene,
                       const std::vector<double>    &factors,
                       const std::vector<MeshError> &errors)
{
  double sum = errors.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.;
  for (const auto &error : errors)
    {
      const auto &of        = error.responses;
      const auto  objective = std::find_if(of.begin(), of.end(), [&](const auto &response) {
        return response.first == scene.optimization.objective;
      });
      sum += objective == of.end() ? std::numeric_limits<double>::quiet_NaN()
                                   : std::abs(factors[error.load_case]) * objective->second.error();
    }
  return sum;
}

#define SNUG_INSTANTIATE(dim)                                                      \
  template std::vector<MeshError>   mesh_errors(const ShapeProblem<dim> &,         \
                                                const ShapeProblem<dim>::States &, \
                                                accuracy::Estimate);               \
  template std::vector<std::string> described(const ShapeProblem<dim> &,           \
                                              const ShapeProblem<dim>::States &,   \
                                              const std::vector<MeshError> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
