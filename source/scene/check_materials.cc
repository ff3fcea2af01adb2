#include <snug/geometry/regions.h>
#include <snug/scene/check.h>
#include <snug/scene/section_check.h>
#include <snug/scene/values.h>

#include <algorithm>
#include <cmath>

namespace snug::scene {
namespace {
void check_material(const SectionCheck &section, const elasticity::Material &material)
{
  const double E = material.youngs_modulus;
  section.require(std::isfinite(E) && E > 0., "Young's modulus", to_text(E), "must be positive");
  const double nu = material.poissons_ratio;
  section.require(nu > -1. && nu < 0.5, "Poisson's ratio", to_text(nu),
                  "must be above -1 and below 0.5");
  section.require(std::isfinite(material.density) && material.density >= 0., "Density",
                  to_text(material.density), "must not be negative");
}

/// The body's own entries must be left alone if it names materials.
void check_unread(const SectionCheck &section, const elasticity::Material &material)
{
  const elasticity::Material initial;
  const std::string allowed = "must be left out, as 'Materials' says what the body is made of";
  section.require(material.youngs_modulus == initial.youngs_modulus, "Young's modulus",
                  to_text(material.youngs_modulus), allowed);
  section.require(material.poissons_ratio == initial.poissons_ratio, "Poisson's ratio",
                  to_text(material.poissons_ratio), allowed);
  section.require(material.density == initial.density, "Density", to_text(material.density),
                  allowed);
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

/// Every region has a material, and every material a region.
class RegionCheck : public SectionCheck
{
public:
  RegionCheck(const Scene &scene, const Body &body, const Origins &origins)
    : SectionCheck(body.section(), origins)
    , body(body)
    , regions(scene.dimension == 2 ? regions_in<2>(body) : regions_in<3>(body))
  {}

  void check() const
  {
    for (const auto &[name, material] : body.materials)
      if (!name.empty())
        require_cells(name);
    for (const auto &region : regions)
      require_materials(region.n_cells == 0 || body.materials.count("") > 0 ||
                          body.materials.count(region.name) > 0,
                        "the region '" + region.name + "' has no material");
  }

private:
  const Body               &body;
  const std::vector<Region> regions;

  void require_cells(const std::string &name) const
  {
    std::vector<std::string> names;
    for (const auto &region : regions)
      names.push_back(region.name);
    const auto found = std::find(names.begin(), names.end(), name);
    require_materials(found != names.end(), "'" + quotable(name) + "' is no region of '" +
                                              body.name + "', they are " + listed(names) +
                                              did_you_mean(name, names));
    require_materials(regions[found - names.begin()].n_cells > 0,
                      "the region '" + name + "' has no cells");
  }

  void require_materials(const bool good, const std::string &allowed) const
  {
    require(good, "Materials", text_of_materials(body.materials), allowed);
  }
};
} // namespace

void check_materials(const Scene &scene, const Origins &origins)
{
  for (const auto &material : scene.materials)
    check_material(SectionCheck("Material " + material.name, origins), material.material);
}

void check_regions(const Scene &scene, const Body &body, const Origins &origins)
{
  const SectionCheck section(body.section(), origins);
  if (body.materials.empty())
    return check_material(section, body.material);
  check_unread(section, body.material);
  std::vector<std::string> known;
  for (const auto &material : scene.materials)
    known.push_back(material.name);
  for (const auto &[region, material] : body.materials)
    section.require(std::find(known.begin(), known.end(), material) != known.end(), "Materials",
                    text_of_materials(body.materials),
                    "'" + quotable(material) + "' is none of the 'Materials' of the scene" +
                      (known.empty() ? "" : ", " + listed(known)) + did_you_mean(material, known));
  RegionCheck(scene, body, origins).check();
}
} // namespace snug::scene
