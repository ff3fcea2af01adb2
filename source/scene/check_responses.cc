#include <snug/optimization/limit.h>
#include <snug/optimization/minimize.h>
#include <snug/response/response.h>
#include <snug/scene/check.h>

#include <algorithm>

namespace snug::scene {
namespace {
using Parameters = response::ResponseParameters;

/// Names of the responses an objective or a constraint may be.
std::vector<std::string> response_names(const Scene &scene)
{
  auto names = names_of(scene.responses);
  // The same in 2D and 3D.
  for (const auto &row : response::response_table<3>())
    names.push_back(row.name);
  return names;
}

/// What the response names is there.
void check_places(const Scene &scene, const SectionCheck &section, const Parameters &response)
{
  section.require(response.body.empty() || body_index(scene, response.body) < scene.bodies.size(),
                  "Body", response.body, "there is no body '" + quotable(response.body) + "'");
  if (!response.face.empty())
    require_face(scene, section, "Face", response.face, response.face);
  if (!response.reads("Pair"))
    return;
  std::vector<std::string> known;
  for (const auto &pair : scene.contact.pairs)
    {
      known.push_back(pair.slave + ": " + pair.master);
      known.push_back(pair.master + ": " + pair.slave);
    }
  section.require(!known.empty(), "Pair", response.pair,
                  "there is no contact to measure in the scene");
  section.require(response.pair.empty() ||
                    std::find(known.begin(), known.end(), response.pair) != known.end(),
                  "Pair", response.pair,
                  "there is no such pair" + did_you_mean(response.pair, known));
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

/// Whether what @p response measures is there, not zero in all designs.
bool has_mass(const Scene &scene, const Parameters &response)
{
  for (const auto &body : scene.bodies)
    if ((response.body.empty() || response.body == body.name) && has_density(scene, body))
      return true;
  return false;
}

/// The response that @p value, the entry @p path, calls @p name.
Parameters require_response(const Scene       &scene,
                            const Origins     &origins,
                            const std::string &path,
                            const std::string &value,
                            const std::string &name)
{
  const auto known    = response_names(scene);
  const auto response = response_called(scene, name);
  if (!response)
    throw origins.error(path, value,
                        "'" + name + "' is no response, there are " + to_text(known) +
                          did_you_mean(name, known));
  if (response->name.empty() && response->reads("Point"))
    throw origins.error(path, value,
                        "'" + name +
                          "' needs a subsection Response with 'Point' "
                          "or 'Face', and a name in 'Responses'");
  if (response->reads("Pair") && scene.contact.pairs.empty())
    throw origins.error(path, value, "'" + name + "' has no contact to measure in the scene");
  if (response->quantity == "mass" && !has_mass(scene, *response))
    throw origins.error(path, value, "'" + name + "' is zero: what it measures has no 'Density'");
  return *response;
}

void check_constraint(const Scene       &scene,
                      const Origins     &origins,
                      const std::string &name,
                      const std::string &text)
{
  const auto       &optimization = scene.optimization;
  const std::string path         = "Optimization/Constraints";
  const std::string value        = to_text(optimization.constraints);
  const auto        of           = constraint_name(scene, name);
  const auto        parameters   = require_response(scene, origins, path, value, of.response);
  if (name == optimization.objective)
    throw origins.error(path, value, "'" + name + "' is the objective already");
  if (scene.load_cases.size() > 1 && !of.load_case &&
      response::make_response<3>(parameters)->needs_solution())
    throw origins.error(path, value,
                        "'" + name + "' must name its load case: '" +
                          scene.load_cases.front().name + "." + name + "'");
  optimization::Limit limit;
  try
    {
      limit = optimization::read_limit(text);
    }
  catch (const std::exception &)
    {
      throw origins.error(path, value,
                          "the limit of '" + name +
                            "' must be like '= initial', '<= 120' or "
                            "'>= 0.9 initial'");
    }
  if (limit.side == optimization::Limit::Side::equal &&
      !optimization::takes_equalities(optimization.algorithm))
    throw origins.error(path, value,
                        "'" + name + "' must have a limit with <= or >=: " +
                          optimization.algorithm + " takes no equalities, SLSQP and AUGLAG do");
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
  const auto &objective = scene.optimization.objective;
  require_response(scene, origins, "Optimization/Objective", objective, objective);
  for (const auto &[name, limit] : scene.optimization.constraints)
    check_constraint(scene, origins, name, limit);
}
} // namespace snug::scene
