#include <snug/base/section_check.h>
#include <snug/geometry/formula.h>
#include <snug/scene/check.h>

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
  entries.add("Gravity", gravity, per_dimension(),
              "Acceleration along x, y, z [length/time^2]; times 'Density' it is a body force: '0 "
              "0 -9.81'. Empty: none.");
}

void LoadParameters::declare(Entries &entries, const std::string &key, const std::string &where)
{
  const std::string list = "a list '" + key + ": ";
  entries.add("Displacement", displacements, allowed(list + "component = formula, ...'"),
              "Prescribed displacement components [length]: x, y, z or normal, by formulas of x, "
              "y, z in the reference geometry: '" +
                where + ": z = -0.012, " + where +
                ": x = 1e-3*y'. The other components stay free.");
  entries.add("Pressure", pressure, allowed(list + "formula, ...' of different boundaries"),
              "Pressure [force/length^2], a number or a formula of x, y, z in the reference "
              "geometry; positive pushes: '" +
                where + ": 100*(1-x^2)'.");
  entries.add("Traction", traction,
              allowed(list + "formula formula formula, ...' of different boundaries, one formula "
                             "per dimension, separated by blanks"),
              "Force per area [force/length^2], numbers or formulas of x, y, z in the reference "
              "geometry, separated by blanks: '" +
                where + ": 0 0 -5*x'.");
  entries.add(
    "Force", force,
    allowed(list + "x y z, ...' of different boundaries, components separated by blanks"),
    "Total force [force], spread evenly over the area of the boundary as the design makes it: '" +
      where + ": 0 0 -1000'.");
  entries.add("Moment", moment,
              allowed(list + "x y z, ...' of different boundaries, components separated by blanks"),
              "Moment about the centroid of the boundary [force length], spread linearly over it; "
              "one number in 2D: '" +
                where + ": 0 50 0'.");
}

void LoadCaseParameters::declare(Entries &entries)
{
  entries.add("Weight", weight, at_least(0., "must not be negative"),
              "Factor of its objective in the sum over load cases, or in their worst.");
  declare_gravity(entries, gravity);
  loads.declare(entries, "body.boundary", "punch.top");
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
}

void LoadParameters::check_displacements(const SectionCheck &section,
                                         const std::string  &prefix,
                                         Held               &held) const
{
  const std::string value = to_text(displacements);
  for (const auto &item : displacements)
    {
      const auto [name, formula] = split_displacement(item.second);
      const auto number          = component_number(name, section.dimension);
      section.require(number.has_value(), "Displacement", value,
                      "'" + quotable(name) + "' is no component; " +
                        component_names(section.dimension));
      section.require(!formula.empty(), "Displacement", value,
                      "'" + quotable(item.second) + "' must read 'component = formula'");
      section.require(held.emplace(prefix + item.first, *number).second, "Displacement", value,
                      "'" + name + "' of '" + item.first +
                        "' is held twice, or by 'Supports' as well");
      geometry::require_formula(section, "Displacement", value, formula);
    }
}

} // namespace snug::scene
