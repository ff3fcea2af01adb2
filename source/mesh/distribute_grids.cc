#include <snug/base/deal_ii_compat.h>
#include <snug/base/run_context.h>
#include <snug/mesh/cell_shape.h>
#include <snug/mesh/coarse_description.h>
#include <snug/mesh/distribute.h>
#include <snug/mesh/grid_partition.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::mesh {
namespace {
using geometry::CellGrid;

/// Return the number of slender cells of a body on all ranks, each of which looks at a share.
/// Collective.
template <int dim>
unsigned long count_slender(const geometry::BodyGeometry<dim> &geometry,
                            const MPI_Comm                     communicator)
{
  const unsigned long rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
  const unsigned long n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  const unsigned long n       = geometry.grid()->n_cells();
  unsigned long       result  = 0;
  // A formula may fail at a position that only one rank has.
  throw_collectively(communicator, [&]() {
    for (unsigned int cell = n * rank / n_ranks; cell < n * (rank + 1) / n_ranks; ++cell)
      result += CellShape<dim>([&](const dealii::Point<dim> &unit) {
                  return geometry.position({cell, unit});
                }).is_slender();
  });
  return dealii::Utilities::MPI::sum(result, communicator);
}

/// The parts of one body and their ranks.
template <int dim>
struct PlacedParts
{
  GridParts<dim>            parts;
  std::vector<unsigned int> first_of_rank; ///< first part of each rank, then the number of parts

