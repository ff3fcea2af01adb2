#include <snug/contact/contact.h>
#include <snug/scene/check.h>
#include <snug/scene/entries.h>

namespace snug::scene {
namespace {
void declare_obstacle(Entries &entries, contact::ObstacleParameters &obstacle)
{
  entries.begin_section("Obstacle " + obstacle.name, "One rigid obstacle: nothing gets into it.");
  add_choice(entries, "Shape", obstacle.shape, contact::obstacle_table<3>(), "What it fills.");
  entries.add("Point", obstacle.point,
              "On the plane, centre of the sphere, on the axis of the "
              "cylinder, or origin of the formula [length]; empty: 0.");
  entries.add("Normal", obstacle.normal,
              "Of a plane, out of the obstacle, of any length; empty: "
              "along the last axis.");
  entries.add("Axis", obstacle.axis,
              "Of a cylinder, or direction of the formula's last "
              "coordinate, of any length; empty: the last axis.");
  entries.add("Radius", obstacle.radius, "Of a sphere or cylinder [length].");
  entries.add("Formula", obstacle.formula, anything("a formula of x, y and, in 3D, z"),
              "Negative inside of the obstacle, positive outside, smooth "
              "on the scale of elements.");
  entries.add("Displacement", obstacle.displacement,
              "How far the obstacle moves from where it is placed "
              "[length]; contacts keep the normals of the place. Empty: "
              "0.");
}

void declare_pair(Entries &entries, contact::PairParameters &pair)
{
  add_choice(entries, "Method", pair.method, contact::contact_method_table<3>(),
             "How two faces meet.");
  entries.add("Slave", pair.slave, choice("finer|first"),
              "Whose nodes must not penetrate the other face. finer: "
              "that of the smaller faces on average; first: the one that "
              "is named first, as also for meshes within a tenth.");
  entries.add("Search distance", pair.search_distance,
              "Slave nodes farther from the master at the first design "
              "carry no contact row [length]; 0: any distance.");
  entries.add("Largest angle", pair.largest_angle,
              "Between the slave's normal and the direction into the "
              "master at the first design [degrees]; slave nodes beyond "
              "carry no contact row. Mortar: between faces, at most 60.");
  entries.add("Gap", pair.gap, anything("a formula of x, y and, in 3D, z"),
              "Added to the gap at each slave node [length].");
  entries.add("Interference", pair.interference,
              "true: the sides may overlap at first, as in a shrink fit. "
              "false: a deep overlap gives a warning, one of more than "
              "two faces an error.");
}
} // namespace

void declare_contact(Entries &entries, Scene &scene)
{
  for (auto &obstacle : scene.obstacles)
    declare_obstacle(entries, obstacle);
  entries.begin_section("Contact", "Which faces may touch, and how.");
  auto      &all   = scene.contact.pairs;
  const auto names = [&all]() {
    TextPairs result;
    for (const auto &pair : all)
      result.emplace_back(pair.slave, pair.master);
    return result;
  };
  entries.add("Pairs",
              {[names]() { return to_text(names()); },
               [names, &all](const std::string &text) {
                 TextPairs wanted;
                 from_text(text, wanted);
                 // declaring assigns, too: pairs that are there keep their entries
                 if (wanted == names())
                   return;
                 all.clear();
                 for (const auto &name : wanted)
                   all.push_back({name.first, name.second, {}});
               }},
              pairs("a list 'body.boundary: body.boundary, ...' or 'body.boundary: "
                    "obstacle, ...'"),
              "Pairs of faces, or of a face and an obstacle, separated by commas. "
              "'punch.bottom: foundation.top'.");
  entries.add("Update pairing", scene.contact.update_pairing,
              "How often an optimization that has met its tolerance goes "
              "on with contact paired anew at the design it found; it ends "
              "before if slave nodes are where they were paired. Within a "
              "run pairing is frozen.");
  declare_pair(entries, scene.contact.defaults);
  for (auto &pair : all)
    {
      entries.begin_section("Pair " + pair.slave + ": " + pair.master,
                            "Entries of Contact for one of its pairs.");
      declare_pair(entries, pair.parameters);
    }
}
} // namespace snug::scene
