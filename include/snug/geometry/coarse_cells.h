#ifndef snug_geometry_coarse_cells_h
#define snug_geometry_coarse_cells_h

#include <snug/geometry/body_geometry.h>

#include <deal.II/grid/cell_id.h>

namespace snug::geometry {
/**
 * Where refined cells lie in the coarse cells of their bodies. Coarse
 * cells have deal.II's ids, their places in the coarse mesh of all bodies.
 */
template <int dim>
class CoarseCells
{
public:
  CoarseCells() = default;

  /// Of coarse cells body after body; @p first_cell: of each body, and the end.
  explicit CoarseCells(const std::vector<unsigned int> &first_cell);

  /// Index of the coarse cell of @p cell among those of its body.
  unsigned int coarse_cell(const dealii::CellId &cell) const
  {
    return index_of_id[cell.get_coarse_cell_id()];
  }

  /// The point at coordinates @p unit of @p cell.
  MeshPoint<dim> point(const dealii::CellId &cell, const dealii::Point<dim> &unit) const;

private:
  std::vector<unsigned int> index_of_id; ///< within the body
};
} // namespace snug::geometry

#endif
