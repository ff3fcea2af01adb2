#include <snug/base/section_check.h>
#include <snug/geometry/formula.h>
#include <snug/geometry/rigid_motion.h>
#include <snug/scene/check.h>
#include <snug/scene/placed_force.h>

#include <algorithm>
#include <stdexcept>

namespace snug::scene {
namespace {
/// Check that the vector of @p key has one number per dimension.
void require_count(const SectionCheck &section,
                   const std::string  &entry,
                   const std::string  &value,
                   const std::string  &key,
                   const std::size_t   n)
{
  section.require(n == section.dimension, entry, value,
                  "the vector of '" + key + "' must have " + to_text(section.dimension) +
                    " components separated by blanks");
}
} // namespace

void declare_gravity(Entries &entries, std::vector<double> &gravity)
{
  entries.add(
    "Gravity", gravity, per_dimension(),
    "The acceleration along x, y, z, which is multiplied by 'Density': '0 0 -9.81'. Units: "
    "length/time^2. An empty list means no gravity.");
}

void LoadParameters::declare(Entries &entries, const std::string &key, const std::string &where)
{
  const std::string list = "a list '" + key + ": ";
  entries.add("Displacement", displacements, allowed(list + "component = formula, ...'"),
              "The prescribed displacement components, with names as in 'Supports', as formulas of "
              "x, y, z in the reference geometry: '" +
                where + ": z = -0.012, " + where +
                ": tangential = 1e-3*sqrt(x^2+y^2)'. Components without a formula remain free. "
                "Units: length.");
  entries.add("Pressure", pressure, allowed(list + "formula, ...' of different boundaries"),
              "The pressure, a number or a formula of x, y, z in the reference geometry: '" +
                where + ": 100*(1-x^2)'. A positive pressure pushes. Units: force/length^2.");
  entries.add("Traction", traction,
              allowed(list + "formula formula formula, ...' of different boundaries, one formula "
                             "per dimension, separated by blanks"),
              "The force per area along x, y, z, numbers or formulas of x, y, z in the reference "
              "geometry: '" +
                where + ": 0 0 -5*x'. Units: force/length^2.");
  entries.add(
    "Force", force,
    allowed(list + "x y z, ...' of different boundaries, components separated by blanks"),
    "The total force along x, y, z, distributed uniformly over the area of the boundary in the "
    "current design: '" +
      where + ": 0 0 -1000'. Units: force.");
  entries.add("Moment", moment,
              allowed(list + "x y z, ...' of different boundaries, components separated by blanks"),
              "The moment about the centroid of the boundary, distributed linearly over the "
              "boundary: '" +
                where + ": 0 50 0'. One number in 2D. Units: force length.");
  entries.add("Point force", point_forces, allowed(list + "x y z at x y z, ...'"),
              "The forces at points of a boundary in the reference geometry: '" + where +
                ": 0 0 -100 at 0.5 0.5 1'. A force stays at its material point. The stress at the "
                "point is infinite in the limit of fine meshes. In sections the force is that of "
                "the whole thickness or circumference. Units: force.");
  entries.add("Line force", line_forces,
              allowed(list + "x y z from x y z to x y z, ...' or '" + key +
                      ": x y z along boundary, ...'"),
              "The forces per length along straight lines on a boundary in the reference geometry, "
              "'" +
                where +
                ": 0 0 -5 from 0 0 1 to 1 0 1', or along the common edge of two boundaries "
                "of a body, '" +
                where +
                ": 0 0 -5 along left'. Lines stay on their material points. In 3D only. Units: "
                "force/length.");
}

void LoadCaseParameters::declare(Entries &entries)
{
  entries.add("Weight", weight, at_least(0.),
              "The weight of this load case in the combined objective.");
  entries.add("Cases", cases, between(1., 1000.),
              "The number n of load cases that this section stands for: NAME-0 to NAME-(n-1). "
              "Numbers in all entries of the section may then be formulas of the case number i: "
              "'punch.top: 0 0 -100*(i+1)'.");
  entries.add(
    "Position", access(positions, ';'),
    with_meanings(
      allowed("a list 'body or obstacle: motion, motion, ...; ...'"),
      {{"wheel: rotate z 12 about 100 0",
        "rotation by 12 degrees about the axis z through a point, by default the origin; "
        "in 2D the axis is z"},
       {"wheel: rotate z 12, shift 0 1", "rotation, then translation"},
       {"wheel: rotate z 2*i; pinion: rotate z -3*i",
        "motions of two bodies, with the case number i of 'Cases'; numbers contain no "
        "blanks"}}),
    "The motions that bring bodies and obstacles to their places in this load case. Supports, "
    "springs, "
    "loads, prescribed displacements and displacements turn with their body. Units: degrees, "
    "length.");
  entries.add(
    "Loads in space", loads_in_space,
    "Whether forces, moments, tractions, body forces and gravity keep their directions in "
    "space, instead of turning with the bodies that 'Position' moves. Pressures always "
    "turn with the bodies. Formulas are evaluated at the place that the scene gives to "
    "the body.");
  entries.add(
    "Load step", load_step,
    "Whether this load case is a load step: contacts with friction continue from their slips in "
    "the load case before it, of the same 'Position', and bolts without 'Preload' and 'Shortening' "
    "here keep their length. The loads are those at the end of the step. The first load case "
    "starts without slips.");
  entries.add("Preload", preloads, allowed("a list 'bolt: number, ...' of different bolts"),
              "The tensions to which bolts are tightened in this load case: 'm8: 5000'. Units: "
              "force.");
  entries.add("Shortening", shortenings, allowed("a list 'bolt: number, ...' of different bolts"),
              "The lengths by which bolts are shortened in this load case: 'm8: 0.02'. Units: "
              "length.");
  declare_gravity(entries, gravity);
  entries.add("Temperature", temperatures,
              allowed("a list 'body: formula, ...' of different bodies"),
              "The temperatures of bodies, as formulas of x, y, z in the reference geometry, in "
              "addition to their own entries 'Temperature': 'punch: 100*z'. Units: temperature.");
  loads.declare(entries, "body.boundary", "punch.top");
}

void LoadCaseParameters::check_positions(const SectionCheck             &section,
                                         const std::vector<std::string> &names) const
{
  std::set<std::string> moved;
  for (const auto &[name, motion] : positions)
    {
      const auto require = [&](const bool good, const std::string &allowed) {
        section.require(good, "Position", to_text(positions, ';'), allowed);
      };
      require(std::find(names.begin(), names.end(), name) != names.end(),
              "there is no body or obstacle '" + quotable(name) + "'");
      require(moved.insert(name).second, "'" + name + "' occurs twice");
      const auto read = [](const std::string &text, const unsigned int dimension) {
        if (dimension == 2)
          geometry::rigid_motion<2>(text);
        else
          geometry::rigid_motion<3>(text);
      };
      section.read("Position", to_text(positions, ';'), "motion of '" + name + "': ", read, motion);
    }
}

void LoadParameters::check(const SectionCheck &section, const RequireKey &require_key) const
{
  const auto check_keys = [&](const std::string &entry, const auto &map) {
    for (const auto &item : map)
      require_key(entry, to_text(map), item.first);
  };
  check_keys("Displacement", displacements);
  check_keys("Pressure", pressure);
  check_keys("Traction", traction);
  check_keys("Force", force);
  check_keys("Moment", moment);
  for (const auto &item : pressure)
    geometry::require_formula(section, "Pressure", to_text(pressure), item.second);
  for (const auto &item : traction)
    {
      const auto parts = components(item.second);
      require_count(section, "Traction", to_text(traction), item.first, parts.size());
      for (const auto &part : parts)
        geometry::require_formula(section, "Traction", to_text(traction), part);
    }
  for (const auto &item : force)
    require_count(section, "Force", to_text(force), item.first, item.second.size());
  for (const auto &item : moment)
    section.require(item.second.size() == (section.dimension == 2 ? 1 : 3), "Moment",
                    to_text(moment),
                    "the moment of '" + item.first + "' must have " +
                      (section.dimension == 2 ? "1 number" : "3 components separated by blanks"));
  check_placed(section, require_key);
}

void LoadParameters::check_placed(const SectionCheck &section, const RequireKey &require_key) const
{
  const auto read = [&](const std::string &entry, const auto &forces, const auto &item) {
    require_key(entry, to_text(forces), item.first);
    return section.read(entry, to_text(forces), "force of '" + item.first + "': ", placed_force,
                        item.second);
  };
  for (const auto &item : point_forces)
    {
      const auto force = read("Point force", point_forces, item);
      section.require(!force.at.empty() && force.from.empty() && force.to.empty() &&
                        force.along.empty(),
                      "Point force", to_text(point_forces),
                      "the force of '" + item.first + "' must read 'x y z at x y z'");
    }
  section.require(line_forces.empty() || section.dimension == 3, "Line force", to_text(line_forces),
                  "must be empty in 2D, where a line across the section is a 'Point force'");
  for (const auto &item : line_forces)
    {
      const auto force   = read("Line force", line_forces, item);
      const bool by_ends = !force.from.empty() && !force.to.empty();
      section.require(force.at.empty() && by_ends == force.along.empty() &&
                        force.from.empty() == force.to.empty(),
                      "Line force", to_text(line_forces),
                      "the force of '" + item.first +
                        "' must read 'x y z from x y z to x y z' or 'x y z along boundary'");
      section.require(!by_ends || force.from != force.to, "Line force", to_text(line_forces),
                      "the line of '" + item.first + "' must have two different ends");
      if (!by_ends)
        // The other boundary belongs to the same body.
        require_key("Line force", to_text(line_forces),
                    item.first.substr(0, item.first.find('.') + 1) + force.along);
    }
}

void LoadParameters::check_displacements(const SectionCheck &section,
                                         const std::string  &prefix,
                                         Held               &held) const
{
  const std::string value = to_text(displacements);
  for (const auto &item : displacements)
    {
      const auto [name, formula] = split_displacement(item.second);
      const auto number          = section.read("Displacement", value, "", component_number, name);
      section.require(!formula.empty(), "Displacement", value,
                      "'" + quotable(item.second) + "' must read 'component = formula'");
      section.require(held.emplace(prefix + item.first, number).second, "Displacement", value,
                      "'" + name + "' of '" + item.first +
                        "' is held twice, or by 'Supports' as well");
      geometry::require_formula(section, "Displacement", value, formula);
    }
}

} // namespace snug::scene
