#include <snug/geometry/grid_geometry.h>

#include <deal.II/base/geometry_info.h>

namespace snug::geometry {
namespace {
/// All multi-indices below @p n, the first index fastest.
template <int dim>
std::vector<std::array<unsigned int, dim>> multi_indices(const std::array<unsigned int, dim> &n)
{
  std::vector<std::array<unsigned int, dim>> result(1);
  result[0].fill(0);
  for (int d = dim - 1; d >= 0; --d)
    {
      const auto slower = result;
      result.clear();
      for (auto index : slower)
        for (index[d] = 0; index[d] < n[d]; ++index[d])
          result.push_back(index);
    }
  return result;
}
} // namespace

template <int dim>
GridGeometry<dim>::GridGeometry(const Counts                   &cells,
                                const std::vector<std::string> &names,
                                bool                            closed)
  : cells(cells), names(names), closed(closed)
{}

/// The last axis is the slowest: if it is closed, numbers just end one layer earlier.
template <int dim>
unsigned int GridGeometry<dim>::vertex(Counts place) const
{
  if (closed)
    // behind the last layer comes the first
    place[dim - 1] %= cells[dim - 1];
  unsigned int index = 0;
  for (int d = dim - 1; d >= 0; --d)
    index = index * (cells[d] + 1) + place[d];
  return index;
}

template <int dim>
typename BodyGeometry<dim>::CoarseMesh GridGeometry<dim>::coarse_mesh() const
{
  using Info = dealii::GeometryInfo<dim>;
  typename BodyGeometry<dim>::CoarseMesh mesh;
  Counts                                 n_vertices = cells;
  for (unsigned int d = 0; d < dim; ++d)
    n_vertices[d] += closed && d == dim - 1 ? 0 : 1;
  for (const Counts &place : multi_indices<dim>(n_vertices))
    {
      dealii::Point<dim> logical;
      for (unsigned int d = 0; d < dim; ++d)
        logical[d] = static_cast<double>(place[d]) / cells[d];
      // Logical points tell cells apart, but the last layer of a closed axis would reach back over
      // all others, inverted.
      mesh.vertices.push_back(closed ? grid_position(logical) : logical);
    }
  for (const Counts &index : multi_indices<dim>(cells))
    {
      std::vector<unsigned int> cell(Info::vertices_per_cell);
      for (unsigned int v = 0; v < cell.size(); ++v)
        {
          Counts place = index;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] += v >> d & 1;
          cell[v] = vertex(place);
        }
      mesh.cells.push_back(cell);
      // a closed axis, being the last, has no sides and no names
      for (unsigned int f = 0; f < names.size(); ++f)
        if (index[f / 2] == (f % 2 == 1 ? cells[f / 2] - 1 : 0))
          {
            std::vector<unsigned int> face(Info::vertices_per_face);
            for (unsigned int v = 0; v < face.size(); ++v)
              face[v] = cell[Info::face_to_cell_vertices(f, v)];
            mesh.boundary_faces.emplace_back(face, f);
          }
    }
  return mesh;
}

/// As a double, which large entries do not let overflow.
template <int dim>
double GridGeometry<dim>::n_coarse_cells() const
{
  double n = 1.;
  for (const unsigned int along : cells)
    n *= along;
  return n;
}

template <int dim>
dealii::Point<dim> GridGeometry<dim>::logical(const MeshPoint<dim> &point) const
{
  dealii::Point<dim> result;
  // cells are numbered as multi_indices() lists them, the first axis fastest
  unsigned int rest = point.cell;
  for (unsigned int d = 0; d < dim; ++d)
    {
      result[d] = (rest % cells[d] + point.unit[d]) / cells[d];
      rest /= cells[d];
    }
  return result;
}

template class GridGeometry<2>;
template class GridGeometry<3>;
} // namespace snug::geometry
