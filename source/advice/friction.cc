#include <snug/advice/advice.h>
#include <snug/base/errors.h>
#include <snug/response/response.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace snug::advice {
namespace {
/// Return the responses of the scene and, for searches, its objective.
template <int dim>
std::vector<std::unique_ptr<response::Response<dim>>> asked_responses(const scene::Scene &scene)
{
  std::set<std::string> names;
  for (const auto &response : scene.responses)
    names.insert(response.name);
  if (scene.task != scene::Task::state)
    names.insert(scene.optimization.objective);
  std::vector<std::unique_ptr<response::Response<dim>>> result;
  for (const auto &name : names)
    result.push_back(response::make_response<dim>(*scene::response_called(scene, name)));
  return result;
}
} // namespace

template <int dim>
std::vector<Advice> needless_friction(const AdviceInput<dim> &input)
{
  const auto responses = asked_responses<dim>(input.scene);
  if (!input.solver.has_friction() || responses.empty())
    return {};
  auto model = input.model();
  for (auto &pair : model.pairs)
    pair.parameters.friction = contact::Friction::none;
  const auto                           &x = input.states[0].positions;
  state::StateSolver<dim>               without(input.mesh(), input.solver.tearing(), model, x,
                                                input.solver.context());
  double                                change = 0., f_mults[2] = {0., 0.};
  std::vector<state::ContactState<dim>> states;
  try
    {
      for (unsigned int c = 0; c < input.states.size(); ++c)
        {
          states.push_back(without.solve(x, without.scaled_start(states, x, c), c, states));
          f_mults[0] += static_cast<double>(input.states[c].f_mults);
          f_mults[1] += static_cast<double>(states[c].f_mults);
          for (const auto &response : responses)
            {
              const double value     = response->value(input.solver, input.states[c]),
                           remaining = response->value(without, states[c]);
              if (value != remaining)
                change = std::max(change, std::abs((remaining - value) / value));
            }
        }
    }
  catch (const SolveError &)
    {
      return {}; // friction holds a body
    }
  // The condition is written so that values that are not finite give no advice.
  if (!(change <= input.target))
    return {};
  std::ostringstream text;
  text << "without friction no response changes by more than " << 100. * change
       << " %: set 'Friction' = none";
  return {{"needless friction", text.str(), std::max(1., f_mults[0] / std::max(1., f_mults[1])),
           change, "time"}};
}

template std::vector<Advice> needless_friction(const AdviceInput<2> &);
template std::vector<Advice> needless_friction(const AdviceInput<3> &);
} // namespace snug::advice
