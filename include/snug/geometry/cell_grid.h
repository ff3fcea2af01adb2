#ifndef snug_geometry_cell_grid_h
#define snug_geometry_cell_grid_h

#include <snug/geometry/cell_numbering.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/point.h>

#include <cmath>

namespace snug::geometry {
/// The coarse cells of a body in layers along the axes. The first axis is the fastest in the
/// numbers of cells and vertices. The last axis may be closed: the first layer of cells follows
/// the last layer, and the axis has no sides. Side s of axis d has the number 2d + s.
template <int dim>
struct CellGrid
{
  using Counts = std::array<unsigned int, dim>;

  Counts cells; ///< along the axes
  bool   closed = false;

  /// Return the number of cells, for which 32 bits must suffice.
  unsigned int n_cells() const { return static_cast<unsigned int>(product(cells)); }

  /// Return the number of axes with sides.
  unsigned int n_open_axes() const { return closed ? dim - 1 : dim; }

  /// Return the layers of a cell.
  Counts layers(const unsigned int cell) const { return multi_index(cell, cells); }

  /// Return the number of the cell in the layers @p at.
  unsigned int cell(const Counts &at) const { return number(at, cells); }

  /// Return the numbers of vertices along the axes.
  Counts vertices() const
  {
    Counts n = cells;
    for (unsigned int d = 0; d < n_open_axes(); ++d)
      ++n[d];
    return n;
  }

  /// Return the number of the vertex @p v of the cell in the layers @p at.
  unsigned int vertex(Counts at, const unsigned int v) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      at[d] += v >> d & 1;
    if (closed)
      at[dim - 1] %= cells[dim - 1];
    return number(at, vertices());
  }

  /// Return a place of a vertex at which no two vertices lie and no cell is inverted. If the last
  /// axis is closed, the last two axes are the radius and the angle of a ring, otherwise all places
  /// lie in [0,1]^dim.
  dealii::Point<dim> vertex_place(const unsigned int vertex) const
  {
    const Counts       at = multi_index(vertex, vertices());
    dealii::Point<dim> place;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = static_cast<double>(at[d]) / cells[d];
    if (!closed)
      return place;
    const double radius = 1. + place[dim - 2], angle = 2. * dealii::numbers::PI * place[dim - 1];
    dealii::Point<dim> result;
    result[0]       = radius * std::cos(angle);
    result[1]       = radius * std::sin(angle);
    result[dim - 1] = dim == 3 ? place[0] : result[dim - 1];
    return result;
  }

  /// Return whether the face @p face of the cell in the layers @p at is on the side @p face.
  bool at_side(const Counts &at, const unsigned int face) const
  {
    const unsigned int d = face / 2;
    return d < n_open_axes() && at[d] == (face % 2 == 1 ? cells[d] - 1 : 0);
  }

  /// Call @p action with each cell and face on a side, in the order of cells and of faces.
  template <typename Action>
  void for_sides(const Action &action) const
  {
    for (unsigned int c = 0; c < n_cells(); ++c)
      {
        const Counts at    = layers(c);
        bool         inner = true;
        for (unsigned int f = 0; f < 2 * n_open_axes(); ++f)
          if (at_side(at, f))
            {
              action(c, f);
              inner = inner && f < 2;
            }
        // The other cells of a row inside the grid have no sides.
        if (inner && at[0] == 0 && cells[0] > 2)
          c += cells[0] - 2;
      }
  }

private:
  static unsigned int number(const Counts &at, const Counts &n)
  {
    unsigned int result = 0;
    for (unsigned int d = dim; d-- > 0;)
      result = result * n[d] + at[d];
    return result;
  }
};
} // namespace snug::geometry

#endif
