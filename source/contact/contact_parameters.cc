#include <snug/base/section_check.h>
#include <snug/contact/contact.h>
#include <snug/geometry/formula.h>

#include <algorithm>
#include <cstdlib>

namespace snug::contact {
void ObstacleParameters::declare(Entries &entries)
{
  const Form vector = per_dimension({}, "finite numbers separated by commas");
  entries.add("Shape", shape, choice(names(obstacle_table<3>())), "The shape of the obstacle.");
  entries.add("Point", point, vector,
              "A point of the plane, the centre of the sphere, a point of the cylinder's axis, or "
              "the origin of the formula. Units: length. An empty list means the origin.");
  entries.add("Normal", normal, vector,
              "The normal of a plane, pointing out of the obstacle, of any length. An empty list "
              "means the last axis.");
  entries.add("Axis", axis, vector,
              "The axis of a cylinder, or the direction of the formula's last coordinate, of any "
              "length. An empty list means the last axis.");
  entries.add("Radius", radius, above(0.), "The radius of a sphere or a cylinder. Units: length.");
  entries.add(
    "Formula", formula, allowed("a formula of x, y and, in 3D, z"),
    "The formula that is negative inside the obstacle, positive outside, and smooth on the scale "
    "of the elements.");
  entries.add("Displacement", displacement, vector,
              "The translation of the obstacle as a load. Contacts keep the normals at the initial "
              "position. Units: length. An empty list means no translation.");
}

void ObstacleParameters::complete(const unsigned int dimension)
{
  std::vector<double> zero(dimension, 0.), last = zero;
  last.back() = 1.;
  for (auto *vector : {&point, &displacement})
    if (vector->empty())
      *vector = zero;
  for (auto *vector : {&normal, &axis})
    if (vector->empty())
      *vector = last;
}

void ObstacleParameters::check(const SectionCheck &section) const
{
  const auto require_direction = [&](const std::string &entry, const std::vector<double> &vector) {
    section.require(std::any_of(vector.begin(), vector.end(), [](double v) { return v != 0.; }),
                    entry, to_text(vector), "must not be all zero");
  };
  require_direction("Normal", normal);
  require_direction("Axis", axis);
  const auto &read = choose(obstacle_table<3>(), shape).entries;
  if (std::find(read.begin(), read.end(), "Formula") != read.end())
    geometry::require_formula(section, "Formula", formula, formula);
}

bool PairParameters::has_friction() const
{
  const char *const text    = resistance().c_str();
  char             *end     = nullptr;
  const bool        is_zero = std::strtod(text, &end) == 0. && end != text && *end == '\0';
  return law == Law::contact && friction != Friction::none && !resistance().empty() && !is_zero;
}

void PairParameters::declare(Entries &entries)
{
  entries.add("Law", law,
              "Whether the sides are in contact or tied. Entries of friction, 'Gap' and "
              "'Interference' are for contact only.");
  entries.add("Method", method,
              choice_or_auto<Method>(
                "nodal if every node of both sides within the search distance matches a "
                "node of the other side within 1 % of a face, else mortar"),
              "The contact discretization of two faces.");
  entries.add("Slave", slave,
              "The side whose nodes carry the contact pressure and must not penetrate the other "
              "side.");
  entries.add(
    "Search distance", search_distance, at_least(0., "must be 0 or above"),
    "The maximum distance from the master side in the first design. Slave nodes beyond it "
    "are excluded from contact. Units: length. A value of 0 means any distance.");
  entries.add(
    "Largest angle", largest_angle, above(0., 180.),
    "The maximum angle between the slave's normal and the direction into the master in the "
    "first design. Slave nodes beyond it are excluded from contact. For mortar it is the "
    "angle between faces, at most 60. Units: degrees.");
  entries.add("Gap", gap, allowed("a formula of x, y and, in 3D, z"),
              "The length that is added to the gap at each slave node. Units: length.");
  entries.add("Interference", interference,
              with_meanings({}, {{"true", "an initial overlap is intended, as in a shrink fit"},
                                 {"false", "a deep initial overlap causes a warning, an overlap of "
                                           "more than two faces an error"}}),
              "Whether the sides may overlap initially.");
  entries.add("Friction", friction, "The law of the tangential contact forces.");
  entries.add("Friction coefficient", friction_coefficient,
              allowed("a formula of x, y and, in 3D, z"),
              "The ratio of the largest tangential force to the normal force, 0 or above, at the "
              "reference position of each slave node. For Coulomb, which needs this entry.");
  entries.add(
    "Friction bound", friction_bound, allowed("a formula of x, y and, in 3D, z"),
    "The largest tangential traction, 0 or above, at the reference position of each slave "
    "node. For Tresca, which needs this entry. Units: force/length^2.");
}

void PairParameters::check(const SectionCheck &section) const
{
  section.require(method != Method::mortar || largest_angle <= 60. ||
                    largest_angle == PairParameters().largest_angle,
                  "Largest angle", to_text(largest_angle), "must be at most 60 for mortar");
  geometry::require_formula(section, "Gap", gap, gap);
  for (const auto &[entry, limit] : TextPairs{{"Friction coefficient", friction_coefficient},
                                              {"Friction bound", friction_bound}})
    if (!limit.empty())
      geometry::require_formula(section, entry, limit, limit);
}

void ContactParameters::declare(Entries &entries)
{
  const auto names = [this]() {
    TextPairs result;
    for (const auto &pair : pairs)
      result.emplace_back(pair.slave, pair.master);
    return result;
  };
  const auto read = [this, names](const std::string &text) {
    TextPairs wanted;
    from_text(text, wanted);
    // Keep the entries of the pairs if the names do not change.
    if (wanted == names())
      return;
    pairs.clear();
    for (const auto &[slave, master] : wanted)
      pairs.push_back({slave, master, {}});
  };
  entries.add(
    "Pairs", {[names]() { return to_text(names()); }, read},
    allowed("a list 'body.boundary: body.boundary, ...' or 'body.boundary: obstacle, ...'"),
    "The pairs of faces, or of a face and an obstacle: 'punch.bottom: foundation.top'. A "
    "side may have several boundaries: 'punch.nose + punch.fillet: groove.floor + "
    "groove.wall'. Pairs that continue each other smoothly on both sides are one contact with "
    "the gaps and the friction of each.");
  entries.add(
    "Update pairing", update_pairing,
    "The maximum number of new contact searches after convergence of an optimization, each "
    "followed by a further optimization. Fewer are done if no slave node has moved along "
    "the master. During an optimization each slave node stays paired with one face.");
  defaults.declare(entries);
}
} // namespace snug::contact
