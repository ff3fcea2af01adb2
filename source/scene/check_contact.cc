#include <snug/scene/check.h>

#include <algorithm>

namespace snug::scene {
namespace {
bool is_obstacle(const Scene &scene, const std::string &name)
{
  return std::any_of(scene.obstacles.begin(), scene.obstacles.end(),
                     [&](const auto &obstacle) { return obstacle.name == name; });
}

void check_sides(const Scene                             &scene,
                 const SectionCheck                      &contact,
                 const std::string                       &value,
                 const contact::ContactParameters::Entry &pair)
{
  contact.require(!is_obstacle(scene, pair.slave), "Pairs", value,
                  "'" + pair.slave +
                    "' is an obstacle and must come second: "
                    "'body.boundary: " +
                    pair.slave + "'");
  require_face(scene, contact, "Pairs", value, pair.slave);
  if (!is_obstacle(scene, pair.master))
    require_face(scene, contact, "Pairs", value, pair.master);
  contact.require(pair.slave != pair.master, "Pairs", value,
                  "'" + pair.slave + "' must not be paired with itself");
}
} // namespace

void check_contact(const Scene &scene, const Origins &origins)
{
  for (const auto &obstacle : scene.obstacles)
    obstacle.check(SectionCheck(obstacle.section(), origins, scene.dimension));
  const SectionCheck contact("Contact", origins, scene.dimension);
  scene.contact.defaults.check(contact);
  TextPairs names;
  for (const auto &pair : scene.contact.pairs)
    names.emplace_back(pair.slave, pair.master);
  const std::string value = to_text(names);
  for (unsigned int p = 0; p < names.size(); ++p)
    {
      const auto &pair = scene.contact.pairs[p];
      check_sides(scene, contact, value, pair);
      const auto before = names.begin() + p;
      contact.require(std::count(names.begin(), before, names[p]) == 0 &&
                        std::count(names.begin(), before,
                                   std::make_pair(pair.master, pair.slave)) == 0,
                      "Pairs", value,
                      "'" + pair.slave + "' and '" + pair.master + "' must not be paired twice");
      pair.parameters.check(SectionCheck(pair.section(), origins, scene.dimension));
    }
}
} // namespace snug::scene
