#include <snug/geometry/grid_geometry.h>

namespace snug::geometry {
template <int dim>
GridGeometry<dim>::GridGeometry(const Counts                   &cells,
                                const std::vector<std::string> &names,
                                bool                            closed)
  : cells(cells), names(names), closed(closed)
{}

/// The last axis is the slowest. If the last axis is closed, the numbers end one layer earlier.
template <int dim>
unsigned int GridGeometry<dim>::vertex(Counts place) const
{
  if (closed)
    // The first layer follows the last layer.
    place[dim - 1] %= cells[dim - 1];
  unsigned int index = 0;
  for (int d = dim - 1; d >= 0; --d)
    index = index * (cells[d] + 1) + place[d];
  return index;
}

template <int dim>
typename BodyGeometry<dim>::CoarseMesh GridGeometry<dim>::coarse_mesh() const
{
  typename BodyGeometry<dim>::CoarseMesh mesh;
  Counts                                 n_vertices = cells;
  for (unsigned int d = 0; d < dim; ++d)
    n_vertices[d] += closed && d == dim - 1 ? 0 : 1;
  for (unsigned int v = 0; v < product(n_vertices); ++v)
    {
      const Counts       place = multi_index(v, n_vertices);
      dealii::Point<dim> logical;
      for (unsigned int d = 0; d < dim; ++d)
        logical[d] = static_cast<double>(place[d]) / cells[d];
      // Logical points suffice to identify cells. With a closed axis, however, the last layer of
      // cells would be inverted and would overlap all other layers in logical coordinates.
      mesh.vertices.push_back(closed ? grid_position(logical) : logical);
    }
  for (unsigned int c = 0; c < n_coarse_cells(); ++c)
    {
      const Counts index = multi_index(c, cells);
      Vertices     cell(dealii::GeometryInfo<dim>::vertices_per_cell);
      for (unsigned int v = 0; v < cell.size(); ++v)
        {
          Counts place = index;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] += v >> d & 1;
          cell[v] = vertex(place);
        }
      mesh.cells.push_back(cell);
      // A closed axis is the last axis and has no sides and no names.
      for (unsigned int f = 0; f < names.size(); ++f)
        if (index[f / 2] == (f % 2 == 1 ? cells[f / 2] - 1 : 0))
          mesh.boundary_faces.emplace_back(face_of<dim>(cell, f), f);
    }
  return mesh;
}

template <int dim>
dealii::Point<dim> GridGeometry<dim>::logical(const MeshPoint<dim> &point) const
{
  dealii::Point<dim> result;
  const Counts       index = multi_index(point.cell, cells);
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = (index[d] + point.unit[d]) / cells[d];
  return result;
}

template class GridGeometry<2>;
template class GridGeometry<3>;
} // namespace snug::geometry
