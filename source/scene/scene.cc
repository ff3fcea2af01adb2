#include <snug/geometry/imported_mesh.h>
#include <snug/response/response.h>
#include <snug/scene/scene.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace snug::scene {
namespace {
template <int dim>
std::vector<std::string> boundary_names_in(geometry::BodyMeshParameters parameters)
{
  // Many checks need the names, and geometries of many cells take long.
  if (parameters.imported)
    parameters.imported = parameters.imported->without_cells();
  return geometry::make_geometry<dim>(parameters)->boundary_names();
}
} // namespace

mesh::Idealization idealization(const Scene &scene)
{
  return {scene.model.value(), scene.thickness};
}

std::pair<std::string, std::string> split_face(const std::string &face)
{
  const auto dot = face.find('.');
  if (dot == std::string::npos)
    return {face, ""};
  return {face.substr(0, dot), face.substr(dot + 1)};
}

unsigned int component_number(const std::string &name, const unsigned int dimension)
{
  using Names        = std::vector<std::string>;
  const Names names  = dimension == 2
                         ? Names{"x", "y", "normal", "radial", "tangential"}
                         : Names{"x", "y", "z", "normal", "radial", "tangential", "axial"};
  const auto  number = std::find(names.begin(), names.end(), name) - names.begin();
  if (number == static_cast<long>(names.size()))
    throw std::invalid_argument("'" + name + "' is not a component (" + to_text(names) + ")");
  return number;
}

std::vector<unsigned int> component_list(const std::string &words, const unsigned int dimension)
{
  std::vector<unsigned int> components;
  const auto                add = [&](const std::string &name) {
    const unsigned int number = component_number(name, dimension);
    if (std::find(components.begin(), components.end(), number) != components.end())
      throw std::invalid_argument("'" + name + "' occurs twice");
    components.push_back(number);
  };
  std::istringstream text(words);
  for (std::string word; text >> word;)
    if (word.size() > 3)
      add(word);
    else
      for (const char name : word)
        add(std::string(1, name));
  return components;
}

std::pair<std::string, std::string> split_displacement(const std::string &text)
{
  const auto equals = text.find('=');
  if (equals == std::string::npos)
    return {trim(text), ""};
  return {trim(text.substr(0, equals)), trim(text.substr(equals + 1))};
}

ConstraintName constraint_name(const Scene &scene, const std::string &name)
{
  for (unsigned int c = 0; c < scene.load_cases.size(); ++c)
    {
      const std::string prefix = scene.load_cases[c].name + ".";
      if (name.rfind(prefix, 0) == 0)
        return {name.substr(prefix.size()), c, {}};
    }
  const std::string between = " of ";
  if (const auto place = name.find(between); place != std::string::npos)
    try
      {
        const auto combination = optimization::Combination::read(trim(name.substr(0, place)));
        return {trim(name.substr(place + between.size())), {}, combination};
      }
    catch (const std::invalid_argument &)
      {
        // The name is not a combination.
      }
  return {name, {}, {}};
}

std::string unit_after_number(const Scene &scene, const std::string &response)
{
  const auto parameters = response_called(scene, response);
  return Units(scene.units).after_number(response::unit_of<3>(parameters->quantity));
}

std::optional<response::ResponseParameters> response_called(const Scene       &scene,
                                                            const std::string &name)
{
  for (const auto &response : scene.responses)
    if (response.name == name)
      return response;
  // The tables of 2D and 3D have the same names.
  for (const auto &row : response::response_table<3>())
    if (row.name == name)
      {
        response::ResponseParameters parameters;
        parameters.quantity = name;
        return parameters;
      }
  return {};
}

unsigned int body_index(const Scene &scene, const std::string &name)
{
  unsigned int i = 0;
  while (i < scene.bodies.size() && scene.bodies[i].name != name)
    ++i;
  return i;
}

std::string text_of_materials(const std::map<std::string, std::string> &materials)
{
  const auto whole = materials.find("");
  return whole != materials.end() ? whole->second : to_text(materials);
}

std::vector<elasticity::Material>
materials_of(const Scene &scene, const Body &body, const std::vector<std::string> &regions)
{
  std::vector<elasticity::Material> result;
  for (const auto &region : regions)
    {
      result.push_back(body.material);
      for (const auto &[name, material] : body.materials)
        for (const auto &known : scene.materials)
          if ((name.empty() || name == region) && known.name == material)
            result.back() = known.material;
    }
  return result;
}

bool has_friction(const Scene &scene)
{
  return std::any_of(scene.contact.pairs.begin(), scene.contact.pairs.end(),
                     [](const auto &pair) { return pair.parameters.has_friction(); });
}

bool has_potential(const Scene &scene)
{
  const bool steps = std::any_of(scene.load_cases.begin(), scene.load_cases.end(),
                                 [](const auto &load_case) { return load_case.load_step; });
  return !has_friction(scene) && (scene.bolts.empty() || !steps);
}

bool is_nearly_incompressible(const Scene &scene, const Body &body)
{
  if (body.formulation != elasticity::Formulation::B_bar)
    return false;
  std::vector<std::string> regions = {""};
  for (const auto &[region, material] : body.materials)
    regions.push_back(region);
  const auto materials = materials_of(scene, body, regions);
  return std::any_of(materials.begin(), materials.end(), [](const elasticity::Material &material) {
    return material.poissons_ratio >= 0.499;
  });
}

std::vector<std::string> boundary_names(const Body &body, const unsigned int dimension)
{
  return dimension == 2 ? boundary_names_in<2>(body.mesh) : boundary_names_in<3>(body.mesh);
}
} // namespace snug::scene
