#include <snug/base/section_check.h>
#include <snug/geometry/formula.h>
#include <snug/geometry/regions.h>
#include <snug/scene/check.h>
#include <snug/scene/placed_force.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace snug::scene {
namespace {
TextMap materials_from(const std::string &text)
{
  TextMap materials;
  if (text.find(':') != std::string::npos)
    from_text(text, materials);
  else if (!text.empty())
    materials[""] = text;
  return materials;
}

struct Region
{
  std::string   name;
  unsigned long n_cells;
};

template <int dim>
std::vector<Region> regions_in(const Body &body)
{
  const auto          geometry = geometry::make_geometry<dim>(body.mesh);
  const auto          names    = geometry->region_names();
  const auto          n_cells  = geometry::cells_of_regions(*geometry);
  std::vector<Region> regions;
  for (unsigned int r = 0; r < names.size(); ++r)
    regions.push_back({names[r], n_cells[r]});
  return regions;
}

/// Check that every region has a material, and every material a region.
void check_regions(const SectionCheck &section, const Body &body)
{
  const auto regions = section.dimension == 2 ? regions_in<2>(body) : regions_in<3>(body);
  const auto names   = names_of(regions);
  const auto require = [&](const bool good, const std::string &allowed, const std::string &meant) {
    section.require(good, "Materials", text_of_materials(body.materials), allowed, meant);
  };
  for (const auto &[name, material] : body.materials)
    {
      const auto found = std::find(names.begin(), names.end(), name);
      require(name.empty() || found != names.end(),
              "'" + quotable(name) + "' is not a region of '" + body.name + "'; the regions are " +
                to_text(names),
              suggestion(name, names));
      require(name.empty() || regions[found - names.begin()].n_cells > 0,
              "the region '" + name + "' has no cells", "");
    }
  for (const auto &region : regions)
    require(region.n_cells == 0 || body.materials.count("") > 0 ||
              body.materials.count(region.name) > 0,
            "the region '" + region.name + "' has no material", "");
}

void check_materials(const Scene &scene, const SectionCheck &section, const Body &body)
{
  if (body.materials.empty())
    return body.material.check(section);
  section.require_read(body.material, {},
                       "must be left out, because 'Materials' defines the material");
  const auto known = names_of(scene.materials);
  for (const auto &[region, material] : body.materials)
    section.require(std::find(known.begin(), known.end(), material) != known.end(), "Materials",
                    text_of_materials(body.materials),
                    "'" + quotable(material) + "' is not one of the 'Materials' of the scene" +
                      (known.empty() ? "" : ", " + to_text(known)),
                    suggestion(material, known));
  check_regions(section, body);
}

void check_supports(const SectionCheck &section, const Body &body)
{
  const auto is_zero = [](const double number) { return number == 0.; };
  section.require(body.axis.empty() || (section.dimension == 3 &&
                                        !std::all_of(body.axis.begin(), body.axis.end(), is_zero)),
                  "Axis", to_text(body.axis),
                  section.dimension == 3 ? "must not be zero" : "must be empty for Dimension = 2");
  const std::string value = to_text(body.supports);
  for (const auto &[boundary, words] : body.supports)
    require_boundary(section, "Supports", value, body, boundary);
  for (const auto &[boundary, words] : body.supports)
    section.require(!section.read("Supports", value, "", component_list, words).empty(), "Supports",
                    value, "'" + boundary + "' must have at least one component");
}

void check_point_supports(const SectionCheck &section, const Body &body)
{
  const std::string held = to_text(body.point_supports);
  for (const auto &[boundary, text] : body.point_supports)
    {
      require_boundary(section, "Point supports", held, body, boundary);
      section.read("Point supports", held, "support of '" + boundary + "': ", point_hold, text);
    }
}

void check_springs(const SectionCheck &section, const Body &body)
{
  std::set<std::pair<std::string, unsigned int>> known;
  const std::string                              value = to_text(body.springs);
  for (const auto &[boundary, text] : body.springs)
    {
      require_boundary(section, "Springs", value, body, boundary);
      const auto [words, formula] = split_displacement(text);
      const auto components       = section.read("Springs", value, "", component_list, words);
      section.require(!components.empty() && !formula.empty(), "Springs", value,
                      "'" + quotable(text) + "' must read 'components = formula'");
      geometry::require_formula(section, "Springs", value, formula);
      for (const unsigned int c : components)
        section.require(known.insert({boundary, c}).second, "Springs", value,
                        "'" + boundary + "' must not have two springs in one direction");
    }
  const std::string points = to_text(body.point_springs);
  for (const auto &[boundary, text] : body.point_springs)
    {
      require_boundary(section, "Point springs", points, body, boundary);
      const auto given =
        section.read("Point springs", points, "spring of '" + boundary + "': ", placed_force, text);
      section.require(!given.at.empty() && given.from.empty() && given.to.empty() &&
                        given.along.empty(),
                      "Point springs", points,
                      "the spring of '" + boundary + "' must read 'x y z at x y z'");
      double sum = 0.;
      for (const double stiffness : given.force)
        {
          section.require(stiffness >= 0., "Point springs", points,
                          "stiffnesses must not be negative");
          sum += stiffness;
        }
      section.require(sum > 0., "Point springs", points,
                      "the spring of '" + boundary + "' must have a stiffness");
    }
}
} // namespace

