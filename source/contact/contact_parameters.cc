#include <snug/base/section_check.h>
#include <snug/contact/contact.h>
#include <snug/geometry/formula.h>

#include <algorithm>

namespace snug::contact {
void ObstacleParameters::declare(Entries &entries)
{
  const Form vector = per_dimension({}, "finite numbers separated by commas");
  entries.add("Shape", shape, choice(names(obstacle_table<3>())), "What it fills.");
  entries.add("Point", point, vector,
              "On the plane, centre of the sphere, on the axis of the cylinder, or origin of the "
              "formula [length]; empty: 0.");
  entries.add("Normal", normal, vector,
              "Of a plane, out of the obstacle, of any length; empty: along the last axis.");
  entries.add("Axis", axis, vector,
              "Of a cylinder, or direction of the formula's last coordinate, of any length; empty: "
              "the last axis.");
  entries.add("Radius", radius, above(0.), "Of a sphere or cylinder [length].");
  entries.add(
    "Formula", formula, allowed("a formula of x, y and, in 3D, z"),
    "Negative inside of the obstacle, positive outside, smooth on the scale of elements.");
  entries.add("Displacement", displacement, vector,
              "How far the obstacle moves from where it is placed [length]; contacts keep the "
              "normals of the place. Empty: 0.");
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

void PairParameters::declare(Entries &entries)
{
  entries.add("Method", method,
              choice_or_auto<Method>("nodal where every slave node within the search distance lies "
                                     "opposite to a master node, within 1 % of a face, else "
                                     "mortar"),
              "How two faces meet.");
  entries.add(
    "Slave", slave,
    "Whose nodes carry the contact pressure and must not penetrate the other face. finer: that of "
    "the smaller faces on average, but of mortar contact that of the larger if the ratio of "
    "their sizes times that of Young's moduli, stiffer over softer, is above 1.5; first: the one "
    "that is named first, as also for meshes within a tenth.");
  entries.add("Search distance", search_distance, at_least(0., "must be 0 or above"),
              "Slave nodes farther from the master at the first design carry no contact row "
              "[length]; 0: any distance.");
  entries.add(
    "Largest angle", largest_angle, above(0., 180.),
    "Between the slave's normal and the direction into the master at the first design [degrees]; "
    "slave nodes beyond carry no contact row. Mortar: between faces, at most 60.");
  entries.add("Gap", gap, allowed("a formula of x, y and, in 3D, z"),
              "Added to the gap at each slave node [length].");
  entries.add("Interference", interference,
              "true: the sides may overlap at first, as in a shrink fit. false: a deep overlap "
              "gives a warning, one of more than two faces an error.");
}

void PairParameters::check(const SectionCheck &section) const
{
  section.require(method != Method::mortar || largest_angle <= 60. ||
                    largest_angle == PairParameters().largest_angle,
                  "Largest angle", to_text(largest_angle), "must be at most 60 for mortar");
  geometry::require_formula(section, "Gap", gap, gap);
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
  entries.add("Pairs", {[names]() { return to_text(names()); }, read},
              allowed(
                "a list 'body.boundary: body.boundary, ...' or 'body.boundary: obstacle, ...'"),
              "Pairs of faces, or of a face and an obstacle, separated by commas: 'punch.bottom: "
              "foundation.top'. A side may name several boundaries of a body: 'punch.nose + "
              "punch.fillet: groove.floor + groove.wall'. Pairs whose boundaries continue each "
              "other smoothly on both sides are one contact, and each reports its share.");
  entries.add(
    "Update pairing", update_pairing,
    "How often an optimization that has met its tolerance goes on with contact paired "
    "anew at the design it found; it ends before if slave nodes are where they were "
    "paired. Within a search each node stays paired with one face, in which it may move.");
  defaults.declare(entries);
}
} // namespace snug::contact
