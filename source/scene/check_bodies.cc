#include <snug/scene/check.h>
#include <snug/scene/section_check.h>
#include <snug/scene/values.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace snug::scene {
namespace {
/// Checks the entries of one body.
class BodyCheck : public SectionCheck
{
public:
  BodyCheck(const Scene &scene, const Body &body, const Origins &origins)
    : SectionCheck(body.section(), origins), scene(scene), body(body)
  {}

  void check_formulation() const
  {
    require(scene.model != "plane stress" || body.formulation == "standard", "Formulation",
            body.formulation,
            "must be standard for Model = plane stress, which does not "
            "lock");
  }

  void check_boundaries() const
  {
    const auto known = boundary_names(body, scene.dimension);
    require_known(known, "Supports", body.supports);
  }

  void check_supports() const
  {
    for (const auto &item : body.supports)
      try
        {
          require(!component_list(item.second, scene.dimension).empty(), "Supports",
                  to_text(body.supports), "'" + item.first + "' must hold some components");
        }
      catch (const std::invalid_argument &error)
        {
          throw origins.error(path("Supports"), to_text(body.supports),
                              error.what() + std::string("; ") + component_names(scene.dimension));
        }
  }

private:
  template <typename Map>
  void require_known(const std::vector<std::string> &known,
                     const std::string              &entry,
                     const Map                      &map) const
  {
    for (const auto &item : map)
      require(std::find(known.begin(), known.end(), item.first) != known.end(), entry, to_text(map),
              "'" + quotable(item.first) + "' is no boundary of '" + body.name + "', they are " +
                listed(known) + did_you_mean(item.first, known));
  }

  const Scene &scene;
  const Body  &body;
};

bool is_good_name(const std::string &name)
{
  return !name.empty() && std::all_of(name.begin(), name.end(), [](const unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == ' ';
  });
}

void check_list_of_names(const std::string              &entry,
                         const std::vector<std::string> &names,
                         const Origins                  &origins)
{
  for (const auto &name : names)
    {
      if (!is_good_name(name))
        throw origins.error(entry, listed(names),
                            "names must be made of letters, digits, "
                            "'_', '-' and blanks");
      if (std::count(names.begin(), names.end(), name) > 1)
        throw origins.error(entry, listed(names), "'" + name + "' must not occur twice");
    }
}
} // namespace

void check_names(const Scene &scene, const Origins &origins)
{
  std::vector<std::string> bodies, load_cases, materials, obstacles, responses, shapes;
  for (const auto &body : scene.bodies)
    bodies.push_back(body.name);
  for (const auto &load_case : scene.load_cases)
    load_cases.push_back(load_case.name);
  for (const auto &material : scene.materials)
    materials.push_back(material.name);
  for (const auto &obstacle : scene.obstacles)
    obstacles.push_back(obstacle.name);
  for (const auto &shape : scene.shapes)
    if (!shape.name.empty() || scene.shapes.size() > 1)
      shapes.push_back(shape.name);
  for (const auto &response : scene.responses)
    responses.push_back(response.name);
  if (bodies.empty())
    throw origins.error("Bodies", "", "must name at least one body");
  check_list_of_names("Bodies", bodies, origins);
  check_list_of_names("Load cases", load_cases, origins);
  check_list_of_names("Materials", materials, origins);
  check_list_of_names("Obstacles", obstacles, origins);
  check_list_of_names("Responses", responses, origins);
  check_list_of_names("Shapes", shapes, origins);
}

void check_bodies(const Scene &scene, const Origins &origins)
{
  check_materials(scene, origins);
  for (const auto &body : scene.bodies)
    {
      check_mesh(scene, body, origins);
      const BodyCheck check(scene, body, origins);
      check_regions(scene, body, origins);
      check.check_formulation();
      check.check_boundaries();
      check.check_supports();
    }
}
} // namespace snug::scene
