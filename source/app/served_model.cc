#include <snug/app/results.h>
#include <snug/app/served_model.h>
#include <snug/base/entries.h>
#include <snug/state/validity_checks.h>

#include <algorithm>
#include <sstream>

namespace snug::app {
namespace {
/// Return all that the cells of the bodies depend on as text. Bodies from files are never equal,
/// because the files may have changed.
std::vector<std::string> mesh_texts(const scene::Scene &scene)
{
  std::vector<std::string> texts;
  for (auto mesh : mesh_parameters(scene))
    {
      std::ostringstream text;
      Entries            entries;
      mesh.declare(entries);
      entries.print(text);
      text << mesh.imported.get() << ' ' << mesh.is_designed << mesh.samples_all_curved;
      for (const auto &boundary : mesh.sampled_boundaries)
        text << ' ' << boundary;
      texts.push_back(text.str());
    }
  return texts;
}

/// Return the names of the responses of a scene, its objective and its constraints, without
/// repetitions.
std::vector<std::string> response_names(const scene::Scene &scene)
{
  auto       names = scene::names_of(scene.responses);
  const auto add   = [&](const std::string &name) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  };
  add(scene.optimization.objective);
  for (const auto &constraint : scene.optimization.constraints)
    add(scene::constraint_name(scene, constraint.first).response);
  return names;
}

std::string unit(const scene::Scene &scene, const std::string &response)
{
  return trim(scene::unit_after_number(scene, response));
}

std::string side_name(const optimization::Limit::Side side)
{
  using Side = optimization::Limit::Side;
  return side == Side::at_most ? "at_most" : side == Side::equal ? "equal" : "at_least";
}

template <int dim>
std::vector<Warning> warnings_of(const std::vector<state::ContactState<dim>> &states)
{
  std::vector<Warning> result;
  for (const auto &state : states)
    {
      const auto found = state::warnings(state.validity);
      result.insert(result.end(), found.begin(), found.end());
      for (const auto &line : state.free_bodies)
        result.push_back({"free body", line});
    }
  return result;
}

/// Return the value of a key that is true or false, or false without the key. @throws
/// io::RequestError.
bool flag(const Json &request, const std::string &key)
{
  const Json value = request.value(key, Json(false));
  if (!value.is_boolean())
    throw io::RequestError("'" + key + "' must be true or false");
  return value.get<bool>();
}

/// Return what the names of the outputs of a load case begin with in answers.
std::string prefix(const scene::Scene &scene, const unsigned int c)
{
  return scene.load_cases.size() < 2 ? "" : scene.load_cases[c].name + ".";
}
} // namespace

template <int dim>
ServedModel<dim>::ServedModel(RunContext         &context,
                              const scene::Scene &the_scene,
                              const ServedModel  *earlier)
  : context(context), scene(the_scene), meshes(mesh_texts(scene)), names(response_names(scene))
{
  if (!scene.accuracy.targets.empty())
    throw Origins(scene.file, {})
      .error("Accuracy/Target", to_text(scene.accuracy.targets),
             "must be empty, because --serve takes one mesh");
  if (!scene.state_tolerance)
    scene.state_tolerance = search_tolerance<dim>(scene, names);
  has_earlier_mesh = earlier && earlier->meshes == meshes;
  if (has_earlier_mesh)
    forest = earlier->forest;
  else
    forest = build_forest<dim>(scene, context.communicator());
  problem = std::make_unique<ShapeProblem<dim>>(context, scene, build_mesh<dim>(scene, *forest));
  problem->check_overlaps();
  Results<dim>(*problem).print_header();
  paired    = problem->shapes->start();
  analyses  = std::make_unique<Analyses<dim>>(*problem);
  objective = std::make_unique<Objective<dim>>(*problem, *analyses, paired);
  for (const auto &name : names)
    responses.push_back(problem->make_response(name));
  for (unsigned int c = 0; c < problem->n_load_cases(); ++c)
    for (unsigned int i = 0; i < names.size(); ++i)
      {
        outputs.push_back({responses[i].get(), c});
        output_names.push_back(prefix(scene, c) + names[i]);
      }
}

template <int dim>
Json ServedModel<dim>::describe() const
{
  const auto &shapes = *problem->shapes;
  Json answer = {{"variables", io::variables_part(scene, shapes)}, {"limits", Json::array()}};
  for (const auto &limit : shapes.limits())
    answer["limits"].push_back(
      {{"row", limit.row}, {"bound", limit.bound}, {"entry", limit.entry}});
  answer["load_cases"] = Json::array();
  for (unsigned int c = 0; c < scene.load_cases.size(); ++c)
    answer["load_cases"].push_back(
      {{"name", scene.load_cases[c].name}, {"weight", problem->weight(c)}});
  answer["responses"] = Json::array();
  for (unsigned int i = 0; i < outputs.size(); ++i)
    answer["responses"].push_back({{"name", output_names[i]},
                                   {"unit", unit(scene, names[i % names.size()])},
                                   {"needs_state", outputs[i].response->needs_solution()}});
  answer["objective"]     = scene.optimization.objective;
  answer["constraints"]   = Json::array();
  const auto &given       = scene.optimization.constraints;
  const auto  constraints = this->constraints();
  for (unsigned int i = 0; i < constraints.size(); ++i)
    answer["constraints"].push_back(
      {{"name", constraints[i].name},
       {"response", scene::constraint_name(scene, given[i].first).response},
       {"target", constraints[i].limit},
       {"side", side_name(constraints[i].side)}});
  answer["tolerance"] = problem->solver->tolerance();
  answer["unknowns"]  = dim * problem->mesh->n_global_free_nodes();
  answer["warnings"]  = io::warnings_part(context.warnings());
  return answer;
}

