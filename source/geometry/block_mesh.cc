#include <snug/geometry/block_mesh.h>
#include <snug/geometry/cell_numbering.h>

#include <deal.II/base/exceptions.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <set>

namespace snug::geometry {
template <int dim>
void mirror(BlockMesh<dim> &mesh, unsigned int axis, const std::string &name)
{
  using Face = typename BlockMesh<dim>::Face;
  // The comparison is exact, because round_blocks.cc sets these coordinates to 0 and only scales
  // them.
  const auto is_on_plane = [&](unsigned int vertex) { return mesh.vertices[vertex][axis] == 0.; };
  std::vector<unsigned int> image;
  const unsigned int        n_vertices = mesh.vertices.size();
  for (unsigned int v = 0; v < n_vertices; ++v)
    {
      image.push_back(is_on_plane(v) ? v : mesh.vertices.size());
      if (is_on_plane(v))
        continue;
      mesh.vertices.push_back(mesh.vertices[v]);
      mesh.vertices.back()[axis] *= -1.;
    }
  const unsigned int n_blocks = mesh.blocks.size();
  for (unsigned int b = 0; b < n_blocks; ++b)
    {
      // The first axis of a mirrored block is reversed, so that the block stays right-handed.
      std::vector<unsigned int> block(mesh.blocks[b].size());
      for (unsigned int v = 0; v < block.size(); ++v)
        block[v] = image[mesh.blocks[b][v ^ 1]];
      mesh.blocks.push_back(block);
      mesh.regions.push_back(mesh.regions[b]);
    }
  // The loop runs over a copy, because it adds and erases entries.
  const auto old = mesh.boundaries;
  for (const auto &face : old)
    {
      // The faces in the mirror plane are interior faces of the whole body.
      if (mesh.boundary_names[face.second] == name)
        {
          mesh.boundaries.erase(face.first);
          continue;
        }
      Face key;
      for (const unsigned int v : face.first)
        key.push_back(image[v]);
      mesh.boundaries[sorted(key)] = face.second;
    }
}

template <int dim>
void set_known(BlockMesh<dim> &mesh, const unsigned int index, const KnownSurface<dim> &surface)
{
  for (const auto &face : mesh.boundaries)
    if (face.second == index)
      mesh.known[face.first] = mesh.known_surfaces.size();
  mesh.known_surfaces.push_back(surface);
  mesh.shapes[index].name = surface.name();
}

template <int dim>
void remove_unused_boundaries(BlockMesh<dim> &mesh)
{
  std::map<unsigned int, unsigned int> number;
  for (const auto &face : mesh.boundaries)
    number[face.second] = 0;
  std::vector<std::string>                                 names;
  std::map<unsigned int, typename BlockMesh<dim>::Surface> surfaces;
  for (auto &entry : number)
    {
      // std::map visits the old indices in ascending order, so the order of the names is kept.
      entry.second = names.size();
      names.push_back(mesh.boundary_names[entry.first]);
      if (mesh.surfaces.count(entry.first) > 0)
        surfaces[entry.second] = mesh.surfaces.at(entry.first);
    }
  for (auto &face : mesh.boundaries)
    face.second = number[face.second];
  mesh.boundary_names = names;
  mesh.surfaces       = surfaces;
}

namespace {
/// Return whether no edge occurs in both directions.
template <int dim>
bool is_consistent(const std::vector<dealii::CellData<dim>> &cells)
{
  using Info = dealii::GeometryInfo<dim>;
  std::set<std::pair<unsigned int, unsigned int>> edges;
  for (const auto &cell : cells)
    for (unsigned int e = 0; e < Info::lines_per_cell; ++e)
      edges.emplace(cell.vertices[Info::line_to_cell_vertices(e, 0)],
                    cell.vertices[Info::line_to_cell_vertices(e, 1)]);
  return std::none_of(edges.begin(), edges.end(),
                      [&](const auto &edge) { return edges.count({edge.second, edge.first}) > 0; });
}

/// Return the cells of the first 2^dim vertices of the blocks. For dim = 2 and blocks in 3D, the
/// cells are the quadrilaterals at the bottoms of the blocks.
template <int dim>
std::vector<dealii::CellData<dim>>
first_vertices(const std::vector<std::vector<unsigned int>> &blocks)
{
  std::vector<dealii::CellData<dim>> cells;
  for (const auto &block : blocks)
    {
      cells.emplace_back(1u << dim);
      std::copy_n(block.begin(), 1u << dim, cells.back().vertices.begin());
    }
  return cells;
}
} // namespace

template <int dim>
bool order_consistently(BlockMesh<dim> &mesh)
{
  // Algorithm: Agelek, Anderson, Bangerth, Barth, ACM Trans. Math. Software 44, 2017. Some 3D
  // meshes have no such order, for example a ring of hexahedra whose section turns by 90 degrees.
  auto cells = first_vertices<dim>(mesh.blocks);
  if (is_consistent(cells))
    return true;
  try
    {
      dealii::GridTools::consistently_order_cells(cells);
    }
  catch (const dealii::ExceptionBase &)
    {
      return false;
    }
  // In 3D, deal.II does not change the cells if there is no order, and reports no error.
  if (!is_consistent(cells))
    return false;
  for (unsigned int b = 0; b < cells.size(); ++b)
    mesh.blocks[b].assign(cells[b].vertices.begin(), cells[b].vertices.end());
  return true;
}

void order_layer_consistently(BlockMesh<3> &mesh)
{
  auto cells = first_vertices<2>(mesh.blocks);
  dealii::GridTools::consistently_order_cells(cells);
  for (unsigned int b = 0; b < cells.size(); ++b)
    {
      // The vertex above a bottom vertex is 4 positions behind it and is moved with it.
      const auto old = mesh.blocks[b];
      for (unsigned int v = 0; v < 4; ++v)
        {
          const auto place      = std::find(old.begin(), old.end(), cells[b].vertices[v]);
          mesh.blocks[b][v]     = *place;
          mesh.blocks[b][v + 4] = *(place + 4);
        }
    }
}

template void mirror(BlockMesh<2> &, unsigned int, const std::string &);
template void mirror(BlockMesh<3> &, unsigned int, const std::string &);
template void set_known(BlockMesh<2> &, unsigned int, const KnownSurface<2> &);
template void set_known(BlockMesh<3> &, unsigned int, const KnownSurface<3> &);
template void remove_unused_boundaries(BlockMesh<2> &);
template void remove_unused_boundaries(BlockMesh<3> &);
template bool order_consistently(BlockMesh<2> &);
template bool order_consistently(BlockMesh<3> &);
} // namespace snug::geometry
