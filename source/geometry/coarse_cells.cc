#include <snug/geometry/coarse_cells.h>

#include <deal.II/base/geometry_info.h>

namespace snug::geometry {
template <int dim>
CoarseCells<dim>::CoarseCells(const std::vector<unsigned int> &first_cell)
{
  for (unsigned int body = 0; body + 1 < first_cell.size(); ++body)
    for (unsigned int cell = first_cell[body]; cell < first_cell[body + 1]; ++cell)
      index_of_id.push_back(cell - first_cell[body]);
}

template <int dim>
MeshPoint<dim> CoarseCells<dim>::point(const dealii::CellId     &cell,
                                       const dealii::Point<dim> &unit) const
{
  MeshPoint<dim> result{coarse_cell(cell), unit};
  // The loop goes from the cell up to the coarse cell, beginning with the last child of the path.
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
