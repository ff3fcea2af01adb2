#include <snug/geometry/entry_values.h>
#include <snug/geometry/formula.h>
#include <snug/geometry/regions.h>
#include <snug/geometry/wrapped_geometry.h>

namespace snug::geometry {
namespace {
const std::string formulas_entry = "Region formulas";

/// A geometry with regions by formulas. A formula adds cells to a region of the mesh file or makes
/// a further region.
template <int dim>
class GeometryWithRegions : public WrappedGeometry<dim>
{
public:
  GeometryWithRegions(std::unique_ptr<BodyGeometry<dim>> geometry,
                      const BodyMeshParameters          &parameters)
    : WrappedGeometry<dim>(std::move(geometry)), names(this->body->region_names())
  {
    for (const auto &[name, formula] : parameters.region_formulas)
      {
        const unsigned int index = index_in(names, name);
        for (const auto &other : formulas)
          if (other.first == index)
            throw bad_entry(formulas_entry, name,
                            "must not occur twice; a || b is positive "
                            "where a or b is");
        formulas.emplace_back(index, Formula<dim>(formulas_entry, formula));
      }
  }

  std::vector<std::string> region_names() const override { return names; }

  unsigned int region(unsigned int coarse_cell) const override
  {
    // Formulas are evaluated at coarse cells, so that refinement does not change the materials.
    const auto position = this->position({coarse_cell, unit_centre<dim>()});
    for (const auto &[index, formula] : formulas)
      if (formula.value(position) > 0.)
        return index;
    return this->body->region(coarse_cell);
  }

private:
  std::vector<std::string>                           names;
  std::vector<std::pair<unsigned int, Formula<dim>>> formulas;
};
} // namespace

template <int dim>
std::unique_ptr<BodyGeometry<dim>> with_regions(std::unique_ptr<BodyGeometry<dim>> geometry,
                                                const BodyMeshParameters          &parameters)
{
  if (parameters.region_formulas.empty())
    return geometry;
  return std::make_unique<GeometryWithRegions<dim>>(std::move(geometry), parameters);
}

/// Coarse cells are counted, so that a region without cells is found before refinement.
template <int dim>
std::vector<unsigned long> cells_of_regions(const BodyGeometry<dim> &geometry)
{
  std::vector<unsigned long> n(geometry.region_names().size(), 0);
  for (unsigned int cell = 0; cell < geometry.n_coarse_cells(); ++cell)
    ++n[geometry.region(cell)];
  return n;
}

template std::unique_ptr<BodyGeometry<2>> with_regions(std::unique_ptr<BodyGeometry<2>>,
                                                       const BodyMeshParameters &);
template std::unique_ptr<BodyGeometry<3>> with_regions(std::unique_ptr<BodyGeometry<3>>,
                                                       const BodyMeshParameters &);
template std::vector<unsigned long>       cells_of_regions(const BodyGeometry<2> &);
template std::vector<unsigned long>       cells_of_regions(const BodyGeometry<3> &);
} // namespace snug::geometry