void Body::declare(Entries &entries)
{
  mesh.declare(entries);
  material.declare(entries);
  entries.add(
    "Materials",
    {[this]() { return text_of_materials(materials); },
     [this](const std::string &text) { materials = materials_from(text); }},
    allowed("the name of a material, or a list 'region: material, ...' of different regions"),
    "The materials of the body, instead of its own modulus, ratio and density: 'steel' for the "
    "whole body, or 'core: steel, coat: rubber' for its regions. Regions are the groups of cells "
    "of "
    "a mesh file and of 'Region formulas'. Cells of no region are in the region body.");
  entries.add("Formulation", formulation, "The treatment of volumetric strain in the elements.");
  entries.add("Axis", axis, per_dimension(),
              "The direction, of any length, of the axis of the components 'radial', 'tangential' "
              "and 'axial'. An empty list means z. In 2D it must be empty.");
  entries.add("Axis point", axis_point, per_dimension(),
              "A point of the axis. An empty list means the origin. Units: length.");
  entries.add(
    "Supports", supports, allowed("a list 'boundary: components, ...' of different boundaries"),
    "The displacement components that boundaries hold at zero: 'bottom: xyz, left: x'. "
    "'normal' is the component along the outward normal of a flat, oblique or curved face, "
    "for symmetry planes and rollers; 'radial', 'tangential' and 'axial' are those about 'Axis': "
    "'side: normal, bore: tangential axial'.");
  entries.add(
    "Point supports", point_supports, allowed("a list 'boundary: components at x y z, ...'"),
    "The displacement components of nodes at places of the reference geometry, in all load cases: "
    "'bottom: xy at 0 0 0, bottom: z = -0.01 at 1 0 0'. The stress there is infinite in the limit "
    "of "
    "fine meshes. Units: length.");
  entries.add(
    "Springs", springs, allowed("a list 'boundary: components = formula, ...'"),
    "The springs between boundaries and the ground, with the components as in 'Supports' and "
    "the stiffness per area as a formula of x, y, z in the reference geometry: 'bottom: "
    "normal = 1000, side: xy = 50*z'. Springs pull as well as push. Units: force/length^3.");
  entries.add(
    "Point springs", point_springs, allowed("a list 'boundary: x y z at x y z, ...'"),
    "The springs between points of boundaries and the ground, with the stiffness along x, "
    "y, z and the place in the reference geometry: 'bottom: 0 0 1000 at 0.5 0.5 0'. Units: "
    "force/length.");
  loads.declare(entries, "boundary", "top");
  entries.add("Body force",
              {[this]() { return to_text(body_force); },
               [this](const std::string &text) { body_force = vector_components(text); }},
              allowed("formulas separated by commas or blanks, one per dimension"),
              "The force per volume along x, y, z, as formulas of x, y, z in the reference "
              "geometry. Units: force/length^3. An empty list means no body force.");
  entries.add(
    "Temperature", temperature, allowed("a formula of x, y, z"),
    "The temperature above that of the unstressed body, a number or a formula of x, y, z in "
    "the reference geometry, which causes the thermal strain 'Expansion' times "
    "'Temperature': '80 + 20*x'. The temperature moves with the material. Units: "
    "temperature. An empty value means no thermal strain.");
}

void check_body(const Scene        &scene,
                const SectionCheck &section,
                const Body         &body,
                const unsigned int  n_ranks)
{
  body.mesh.check(section, idealization(scene).is_axisymmetric(), n_ranks);
  check_materials(scene, section, body);
  section.require(scene.model != mesh::Idealization::Kind::plane_stress ||
                    body.formulation == elasticity::Formulation::standard,
                  "Formulation", to_text(body.formulation),
                  "must be standard for Model = plane stress, which does not lock");
  check_supports(section, body);
  check_point_supports(section, body);
  check_springs(section, body);
}

void check_loads(const SectionCheck &section, const Body &body, LoadParameters::Held &held)
{
  const std::string prefix = body.name + ".";
  for (const auto &[boundary, words] : body.supports)
    for (const unsigned int c : component_list(words, section.dimension))
      held.emplace(prefix + boundary, c);
  body.loads.check(section, [&](const auto &entry, const auto &value, const auto &boundary) {
    require_boundary(section, entry, value, body, boundary);
  });
  body.loads.check_displacements(section, prefix, held);
  const std::string value = to_text(body.body_force);
  section.require(body.body_force.empty() || body.body_force.size() == section.dimension,
                  "Body force", value,
                  "must have " + to_text(section.dimension) + " formulas, one per dimension");
  for (const auto &formula : body.body_force)
    geometry::require_formula(section, "Body force", value, formula);
  if (!body.temperature.empty())
    geometry::require_formula(section, "Temperature", body.temperature, body.temperature);
}
} // namespace snug::scene
