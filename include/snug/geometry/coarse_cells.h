#ifndef snug_geometry_coarse_cells_h
#define snug_geometry_coarse_cells_h

#include <snug/geometry/body_geometry.h>

#include <deal.II/grid/cell_id.h>

namespace snug::geometry {
/**
 * This class locates refined cells in the coarse cells of the bodies. The deal.II id of a coarse
 * cell is the position of the cell in the coarse mesh of all bodies.
 */
template <int dim>
class CoarseCells
{
public:
  CoarseCells() = default;

  /// Number the coarse cells of each body. The coarse mesh lists cells body after body.
  /// @p first_cell is the first cell of each body, followed by the number of cells.
  explicit CoarseCells(const std::vector<unsigned int> &first_cell) : first_cell(first_cell) {}

  /// Return the index of the coarse cell of @p cell among the coarse cells of the body.
  unsigned int coarse_cell(const dealii::CellId &cell) const
  {
    return cell.get_coarse_cell_id() - first_cell[body(cell)];
  }

  /// Return the body of a cell.
  unsigned int body(const dealii::CellId &cell) const;

  /// Return the id of a cell of a body in the coarse mesh of this body alone.
  dealii::CellId in_body(const dealii::CellId &cell) const;

  /// Return the id whose in_body() is @p cell.
  dealii::CellId in_all(unsigned int body, const dealii::CellId &cell) const;

  /// Return the point at coordinates @p unit of @p cell.
  MeshPoint<dim> point(const dealii::CellId &cell, const dealii::Point<dim> &unit) const;

private:
  std::vector<unsigned int> first_cell; ///< of each body, then the number of cells
};
} // namespace snug::geometry

#endif
