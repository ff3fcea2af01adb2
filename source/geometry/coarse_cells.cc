#include <snug/geometry/coarse_cells.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>

namespace snug::geometry {
namespace {
dealii::CellId with_coarse_cell(const dealii::CellId &cell, const unsigned int coarse)
{
  const auto path = cell.get_child_indices();
  return {coarse, static_cast<unsigned int>(path.size()), path.data()};
}
} // namespace

template <int dim>
unsigned int CoarseCells<dim>::body(const dealii::CellId &cell) const
{
  return std::upper_bound(first_cell.begin(), first_cell.end(), cell.get_coarse_cell_id()) -
         first_cell.begin() - 1;
}

template <int dim>
dealii::CellId CoarseCells<dim>::in_body(const dealii::CellId &cell) const
{
  return with_coarse_cell(cell, coarse_cell(cell));
}

template <int dim>
dealii::CellId CoarseCells<dim>::in_all(const unsigned int body, const dealii::CellId &cell) const
{
  return with_coarse_cell(cell, first_cell[body] + cell.get_coarse_cell_id());
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
