#ifndef snug_geometry_cell_numbering_h
#define snug_geometry_cell_numbering_h

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <vector>

namespace snug::geometry {
using Vertices = std::vector<unsigned int>; ///< of a cell, a face or an edge

/// Return the key of a face or an edge, because cells list the vertices in different orders.
inline Vertices sorted(Vertices vertices)
{
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// Return the vertices of face 2d + s of a cell, the side s of axis d, first tangent fastest.
template <int dim>
Vertices face_of(const Vertices &cell, unsigned int face)
{
  Vertices result;
  for (unsigned int v = 0; v < dealii::GeometryInfo<dim>::vertices_per_face; ++v)
    result.push_back(cell[dealii::GeometryInfo<dim>::face_to_cell_vertices(face, v)]);
  return result;
}

/// Return the number of cells of a grid with @p n cells along the axes. The result is a double,
/// because large entries would overflow an integer.
template <std::size_t dim>
double product(const std::array<unsigned int, dim> &n)
{
  return std::accumulate(n.begin(), n.end(), 1., std::multiplies<double>());
}

/// Return the multi-index of cell @p cell in a grid with @p n cells, the first axis fastest.
template <std::size_t dim>
std::array<unsigned int, dim> multi_index(unsigned int cell, const std::array<unsigned int, dim> &n)
{
  std::array<unsigned int, dim> index;
  for (unsigned int d = 0; d < dim; ++d)
    {
      index[d] = cell % n[d];
      cell /= n[d];
    }
  return index;
}
} // namespace snug::geometry

#endif
