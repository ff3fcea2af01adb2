#include <snug/optimization/limit.h>
#include <snug/optimization/minimize.h>
#include <snug/response/response.h>
#include <snug/scene/check.h>
#include <snug/scene/section_check.h>
#include <snug/scene/values.h>

#include <algorithm>
#include <tuple>

namespace snug::scene {
namespace {
using Parameters = response::ResponseParameters;

/// Names of the responses an objective or a constraint may be.
std::vector<std::string> response_names(const Scene &scene)
{
  std::vector<std::string> names;
  for (const auto &response : scene.responses)
    names.push_back(response.name);
  // The same in 2D and 3D.
  for (const auto &row : response::response_table<3>())
    names.push_back(row.name);
  return names;
}

/// Checks the entries of one response, as far as no mesh is needed.
class ResponseCheck : public SectionCheck
{
public:
  ResponseCheck(const Scene &scene, const Parameters &response, const Origins &origins)
    : SectionCheck(response.section(), origins)
    , scene(scene)
    , response(response)
    , entries(response::make_response<3>(response)->entries())
  {}

  void check() const
  {
    check_unread();
    check_place();
    check_pair();
    require(response.exponent >= 1. && response.exponent <= 1000., "Exponent",
            to_text(response.exponent), "must lie between 1 and 1000");
    require(response.smoothing > 0. && response.smoothing <= 1., "Smoothing",
            to_text(response.smoothing), "must be above 0 and at most 1");
  }

private:
  bool reads(const std::string &entry) const
  {
    return std::find(entries.begin(), entries.end(), entry) != entries.end();
  }

  /// Entries that are set must be read.
  void check_unread() const
  {
    const Parameters                                  initial;
    const std::tuple<const char *, std::string, bool> values[] = {
      {"Body", response.body, response.body.empty()},
      {"Face", response.face, response.face.empty()},
      {"Point", to_text(response.point), response.point.empty()},
      {"Component", response.component, response.component == initial.component},
      {"Pair", response.pair, response.pair.empty()},
      {"Exponent", to_text(response.exponent), response.exponent == initial.exponent},
      {"Smoothing", to_text(response.smoothing), response.smoothing == initial.smoothing}};
    for (const auto &[entry, value, is_initial] : values)
      require(is_initial || reads(entry), entry, value,
              "must be left out for Quantity = " + response.quantity);
  }

  void check_place() const
  {
    if (!response.body.empty())
      require(body_index(scene, response.body) < scene.bodies.size(), "Body", response.body,
              "there is no body '" + quotable(response.body) + "'");
    if (!response.face.empty())
      require_face(scene, origins, path("Face"), response.face, response.face);
    const auto &point = response.point;
    require(point.empty() || (point.size() == scene.dimension && all_finite(point)), "Point",
            to_text(point),
            "must have " + to_text(scene.dimension) + " numbers separated by commas");
    if (reads("Point"))
      {
        require(point.empty() != response.face.empty(), "Point", to_text(point),
                "either 'Point' or 'Face' must be given");
        require(response.face.empty() || response.body.empty(), "Body", response.body,
                "must be left out with 'Face'");
        require(point.empty() || response.component != "normal", "Component", response.component,
                "must be x, y or z with 'Point'");
      }
    require(response.component != "z" || scene.dimension == 3, "Component", response.component,
            "must be normal, x or y for Dimension = 2");
  }

  void check_pair() const
  {
    if (!reads("Pair"))
      return;
    std::vector<std::string> known;
    for (const auto &pair : scene.contact.pairs)
      {
        known.push_back(pair.slave + ": " + pair.master);
        known.push_back(pair.master + ": " + pair.slave);
      }
    require(!known.empty(), "Pair", response.pair, "there is no contact to measure in the scene");
    require(response.pair.empty() ||
              std::find(known.begin(), known.end(), response.pair) != known.end(),
            "Pair", response.pair, "there is no such pair" + did_you_mean(response.pair, known));
  }

  const Scene                   &scene;
  const Parameters              &response;
  const std::vector<std::string> entries;
};

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
                        "'" + name + "' is no response, there are " + listed(known) +
                          did_you_mean(name, known));
  const auto entries = response::make_response<3>(*response)->entries();
  const auto reads   = [&entries](const char *entry) {
    return std::find(entries.begin(), entries.end(), entry) != entries.end();
  };
  if (response->name.empty() && reads("Point"))
    throw origins.error(path, value,
                        "'" + name +
                          "' needs a subsection Response with 'Point' "
                          "or 'Face', and a name in 'Responses'");
  if (reads("Pair") && scene.contact.pairs.empty())
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
      ResponseCheck(scene, response, origins).check();
    }
  const auto &objective = scene.optimization.objective;
  require_response(scene, origins, "Optimization/Objective", objective, objective);
  for (const auto &[name, limit] : scene.optimization.constraints)
    check_constraint(scene, origins, name, limit);
}
} // namespace snug::scene
