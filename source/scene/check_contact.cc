#include <snug/geometry/face_list.h>
#include <snug/scene/check.h>

#include <algorithm>
#include <set>

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
  const auto slaves = geometry::face_list(pair.slave), masters = geometry::face_list(pair.master);
  const auto check_side = [&](const std::vector<std::string> &faces) {
    for (const auto &face : faces)
      {
        contact.require(!is_obstacle(scene, face), "Pairs", value,
                        "'" + face + "' is an obstacle and must be a side by itself");
        require_face(scene, contact, "Pairs", value, face);
        contact.require(split_face(face).first == split_face(faces.front()).first, "Pairs", value,
                        "'" + faces.front() + "' and '" + face +
                          "' must be boundaries of one body to make one side");
        contact.require(std::count(faces.begin(), faces.end(), face) == 1, "Pairs", value,
                        "'" + face + "' must be named once by a side");
      }
  };
  check_side(slaves);
  if (!is_obstacle(scene, pair.master))
    check_side(masters);
  for (const auto &face : slaves)
    contact.require(std::count(masters.begin(), masters.end(), face) == 0, "Pairs", value,
                    "'" + face + "' must not be paired with itself");
}

/// Check that limits of friction are set for pairs with the law that reads them, and for no other
/// pairs. Pairs may inherit a limit that they do not read.
void check_limits(const Scene            &scene,
                  const Origins          &origins,
                  const contact::Friction law,
                  const std::string      &entry,
                  const std::string contact::PairParameters::*limit)
{
  const auto       &pairs         = scene.contact.pairs;
  const std::string default_limit = scene.contact.defaults.*limit;
  const std::string allowed       = "must be left out unless Friction = " + to_text(law);
  const auto        reads = [law](const contact::PairParameters &of) { return of.friction == law; };
  SectionCheck("Contact", origins, scene.dimension)
    .require(default_limit.empty() || default_limit == "0" || reads(scene.contact.defaults) ||
               std::any_of(pairs.begin(), pairs.end(),
                           [&](const auto &pair) { return reads(pair.parameters); }),
             entry, default_limit, allowed);
  for (const auto &pair : pairs)
    {
      const std::string &own = pair.parameters.*limit;
      SectionCheck(pair.section(), origins, scene.dimension)
        .require(reads(pair.parameters) || own == default_limit, entry, own, allowed);
      SectionCheck(reads(scene.contact.defaults) ? "Contact" : pair.section(), origins,
                   scene.dimension)
        .require(!reads(pair.parameters) || !own.empty(), "Friction", to_text(law),
                 "needs a '" + entry + "' for '" + pair.slave + ": " + pair.master + "'");
    }
}

/// Check that a tied pair joins two bodies and has no entries of contact of its own.
void check_tied(const Scene                             &scene,
                const SectionCheck                      &section,
                const contact::ContactParameters::Entry &pair)
{
  const auto &of = pair.parameters, &inherited = scene.contact.defaults;
  const auto  forbid = [&](const bool is_own, const std::string &entry, const std::string &value) {
    section.require(!is_own, entry, value, "must be left out for Law = tied");
  };
  section.require(!is_obstacle(scene, pair.master), "Law", "tied",
                  "must be contact for the obstacle '" + pair.master + "'");
  const auto bodies = {split_face(geometry::face_list(pair.slave).front()).first,
                       split_face(geometry::face_list(pair.master).front()).first};
  for (const auto &load_case : scene.load_cases)
    {
      std::set<std::string> motions;
      for (const auto &body : bodies)
        {
          std::string motion;
          for (const auto &[name, text] : load_case.positions)
            if (name == body)
              motion += text + ";";
          motions.insert(motion);
        }
      section.require(motions.size() == 1, "Law", "tied",
                      "must be contact, because load case '" + load_case.name +
                        "' moves the bodies differently");
    }
  forbid(of.friction != inherited.friction, "Friction", to_text(of.friction));
  forbid(of.gap != inherited.gap, "Gap", of.gap);
  forbid(of.interference != inherited.interference, "Interference", to_text(of.interference));
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
      const SectionCheck of_pair(pair.section(), origins, scene.dimension);
      pair.parameters.check(of_pair);
      if (pair.parameters.law == contact::Law::tied)
        check_tied(scene, of_pair, pair);
    }
  check_limits(scene, origins, contact::Friction::Coulomb, "Friction coefficient",
               &contact::PairParameters::friction_coefficient);
  check_limits(scene, origins, contact::Friction::Tresca, "Friction bound",
               &contact::PairParameters::friction_bound);
}
} // namespace snug::scene
