#include <snug/advice/coarse_faces.h>
#include <snug/geometry/cell_numbering.h>

namespace snug::advice {
template <int dim>
std::vector<CoarseFace> coarse_faces(const typename geometry::BodyGeometry<dim>::CoarseMesh &coarse)
{
  std::vector<std::vector<unsigned int>> cells_of(coarse.vertices.size());
  for (unsigned int cell = 0; cell < coarse.cells.size(); ++cell)
    for (const unsigned int vertex : coarse.cells[cell])
      cells_of[vertex].push_back(cell);
  std::vector<CoarseFace> result;
  for (const auto &[vertices, boundary] : coarse.boundary_faces)
    for (const unsigned int cell : cells_of[vertices.front()])
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (geometry::sorted(geometry::face_of<dim>(coarse.cells[cell], face)) ==
            geometry::sorted(vertices))
          result.push_back({cell, face, boundary});
  return result;
}

template std::vector<CoarseFace>
coarse_faces<2>(const typename geometry::BodyGeometry<2>::CoarseMesh &);
template std::vector<CoarseFace>
coarse_faces<3>(const typename geometry::BodyGeometry<3>::CoarseMesh &);
} // namespace snug::advice
