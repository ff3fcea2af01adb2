#ifndef snug_geometry_coarse_cells_h
#define snug_geometry_coarse_cells_h

#include <snug/geometry/body_geometry.h>

#include <deal.II/grid/cell_id.h>

namespace dealii {
template <int dim, int spacedim>
class Triangulation;
}

namespace snug::geometry {
/**
 * Where refined cells lie in the coarse cells of their bodies. Coarse
 * cells have deal.II's ids, which are the same in all triangulations made
 * of the same coarse mesh.
 */
template <int dim>
class CoarseCells
{
public:
  CoarseCells() = default;

  /// @param triangulation has all coarse cells, body after body; their
  ///   material ids are the bodies.
  explicit CoarseCells(const dealii::Triangulation<dim, dim> &triangulation);

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