/// Return names, limits and sides of the constraints. Their values are not used.
template <int dim>
std::vector<typename Objective<dim>::ConstraintValue> ServedModel<dim>::constraints() const
{
  const std::vector<double> unused(scene.optimization.constraints.size());
  return objective->constraint_values(unused, unused);
}

template <int dim>
typename ServedModel<dim>::Design ServedModel<dim>::design(const Json &request) const
{
  const auto &shapes = *problem->shapes;
  if (!request.contains("x"))
    return shapes.start();
  const Json &x = request["x"];
  if (!x.is_array() ||
      !std::all_of(x.begin(), x.end(), [](const Json &value) { return value.is_number(); }))
    throw io::RequestError("'x' must be a list of numbers");
  if (x.size() != shapes.n_variables())
    throw io::RequestError("'x' has " + std::to_string(x.size()) + " numbers, but there are " +
                           std::to_string(shapes.n_variables()) + " design variables");
  const auto result = x.get<Design>();
  if (flag(request, "outside"))
    return result;
  for (unsigned int i = 0; i < result.size(); ++i)
    if (result[i] < shapes.lower_bounds()[i] || result[i] > shapes.upper_bounds()[i])
      throw io::RequestError("x[" + std::to_string(i) + "] = " + x[i].dump() + " must be from " +
                             Json(shapes.lower_bounds()[i]).dump() + " to " +
                             Json(shapes.upper_bounds()[i]).dump());
  if (const auto entry = shapes.most_violated_limit(result); !entry.empty())
    throw io::RequestError("'x' violates the limit of entry '" + entry + "'");
  return result;
}

/// Return the states of a design, which are known if the design is the last one and was solved as
/// requested. The solver is at their geometry, also after requests that failed.
template <int dim>
const typename ServedModel<dim>::States &ServedModel<dim>::analyse(const Design &design,
                                                                   const bool    is_cold)
{
  if (const auto *last = analyses->last(design); last && (last_is_cold || !is_cold))
    {
      for (const auto &state : last->states)
        problem->solver->restore(state);
      return last->states;
    }
  const auto &states = analyses->solve(design, is_cold).states;
  last_is_cold       = is_cold;
  return states;
}

template <int dim>
std::vector<unsigned int> ServedModel<dim>::wanted_gradients(const Json &request) const
{
  std::vector<unsigned int> wanted;
  const Json                given = request.value("gradients", Json(false));
  if (given != Json(false) && problem->shapes->n_variables() == 0)
    throw io::RequestError("there are no gradients, because the model has no design variables");
  if (given.is_boolean())
    {
      for (unsigned int i = 0; i < outputs.size() && given == Json(true); ++i)
        wanted.push_back(i);
      return wanted;
    }
  if (!given.is_array())
    throw io::RequestError("'gradients' must be true, false or a list of names of responses");
  for (const Json &name : given)
    {
      const auto found = std::find(output_names.begin(), output_names.end(), name);
      if (found == output_names.end())
        throw io::RequestError("'gradients': there is no response " + name.dump());
      wanted.push_back(found - output_names.begin());
    }
  return wanted;
}

template <int dim>
Json ServedModel<dim>::values(const States &states) const
{
  Json of_responses = Json::object();
  for (unsigned int i = 0; i < outputs.size(); ++i)
    of_responses[output_names[i]] =
      outputs[i].response->value(*problem->solver, states[outputs[i].load_case]);
  const auto found       = objective->values(states);
  Json       constraints = Json::array();
  const auto of_scene    = this->constraints();
  for (unsigned int i = 0; i < of_scene.size(); ++i)
    constraints.push_back({{"name", of_scene[i].name}, {"value", found.constraints[i]}});
  return {{"values", of_responses},
          {"objective", {{"value", found.objective}}},
          {"constraints", constraints}};
}

