#ifndef snug_geometry_grid_geometry_h
#define snug_geometry_grid_geometry_h

#include <snug/geometry/body_geometry.h>
#include <snug/geometry/cell_numbering.h>

namespace snug::geometry {
/**
 * A body whose coarse cells are a grid: cell (i, j, k) of n x m x l has
 * logical coordinates [i/n, (i+1)/n] x ... The last axis may be closed: the first layer of cells
 * follows the last layer. A closed axis has no sides.
 */
template <int dim>
class GridGeometry : public BodyGeometry<dim>
{
public:
  using Counts = std::array<unsigned int, dim>;

  /// Construct the grid. @p names are the names of the boundaries 2d + s. If the last axis is
  /// closed, its two names are omitted.
  GridGeometry(const Counts &cells, const std::vector<std::string> &names, bool closed = false);

  typename BodyGeometry<dim>::CoarseMesh coarse_mesh() const override;

  double n_coarse_cells() const override { return product(cells); }

  const std::vector<std::string> &boundary_names() const override { return names; }

  /// Return the position at the logical coordinates of @p point, so that the nodes of refined
  /// cells keep spacing and curvature.
  dealii::Point<dim> position(const MeshPoint<dim> &point) const override
  {
    return grid_position(logical(point));
  }

  dealii::Point<dim> logical(const MeshPoint<dim> &point) const override;

  bool has_grid() const override { return true; }

  /// Return the reference position at logical coordinates.
  virtual dealii::Point<dim> grid_position(const dealii::Point<dim> &logical) const = 0;

protected:
  /// Numbers of cells along the axes.
  const Counts cells;

  /// Return whether the face @p face of a coarse cell is on the side @p face of the body.
  bool at_side(unsigned int coarse_cell, unsigned int face) const
  {
    const unsigned int d = face / 2;
    return multi_index(coarse_cell, cells)[d] == (face % 2 == 1 ? cells[d] - 1 : 0);
  }

private:
  std::vector<std::string> names;
  bool                     closed;

  unsigned int vertex(Counts place) const;
};
} // namespace snug::geometry

#endif
