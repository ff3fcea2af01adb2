#ifndef snug_geometry_grid_geometry_h
#define snug_geometry_grid_geometry_h

#include <snug/geometry/body_geometry.h>
#include <snug/geometry/cell_numbering.h>

namespace snug::geometry {
/**
 * A body whose coarse cells are a grid: cell (i, j, k) of n x m x l has
 * logical coordinates [i/n, (i+1)/n] x ... The last axis may be closed,
 * its last layer of cells followed by the first; it has no sides then.
 */
template <int dim>
class GridGeometry : public BodyGeometry<dim>
{
public:
  using Counts = std::array<unsigned int, dim>;

  /// @p names: of boundary 2d + s; fewer by two if the last axis is
  /// closed.
  GridGeometry(const Counts &cells, const std::vector<std::string> &names, bool closed = false);

  typename BodyGeometry<dim>::CoarseMesh coarse_mesh() const override;

  double n_coarse_cells() const override { return product(cells); }

  const std::vector<std::string> &boundary_names() const override { return names; }

  /// Computed at every node anew, so that refined cells keep spacing and curvature.
  dealii::Point<dim> position(const MeshPoint<dim> &point) const override
  {
    return grid_position(logical(point));
  }

  dealii::Point<dim> logical(const MeshPoint<dim> &point) const override;

  bool has_grid() const override { return true; }

  /// Reference position at logical coordinates.
  virtual dealii::Point<dim> grid_position(const dealii::Point<dim> &logical) const = 0;

protected:
  /// Cells along the axes.
  const Counts cells;

  /// Whether the face @p face of a coarse cell is on that side of the body.
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
