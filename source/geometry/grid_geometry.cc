#include <snug/geometry/grid_geometry.h>

namespace snug::geometry {
template <int dim>
GridGeometry<dim>::GridGeometry(const Counts                   &cells,
                                const std::vector<std::string> &names,
                                bool                            closed)
  : cells{cells, closed}, names(names)
{}

template <int dim>
typename BodyGeometry<dim>::CoarseMesh GridGeometry<dim>::coarse_mesh() const
{
  typename BodyGeometry<dim>::CoarseMesh mesh;
  for (unsigned int v = 0; v < product(cells.vertices()); ++v)
    mesh.vertices.push_back(cells.vertex_place(v));
  for (unsigned int c = 0; c < n_coarse_cells(); ++c)
    {
      Vertices cell(dealii::GeometryInfo<dim>::vertices_per_cell);
      for (unsigned int v = 0; v < cell.size(); ++v)
        cell[v] = cells.vertex(cells.layers(c), v);
      mesh.cells.push_back(cell);
    }
  cells.for_sides([&](const unsigned int cell, const unsigned int face) {
    mesh.boundary_faces.emplace_back(face_of<dim>(mesh.cells[cell], face), face);
  });
  return mesh;
}

template <int dim>
dealii::Point<dim> GridGeometry<dim>::logical(const MeshPoint<dim> &point) const
{
  dealii::Point<dim> result;
  const Counts       layers = cells.layers(point.cell);
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = (layers[d] + point.unit[d]) / cells.cells[d];
  return result;
}

template class GridGeometry<2>;
template class GridGeometry<3>;
} // namespace snug::geometry
