#include <snug/geometry/formula.h>
#include <snug/scene/check.h>
#include <snug/scene/section_check.h>
#include <snug/scene/values.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace snug::scene {
namespace {
/// A boundary, "body.boundary", and a component held there.
using Held = std::set<std::pair<std::string, unsigned int>>;

/// Throws unless a key of an entry's value names a boundary.
using RequireKey =
  std::function<void(const std::string &path, const std::string &value, const std::string &key)>;

/// Checks the loads of one section.
class LoadCheck : public SectionCheck
{
public:
  LoadCheck(const Scene          &scene,
            const Origins        &origins,
            const std::string    &section,
            const LoadParameters &loads)
    : SectionCheck(section, origins), dimension(scene.dimension), loads(loads)
  {}

  void check_keys(const RequireKey &require_key) const
  {
    check_keys("Displacement", loads.displacements, require_key);
    check_keys("Pressure", loads.pressure, require_key);
    check_keys("Traction", loads.traction, require_key);
    check_keys("Force", loads.force, require_key);
    check_keys("Moment", loads.moment, require_key);
  }

  void check_values() const
  {
    for (const auto &item : loads.pressure)
      require_formula("Pressure", to_text(loads.pressure), item.second);
    for (const auto &item : loads.traction)
      {
        const std::string value = to_text(loads.traction);
        const auto        parts = components(item.second);
        require_count("Traction", value, item.first, parts.size());
        for (const auto &part : parts)
          require_formula("Traction", value, part);
      }
    for (const auto &item : loads.force)
      {
        const std::string value = to_text(loads.force);
        require_count("Force", value, item.first, item.second.size());
        require(all_finite(item.second), "Force", value, "must be finite");
      }
    for (const auto &item : loads.moment)
      {
        const std::string value = to_text(loads.moment);
        require(item.second.size() == (dimension == 2 ? 1 : 3), "Moment", value,
                "the moment of '" + item.first + "' must have " +
                  (dimension == 2 ? "1 number" : "3 components separated by blanks"));
        require(all_finite(item.second), "Moment", value, "must be finite");
      }
  }

  /// @p held: what supports hold; what is prescribed is added. @p prefix
  /// makes "body.boundary" of a key.
  void check_displacements(const std::string &prefix, Held &held) const
  {
    const std::string value = to_text(loads.displacements);
    for (const auto &item : loads.displacements)
      {
        const auto [name, formula] = split_displacement(item.second);
        const auto number          = component_number(name, dimension);
        require(number.has_value(), "Displacement", value,
                "'" + quotable(name) + "' is no component; " + component_names(dimension));
        require(!formula.empty(), "Displacement", value,
                "'" + quotable(item.second) + "' must read 'component = formula'");
        require(held.emplace(prefix + item.first, *number).second, "Displacement", value,
                "'" + name + "' of '" + item.first + "' is held twice, or by 'Supports' as well");
        require_formula("Displacement", value, formula);
      }
  }

private:
  void require_count(const std::string &entry,
                     const std::string &value,
                     const std::string &key,
                     const std::size_t  n) const
  {
    require(n == dimension, entry, value,
            "the vector of '" + key + "' must have " + to_text(dimension) +
              " components separated by blanks");
  }

  void require_formula(const std::string &entry,
                       const std::string &value,
                       const std::string &formula) const
  {
    scene::require_formula(dimension, origins, path(entry), value, formula);
  }

  template <typename Map>
  void check_keys(const std::string &entry, const Map &map, const RequireKey &require_key) const
  {
    for (const auto &item : map)
      require_key(path(entry), to_text(map), item.first);
  }

  unsigned int          dimension;
  const LoadParameters &loads;
};

void check_gravity(const Scene               &scene,
                   const std::vector<double> &gravity,
                   const std::string         &path,
                   const Origins             &origins)
{
  if (!gravity.empty() && (gravity.size() != scene.dimension || !all_finite(gravity)))
    throw origins.error(path, to_text(gravity),
                        "must have " + to_text(scene.dimension) + " numbers, one per dimension");
}

/// What the supports of all bodies hold; checks their loads.
Held check_bodies_loads(const Scene &scene, const Origins &origins)
{
  Held held;
  for (const auto &body : scene.bodies)
    {
      const std::string prefix  = body.name + ".";
      const std::string section = "Body " + body.name;
      for (const auto &item : body.supports)
        for (const unsigned int c : component_list(item.second, scene.dimension))
          held.emplace(prefix + item.first, c);
      const LoadCheck check(scene, origins, section, body.loads);
      const auto      known = boundary_names(body, scene.dimension);
      check.check_keys(
        [&](const std::string &path, const std::string &value, const std::string &key) {
          if (std::find(known.begin(), known.end(), key) == known.end())
            throw origins.error(path, value,
                                "'" + quotable(key) + "' is no boundary of '" + body.name +
                                  "', they are " + listed(known) + did_you_mean(key, known));
        });
      check.check_values();
      check.check_displacements(prefix, held);
      if (!body.body_force.empty() && body.body_force.size() != scene.dimension)
        throw origins.error(section + "/Body force", to_text(body.body_force),
                            "must have " + to_text(scene.dimension) +
                              " formulas, one per dimension");
      for (const auto &formula : body.body_force)
        require_formula(scene.dimension, origins, section + "/Body force", to_text(body.body_force),
                        formula);
    }
  return held;
}
} // namespace

void check_loads(const Scene &scene, const Origins &origins)
{
  check_gravity(scene, scene.gravity, "Gravity", origins);
  const Held held = check_bodies_loads(scene, origins);
  for (const auto &load_case : scene.load_cases)
    {
      const std::string section = "Load case " + load_case.name;
      if (!(load_case.weight >= 0. && std::isfinite(load_case.weight)))
        throw origins.error(section + "/Weight", to_text(load_case.weight), "must not be negative");
      check_gravity(scene, load_case.gravity, section + "/Gravity", origins);
      const LoadCheck check(scene, origins, section, load_case.loads);
      check.check_keys(
        [&](const std::string &path, const std::string &value, const std::string &key) {
          require_face(scene, origins, path, value, key);
        });
      check.check_values();
      Held held_here = held;
      check.check_displacements("", held_here);
    }
  const bool no_weight = std::all_of(scene.load_cases.begin(), scene.load_cases.end(),
                                     [](const auto &of) { return of.weight == 0.; });
  if (!scene.load_cases.empty() && no_weight)
    throw origins.error("Load case " + scene.load_cases.front().name + "/Weight", "0",
                        "must be above 0 for at least one load case");
}

void require_formula(const unsigned int dimension,
                     const Origins     &origins,
                     const std::string &path,
                     const std::string &value,
                     const std::string &formula)
{
  try
    {
      if (dimension == 2)
        geometry::Formula<2>(path, formula);
      else
        geometry::Formula<3>(path, formula);
    }
  catch (const InputError &error)
    {
      const std::string message = error.what();
      throw origins.error(path, value,
                          (formula == value ? "" : "'" + quotable(formula) + "' ") +
                            message.substr(message.find("must be")));
    }
}

std::string component_names(const unsigned int dimension)
{
  return std::string("components are ") + (dimension == 2 ? "x, y" : "x, y, z") + " and normal";
}
} // namespace snug::scene
