#include <snug/geometry/formula.h>
#include <snug/scene/check.h>
#include <snug/scene/section_check.h>
#include <snug/scene/values.h>

#include <algorithm>
#include <cmath>

namespace snug::scene {
namespace {
/// The entries of one subsection.
class Section : public SectionCheck
{
public:
  Section(const Scene &scene, const Origins &origins, const std::string &name)
    : SectionCheck(name, origins), scene(scene)
  {}

  void require_vector(const std::string &entry, const std::vector<double> &values) const
  {
    bool finite = true;
    for (const double value : values)
      finite = finite && std::isfinite(value);
    require(values.size() == scene.dimension && finite, entry, to_text(values),
            "must have " + to_text(scene.dimension) +
              " finite numbers separated by commas, one per dimension");
  }

  void require_direction(const std::string &entry, const std::vector<double> &values) const
  {
    require_vector(entry, values);
    require(std::any_of(values.begin(), values.end(), [](double value) { return value != 0.; }),
            entry, to_text(values), "must not be all zero");
  }

  /// @p text must be a formula.
  void require_formula(const std::string &entry, const std::string &text) const
  {
    try
      {
        if (scene.dimension == 2)
          geometry::Formula<2>(entry, text);
        else
          geometry::Formula<3>(entry, text);
      }
    catch (const InputError &error)
      {
        const std::string message = error.what();
        throw origins.error(path(entry), text, message.substr(message.find("must be")));
      }
  }

private:
  const Scene &scene;
};

void check_obstacle(const Scene                       &scene,
                    const Origins                     &origins,
                    const contact::ObstacleParameters &obstacle)
{
  const std::string name = "Obstacle " + obstacle.name;
  const Section     section(scene, origins, name);
  section.require_vector("Point", obstacle.point);
  section.require_direction("Normal", obstacle.normal);
  section.require_direction("Axis", obstacle.axis);
  section.require(std::isfinite(obstacle.radius) && obstacle.radius > 0., "Radius",
                  to_text(obstacle.radius), "must be above 0");
  section.require_vector("Displacement", obstacle.displacement);
  if (obstacle.shape == "formula")
    section.require_formula("Formula", obstacle.formula);
}

void check_pair_entries(const Section &section, const contact::PairParameters &parameters)
{
  section.require(std::isfinite(parameters.search_distance) && parameters.search_distance >= 0.,
                  "Search distance", to_text(parameters.search_distance), "must be 0 or above");
  section.require(parameters.largest_angle > 0. && parameters.largest_angle <= 180.,
                  "Largest angle", to_text(parameters.largest_angle),
                  "must be above 0 and at most 180");
  section.require(parameters.method != "mortar" || parameters.largest_angle <= 60. ||
                    parameters.largest_angle == contact::PairParameters().largest_angle,
                  "Largest angle", to_text(parameters.largest_angle),
                  "must be at most 60 for mortar");
  section.require_formula("Gap", parameters.gap);
}

bool is_obstacle(const Scene &scene, const std::string &name)
{
  return std::any_of(scene.obstacles.begin(), scene.obstacles.end(),
                     [&](const auto &obstacle) { return obstacle.name == name; });
}

void check_sides(const Scene                             &scene,
                 const Origins                           &origins,
                 const std::string                       &value,
                 const contact::ContactParameters::Entry &pair)
{
  const std::string path = "Contact/Pairs";
  if (is_obstacle(scene, pair.slave))
    throw origins.error(path, value,
                        "'" + pair.slave +
                          "' is an obstacle and must come second: "
                          "'body.boundary: " +
                          pair.slave + "'");
  require_face(scene, origins, path, value, pair.slave);
  if (!is_obstacle(scene, pair.master))
    require_face(scene, origins, path, value, pair.master);
  if (pair.slave == pair.master)
    throw origins.error(path, value, "'" + pair.slave + "' must not be paired with itself");
}
} // namespace

void require_face(const Scene       &scene,
                  const Origins     &origins,
                  const std::string &path,
                  const std::string &value,
                  const std::string &face)
{
  const auto [name, boundary] = split_face(face);
  const unsigned int index    = body_index(scene, name);
  if (boundary.empty())
    throw origins.error(path, value,
                        "'" + quotable(face) + "' must read 'body.boundary'" +
                          (scene.obstacles.empty() ? "" : " or be an obstacle in 'Obstacles'"));
  std::vector<std::string> known;
  if (index == scene.bodies.size())
    {
      for (const auto &body : scene.bodies)
        known.push_back(body.name);
      throw origins.error(path, value,
                          "there is no body '" + quotable(name) + "', there are " + listed(known) +
                            did_you_mean(name, known));
    }
  known = boundary_names(scene.bodies[index], scene.dimension);
  if (std::find(known.begin(), known.end(), boundary) == known.end())
    throw origins.error(path, value,
                        "'" + quotable(boundary) + "' is no boundary of '" + name + "', they are " +
                          listed(known) + did_you_mean(boundary, known));
}

void check_contact(const Scene &scene, const Origins &origins)
{
  for (const auto &obstacle : scene.obstacles)
    check_obstacle(scene, origins, obstacle);
  check_pair_entries(Section(scene, origins, "Contact"), scene.contact.defaults);
  TextPairs names;
  for (const auto &pair : scene.contact.pairs)
    names.emplace_back(pair.slave, pair.master);
  const std::string value = to_text(names);
  for (unsigned int p = 0; p < names.size(); ++p)
    {
      const auto &pair = scene.contact.pairs[p];
      check_sides(scene, origins, value, pair);
      const auto before = names.begin() + p;
      if (std::count(names.begin(), before, names[p]) > 0 ||
          std::count(names.begin(), before, std::make_pair(pair.master, pair.slave)) > 0)
        throw origins.error("Contact/Pairs", value,
                            "'" + pair.slave + "' and '" + pair.master +
                              "' must not be paired twice");
      const std::string name = "Pair " + pair.slave + ": " + pair.master;
      check_pair_entries(Section(scene, origins, name), pair.parameters);
    }
}
} // namespace snug::scene
