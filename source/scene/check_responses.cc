#include <snug/optimization/limit.h>
#include <snug/response/response.h>
#include <snug/scene/check.h>

#include <algorithm>

namespace snug::scene {
namespace {
using Parameters = response::ResponseParameters;

/// Return the names of the responses that an objective or a constraint may use.
std::vector<std::string> response_names(const Scene &scene)
{
  auto names = names_of(scene.responses);
  // The tables of 2D and 3D have the same names.
  for (const auto &row : response::response_table<3>())
    names.push_back(row.name);
  return names;
}

/// Check that the body, face and pair named by the response exist.
void check_places(const Scene &scene, const SectionCheck &section, const Parameters &response)
{
  section.require(response.body.empty() || body_index(scene, response.body) < scene.bodies.size(),
                  "Body", response.body, "there is no body '" + quotable(response.body) + "'");
  if (!response.face.empty())
    require_face(scene, section, "Face", response.face, response.face);
  const auto points = names_of(scene.points);
  section.require(response.reference_point.empty() ||
                    std::find(points.begin(), points.end(), response.reference_point) !=
                      points.end(),
                  "Reference point", response.reference_point, "there is no such reference point",
                  suggestion(response.reference_point, points));
  const auto bolts = names_of(scene.bolts);
  section.require(!response.reads("Bolt") ||
                    std::find(bolts.begin(), bolts.end(), response.bolt) != bolts.end(),
                  "Bolt", response.bolt, "must be the name of a bolt of 'Bolts'",
                  suggestion(response.bolt, bolts));
  if (!response.reads("Pair"))
    return;
  std::vector<std::string> known;
  for (const auto &pair : scene.contact.pairs)
    {
      if (pair.parameters.law == contact::Law::tied)
        continue;
      known.push_back(pair.slave + ": " + pair.master);
      known.push_back(pair.master + ": " + pair.slave);
    }
  section.require(!known.empty(), "Pair", response.pair,
                  "there is no contact to measure in the scene");
  section.require(response.pair.empty() ||
                    std::find(known.begin(), known.end(), response.pair) != known.end(),
                  "Pair", response.pair, "there is no such pair", suggestion(response.pair, known));
}

bool has_density(const Scene &scene, const Body &body)
{
  if (body.materials.empty())
    return body.material.density > 0.;
  for (const auto &[region, name] : body.materials)
    for (const auto &material : scene.materials)
      if (material.name == name && material.material.density > 0.)
        return true;
  return false;
}

/// Return whether a body of @p response has a density, so that the response is not zero in all
/// designs.
bool has_mass(const Scene &scene, const Parameters &response)
{
  for (const auto &body : scene.bodies)
    if ((response.body.empty() || response.body == body.name) && has_density(scene, body))
      return true;
  return false;
}

/// Return the response called @p name, which is a part of the @p value of an entry.
Parameters require_response(const Scene        &scene,
                            const SectionCheck &section,
                            const std::string  &entry,
                            const std::string  &value,
                            const std::string  &name)
{
  const auto known    = response_names(scene);
  const auto response = response_called(scene, name);
  section.require(response.has_value(), entry, value,
                  "'" + name + "' is not a response; the responses are " + to_text(known),
                  suggestion(name, known));
  section.require(!response->name.empty() || !(response->reads("Face") || response->reads("Bolt")),
                  entry, value,
                  "'" + name + "' needs a subsection Response with " +
                    (response->reads("Bolt") ? "'Bolt'" : "'Point' or 'Face'") +
                    ", and a name in 'Responses'");
  section.require(!response->reads("Pair") || !scene.contact.pairs.empty(), entry, value,
                  "'" + name + "' has no contact to measure in the scene");
  section.require(!response::make_response<3>(*response)->needs_density() ||
                    has_mass(scene, *response),
                  entry, value, "'" + name + "' is zero: its bodies have no 'Density'");
  return *response;
}
/// Return whether a constraint keeps a volume or mass of @p shapes at least as large as in the
/// first design.
bool keeps_material(const Scene &scene, const std::string &name, const std::string &text)
{
  const auto response = *response_called(scene, constraint_name(scene, name).response);
  const auto limit    = optimization::read_limit(text);
  const auto is_of    = [&](const auto &shape) {
    return response.body.empty() || split_face(shape.face).first == response.body;
  };
  return (response.quantity == "volume" || response.quantity == "mass") && limit.of_initial &&
         limit.value >= 1. && limit.side != optimization::Limit::Side::at_most &&
         std::any_of(scene.shapes.begin(), scene.shapes.end(), is_of);
}

/// Check that the shapes may move: faces that move only into the bodies, from a first design that
/// has not moved, cannot keep the volume.
void check_freedom(const Scene &scene, const Origins &origins)
{
  const bool removes = std::all_of(scene.shapes.begin(), scene.shapes.end(), [](const auto &shape) {
    return shape.only_remove && std::all_of(shape.initial.begin(), shape.initial.end(),
                                            [](const double of) { return of == 0.; });
  });
  for (const auto &[name, text] : scene.optimization.constraints)
    if (scene.task == Task::optimize && removes && keeps_material(scene, name, text))
      throw origins.error(scene.shapes.front().path("Only remove"), "true",
                          "must be false with 'Optimization/Constraints' = '" + name + ": " + text +
                            "', which only the first design satisfies");
}
} // namespace

void check_responses(const Scene &scene, const Origins &origins)
{
  for (const auto &response : scene.responses)
    {
      for (const auto &row : response::response_table<3>())
        if (row.name == response.name)
          throw origins.error("Responses", response.name, "must not be the name of a quantity");
      const SectionCheck section(response.section(), origins, scene.dimension);
      response.check(section);
      check_places(scene, section, response);
    }
  const SectionCheck section("Optimization", origins, scene.dimension);
  const auto        &optimization = scene.optimization;
  const std::string  value        = to_text(optimization.constraints);
  require_response(scene, section, "Objective", optimization.objective, optimization.objective);
  for (const auto &[name, limit] : optimization.constraints)
    {
      const auto of       = constraint_name(scene, name);
      const auto response = require_response(scene, section, "Constraints", value, of.response);
      section.require(!of.combination || of.combination->n_maxima() == 0 ||
                        trim(limit).rfind("<=", 0) == 0,
                      "Constraints", value, "the limit of '" + name + "' must be one with <=");
      section.require(scene.load_cases.size() < 2 || of.load_case || of.combination ||
                        !response::make_response<3>(response)->needs_solution(),
                      "Constraints", value,
                      "'" + name + "' must name its load case or a combination: '" +
                        (scene.load_cases.empty() ? "" : scene.load_cases.front().name) + "." +
                        name + "' or 'worst of " + name + "'");
    }
  optimization.check(section);
  check_freedom(scene, origins);
  const SectionCheck accuracy("Accuracy", origins, scene.dimension);
  for (const auto &target : scene.accuracy.targets)
    require_response(scene, accuracy, "Target", to_text(scene.accuracy.targets), target.first);
}
} // namespace snug::scene