  unsigned int rank(const unsigned int part) const
  {
    return std::upper_bound(first_of_rank.begin(), first_of_rank.end(), part) -
           first_of_rank.begin() - 1;
  }
};

template <int dim>
std::vector<PlacedParts<dim>> place_parts(const Geometries<dim>   &geometries,
                                          const TearingParameters &parameters,
                                          const CellsPerSubdomain &by_size,
                                          const MPI_Comm           communicator)
{
  const unsigned int       n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  std::vector<CellsOfBody> bodies;
  for (const auto &geometry : geometries)
    bodies.push_back({geometry->grid()->n_cells(), count_slender(*geometry, communicator), true});
  std::vector<GridParts<dim>> parts;
  make_parts(dim, bodies, parameters, by_size, n_ranks, [&](const auto &cells_each) {
    parts.clear();
    unsigned long n_filled = 0;
    for (unsigned int body = 0; body < geometries.size(); ++body)
      {
        parts.emplace_back(*geometries[body]->grid(), geometries[body]->extent(), cells_each[body]);
        n_filled += parts.back().n_filled();
      }
    return n_filled;
  });
  std::vector<PlacedParts<dim>> result;
  RankRuns                      runs(n_ranks);
  for (const auto &of_body : parts)
    result.push_back({of_body, runs.next_body(of_body.n_parts(), [&](const unsigned int part) {
                        return of_body.cells_before(part);
                      })});
  return result;
}

void keep_once(std::vector<unsigned int> &numbers)
{
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Return the layers from @p begin to @p end and the next layer on either side.
template <int dim>
std::vector<unsigned int> with_next_layers(const CellGrid<dim> &grid,
                                           const unsigned int   axis,
                                           const unsigned int   begin,
                                           const unsigned int   end)
{
  std::vector<unsigned int> layers;
  const unsigned int        n = grid.cells[axis];
  for (unsigned int next = begin; next < end + 2; ++next)
    if (axis >= grid.n_open_axes())
      layers.push_back((next + n - 1) % n);
    else if (next > 0 && next <= n)
      layers.push_back(next - 1);
  return layers;
}

/// Return the cells of a body on @p rank and the cells that share a vertex with one of them, which
/// deal.II needs as ghost cells.
template <int dim>
std::vector<unsigned int>
relevant_cells(const CellGrid<dim> &grid, const PlacedParts<dim> &placed, const unsigned int rank)
{
  std::vector<unsigned int> result;
  for (unsigned int part = placed.first_of_rank[rank]; part < placed.first_of_rank[rank + 1];
       ++part)
    if (placed.parts.cells_before(part) < placed.parts.cells_before(part + 1))
      {
        const auto [begin, end] = placed.parts.layers(part);
        std::array<std::vector<unsigned int>, dim> layers;
        CellGrid<dim>                              box;
        for (unsigned int d = 0; d < dim; ++d)
          {
            layers[d]    = with_next_layers(grid, d, begin[d], end[d]);
            box.cells[d] = layers[d].size();
          }
        for (unsigned int c = 0; c < box.n_cells(); ++c)
          {
            auto at = box.layers(c);
            for (unsigned int d = 0; d < dim; ++d)
              at[d] = layers[d][at[d]];
            result.push_back(grid.cell(at));
          }
      }
  keep_once(result);
  return result;
}

/// Return the vertices of cells in the order of vertices.
template <int dim>
std::vector<unsigned int> vertices_of(const CellGrid<dim>             &grid,
                                      const std::vector<unsigned int> &cells)
{
  std::vector<unsigned int> result;
  result.reserve(cells.size() << dim);
  for (const unsigned int cell : cells)
    {
      const auto at = grid.layers(cell);
      for (unsigned int v = 0; v < 1u << dim; ++v)
        result.push_back(grid.vertex(at, v));
    }
  keep_once(result);
  return result;
}

/// Add @p cells of a body to the description, and the parts of those on @p rank to @p parts.
template <int dim>
void describe(const geometry::BodyGeometry<dim>                       &geometry,
              const unsigned int                                       body,
              const unsigned int                                       first_cell,
              const PlacedParts<dim>                                  &placed,
              const std::vector<unsigned int>                         &cells,
              const unsigned int                                       rank,
              dealii::TriangulationDescription::Description<dim, dim> &description,
              std::vector<unsigned int>                               &parts)
{
  const auto               &grid     = *geometry.grid();
  const auto                vertices = vertices_of(grid, cells);
  const unsigned int        none     = static_cast<unsigned int>(-1);
  std::vector<unsigned int> number(vertices.size(), none);
  for (const unsigned int cell : cells)
    {
      const auto         at   = grid.layers(cell);
      const unsigned int part = placed.parts.part(at), owner = placed.rank(part);
      if (owner == rank)
        parts.push_back(part);
      add_cell(first_cell + cell, body, owner, description);
      for (unsigned int v = 0; v < 1u << dim; ++v)
        {
          const unsigned int vertex = grid.vertex(at, v);
          unsigned int      &n =
            number[std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin()];
          if (n == none)
            {
              n = description.coarse_cell_vertices.size();
              description.coarse_cell_vertices.push_back(grid.vertex_place(vertex));
            }
          description.coarse_cells.back().vertices[v] = n;
        }
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (grid.at_side(at, face))
          description.cell_infos[0].back().boundary_ids.emplace_back(face,
                                                                     geometry.side_boundary(cell,
                                                                                            face));
    }
}
} // namespace

/// Cells are added in the order of their ids, so that the nodes are numbered as if every rank had
/// all cells.
template <int dim>
std::vector<unsigned int>
distribute_grids(const Geometries<dim>                                  &geometries,
                 const TearingParameters                                &parameters,
                 const CellsPerSubdomain                                &by_size,
                 dealii::parallel::fullydistributed::Triangulation<dim> &result)
{
  const MPI_Comm     communicator = deal_ii_compat::communicator(result);
  const unsigned int rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
  auto               description  = coarse_description(result);
  const auto         placed       = place_parts(geometries, parameters, by_size, communicator);
  std::vector<std::vector<unsigned int>> cells;
  std::size_t                            n_cells = 0;
  for (unsigned int body = 0; body < geometries.size(); ++body)
    {
      cells.push_back(relevant_cells(*geometries[body]->grid(), placed[body], rank));
      n_cells += cells.back().size();
    }
  // Vectors that grow would take twice the memory.
  description.coarse_cells.reserve(n_cells);
  description.coarse_cell_index_to_coarse_cell_id.reserve(n_cells);
  description.cell_infos[0].reserve(n_cells);
  std::vector<unsigned int> parts;
  unsigned int              first_cell = 0;
  for (unsigned int body = 0; body < geometries.size(); ++body)
    {
      describe(*geometries[body], body, first_cell, placed[body], cells[body], rank, description,
               parts);
      first_cell += geometries[body]->grid()->n_cells();
    }
  result.create_triangulation(description);
  return parts;
}

#define SNUG_INSTANTIATE(dim)                                                      \
  template std::vector<unsigned int> distribute_grids(                             \
    const Geometries<dim> &, const TearingParameters &, const CellsPerSubdomain &, \
    dealii::parallel::fullydistributed::Triangulation<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mesh
