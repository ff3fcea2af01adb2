#ifndef snug_geometry_grid_geometry_h
#define snug_geometry_grid_geometry_h

#include <snug/geometry/body_geometry.h>
#include <snug/geometry/cell_grid.h>

namespace snug::geometry {
/**
 * A body whose coarse cells are a grid: cell (i, j, k) of n x m x l has
 * logical coordinates [i/n, (i+1)/n] x ... The last axis may be closed. A closed axis has no sides.
 */
template <int dim>
class GridGeometry : public BodyGeometry<dim>
{
public:
  using Counts = typename CellGrid<dim>::Counts;

  /// Construct the grid. @p names are the names of the boundaries 2d + s. If the last axis is
  /// closed, its two names are omitted.
  GridGeometry(const Counts &cells, const std::vector<std::string> &names, bool closed = false);

  typename BodyGeometry<dim>::CoarseMesh coarse_mesh() const override;

  double n_coarse_cells() const override { return product(cells.cells); }

  const std::vector<std::string> &boundary_names() const override { return names; }

  /// Return the position at the logical coordinates of @p point, so that the nodes of refined
  /// cells keep spacing and curvature.
  dealii::Point<dim> position(const MeshPoint<dim> &point) const override
  {
    return grid_position(logical(point));
  }

  dealii::Point<dim> logical(const MeshPoint<dim> &point) const override;

  const CellGrid<dim> *grid() const override { return &cells; }

  /// Return the reference position at logical coordinates.
  virtual dealii::Point<dim> grid_position(const dealii::Point<dim> &logical) const = 0;

protected:
  /// Return whether the face @p face of a coarse cell is on the side @p face of the body.
  bool at_side(unsigned int coarse_cell, unsigned int face) const
  {
    return cells.at_side(cells.layers(coarse_cell), face);
  }

private:
  const CellGrid<dim>      cells;
  std::vector<std::string> names;
};
} // namespace snug::geometry

#endif
