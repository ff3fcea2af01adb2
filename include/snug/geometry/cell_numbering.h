#ifndef snug_geometry_cell_numbering_h
#define snug_geometry_cell_numbering_h

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace snug::geometry {
using Vertices = std::vector<unsigned int>; ///< of a cell, a face or an edge

/// Return the key of a face or an edge, because cells list the vertices in different orders.
inline Vertices sorted(Vertices vertices)
{
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// Hash of vertices.
struct VerticesHash
{
  std::size_t operator()(const Vertices &vertices) const
  {
    std::uint64_t hash = 14695981039346656037u;
    for (const unsigned int vertex : vertices)
      hash = (hash ^ vertex) * 1099511628211u;
    return hash ^ hash >> 32;
  }
};

/// Numbers of edges, faces or cells by their vertices in ascending order. The search takes a
/// fraction of the time of a std::map.
using NumberByVertices = std::unordered_map<Vertices, unsigned int, VerticesHash>;

/// Return the vertices of face 2d + s of a cell, the side s of axis d, first tangent fastest. The
/// tangents are the next axes in turn, as in deal.II, whose tables are slow to look up.
template <int dim>
Vertices face_of(const Vertices &cell, unsigned int face)
{
  const unsigned int d = face / 2, first = (d + 1) % dim, second = (d + 2) % dim;
  Vertices           result(1u << (dim - 1));
  for (unsigned int v = 0; v < result.size(); ++v)
    result[v] = cell[(face % 2) << d | (v & 1) << first | (v >> 1) << second];
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
