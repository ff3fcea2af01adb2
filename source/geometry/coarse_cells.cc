#include <snug/geometry/coarse_cells.h>

#include <deal.II/base/geometry_info.h>

#include <deal.II/grid/tria.h>

#include <map>

namespace snug::geometry {
/// On level 0 every rank has all cells, so this needs no communication.
template <int dim>
CoarseCells<dim>::CoarseCells(const dealii::Triangulation<dim, dim> &triangulation)
  : index_of_id(triangulation.n_cells(0))
{
  std::map<unsigned int, unsigned int> n_of_body;
  // ids go through all bodies; cells count from 0 in each, as geometries do
  for (const auto &cell : triangulation.cell_iterators_on_level(0))
    index_of_id[cell->id().get_coarse_cell_id()] = n_of_body[cell->material_id()]++;
}

template <int dim>
MeshPoint<dim> CoarseCells<dim>::point(const dealii::CellId     &cell,
                                       const dealii::Point<dim> &unit) const
{
  MeshPoint<dim> result{coarse_cell(cell), unit};
  // from the cell up to its coarse cell: the last child of the path comes first
  const auto path = cell.get_child_indices();
  for (unsigned int level = path.size(); level > 0; --level)
    result.unit =
      dealii::GeometryInfo<dim>::child_to_cell_coordinates(result.unit, static_cast<unsigned int>(
                                                                          path[level - 1]));
  return result;
}

template class CoarseCells<2>;
template class CoarseCells<3>;
} // namespace snug::geometry