template <int dim>
void ServedModel<dim>::add_gradients(const Design                    &design,
                                     const std::vector<unsigned int> &wanted,
                                     const bool                       all,
                                     Json                            &answer)
{
  sensitivity::MeasuredResponses<dim> measured;
  for (const unsigned int i : wanted)
    measured.push_back(outputs[i]);
  auto parameters           = scene.gradient;
  parameters.shape_gradient = false;
  if (parameters.method == sensitivity::Method::energy) // does not hold for every response
    parameters.method.reset();
  const auto &found        = analyses->gradients(design, measured, parameters).of_response;
  bool        is_two_sided = true;
  for (unsigned int k = 0; k < wanted.size(); ++k)
    {
      answer["gradients"][output_names[wanted[k]]] = found[k].values;
      answer["methods"][output_names[wanted[k]]]   = to_text(found[k].method);
      is_two_sided                                 = is_two_sided && found[k].differentiable;
    }
  answer["differentiable"] = is_two_sided;
  if (!all)
    return;
  // All outputs are wanted, in their order.
  std::vector<sensitivity::Gradient<dim>> of_objective;
  for (const auto &[name, c] : objective->measured_names())
    of_objective.push_back(
      found[c * names.size() + (std::find(names.begin(), names.end(), name) - names.begin())]);
  const auto combined = objective->combined_gradients(analyses->last(design)->states, of_objective);
  answer["objective"]["gradient"] = combined.front().values;
  const auto constraints          = this->constraints();
  for (unsigned int i = 0; i < constraints.size(); ++i)
    {
      auto       gradient = combined[i + 1].values;
      const bool is_least = constraints[i].side == optimization::Limit::Side::at_least;
      for (double &entry : gradient)
        entry *= is_least ? -1. : 1.;
      answer["constraints"][i]["gradient"] = gradient;
    }
}

template <int dim>
Json ServedModel<dim>::evaluate(const Json &request)
{
  const auto        x            = design(request);
  const auto        wanted       = wanted_gradients(request);
  const bool        with_contact = flag(request, "contact"), with_errors = flag(request, "errors");
  const std::string start = request.value("start", "cold");
  if (start != "cold" && start != "warm")
    throw io::RequestError("'start' must be \"cold\" or \"warm\"");
  const double begin  = context.seconds();
  const Work   before = context.total_work();
  const auto  &states = analyse(x, start == "cold");
  Json         answer = {{"x", x}};
  answer.update(values(states));
  const double solved = context.seconds();
  if (!wanted.empty())
    add_gradients(x, wanted, request["gradients"] == Json(true), answer);
  const double differentiated = context.seconds();
  answer["load_cases"]        = io::load_cases_part(scene, states);
  answer["drift"]             = problem->drift(x);
  if (with_errors)
    add_errors(states, answer);
  const Work after = context.total_work();
  if (with_contact)
    answer["contact"] = io::contact_part(scene, *problem->solver, states);
  answer["work"]     = {{"f_mults", after.f_mults - before.f_mults},
                        {"numeric_factorizations",
                         after.numeric_factorizations - before.numeric_factorizations}};
  answer["warnings"] = io::warnings_part(warnings_of(states));
  answer["ms"]       = {{"state", 1e3 * (solved - begin)},
                        {"gradients", 1e3 * (differentiated - solved)},
                        {"other", 1e3 * (context.seconds() - differentiated)}};
  return answer;
}

template <int dim>
void ServedModel<dim>::add_errors(const States &states, Json &answer)
{
  const auto errors = mesh_errors(*problem, states, accuracy::Estimate::responses);
  answer["errors"]  = Json::object();
  for (const auto &[c, energy, responses] : errors)
    {
      answer["load_cases"][c]["energy_norm"] = {{"error", energy.error},
                                                {"relative", energy.relative}};
      for (const auto &[name, estimate] : responses)
        answer["errors"][prefix(scene, c) + name] = estimate.error();
    }
  const auto combined          = problem->combined_objective(states);
  answer["objective"]["error"] = objective_error(scene, combined.factors, errors);
}

template <int dim>
Json ServedModel<dim>::write(const Json &request)
{
  const auto  x        = design(request);
  const auto &states   = analyse(x, true);
  auto        as_run   = scene;
  const auto  by_shape = problem->shapes->by_shape(x);
  for (auto &shape : as_run.shapes)
    for (const auto &[name, values] : by_shape)
      if (shape.name == name)
        shape.initial = values;
  as_run.task = scene::Task::state;
  io::prepare_output(context, as_run);
  io::remove_earlier_results(context, scene);
  Results<dim> results(*problem);
  results.summary.task = to_text(as_run.task);
  results.warn(states);
  results.add_last(0., states);
  results.export_shape(x);
  results.write_summary();
  return {{"x", x},
          {"directory", scene.output_directory},
          {"files", io::written_files(context, scene)}};
}

template <int dim>
Json ServedModel<dim>::pair(const Json &request)
{
  const auto x = design(request);
  try
    {
      analyses->pair(x);
    }
  catch (const std::exception &)
    {
      analyses->pair(paired);
      throw;
    }
  paired = x;
  return {{"x", x}};
}

template class ServedModel<2>;
template class ServedModel<3>;
} // namespace snug::app
