#include <snug/base/deal_ii_compat.h>
#include <snug/base/gather.h>
#include <snug/base/run_context.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/imported_mesh.h>
#include <snug/mesh/cell_shape.h>
#include <snug/mesh/coarse_description.h>
#include <snug/mesh/distribute.h>
#include <snug/mesh/parts.h>

#include <deal.II/base/mpi.h>

#include <boost/container/small_vector.hpp>
#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace snug::mesh {
namespace {
/// A face of a coarse cell, identified by the vertices of the face.
template <int dim>
struct CellFace
{
  std::array<unsigned int, 1 << (dim - 1)> vertices; ///< ascending
  unsigned int                             cell, number;
};

/// Return the faces of all cells, sorted so that the two entries of a shared face are adjacent.
template <int dim>
std::vector<CellFace<dim>> sorted_faces(const CoarseMesh<dim> &coarse)
{
  std::vector<CellFace<dim>> faces;
  faces.reserve(2 * dim * coarse.cells.size());
  for (unsigned int cell = 0; cell < coarse.cells.size(); ++cell)
    for (unsigned int f = 0; f < 2 * dim; ++f)
      {
        faces.push_back({{}, cell, f});
        const auto vertices = geometry::face_of<dim>(coarse.cells[cell].vertices, f);
        std::copy(vertices.begin(), vertices.end(), faces.back().vertices.begin());
        std::sort(faces.back().vertices.begin(), faces.back().vertices.end());
      }
  std::sort(faces.begin(), faces.end(), [](const auto &a, const auto &b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.cell < b.cell;
  });
  return faces;
}

/// The neighbours and the boundary faces of all coarse cells.
template <int dim>
struct Neighbourhood
{
  CellPairs                 pairs; ///< of cells that share a face
  std::vector<unsigned int> axes;  ///< axis of the first cell of a pair, normal to the face
  /// boundary faces of each cell: number of the face and index of the boundary
  std::vector<std::vector<std::pair<unsigned int, dealii::types::boundary_id>>> boundaries;

  explicit Neighbourhood(const CoarseMesh<dim> &coarse) : boundaries(coarse.cells.size())
  {
    const auto faces = sorted_faces(coarse);
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (f + 1 < faces.size() && faces[f].vertices == faces[f + 1].vertices)
        {
          pairs.push_back({{faces[f].cell, faces[f + 1].cell}});
          axes.push_back(faces[f].number / 2);
          ++f;
        }
      else
        // at() throws if a geometry gives a boundary face no boundary.
        boundaries[faces[f].cell].emplace_back(faces[f].number,
                                               coarse.boundary.at({faces[f].vertices.begin(),
                                                                   faces[f].vertices.end()}));
    for (auto &of_cell : boundaries)
      std::sort(of_cell.begin(), of_cell.end());
  }
};

/// Return the shapes of the cells of a body.
template <int dim>
std::vector<CellShape<dim>> shapes_of(const CoarseMesh<dim> &coarse, const unsigned int body)
{
  std::vector<CellShape<dim>> shapes;
  for (unsigned int cell = 0; cell < coarse.first_cell[body + 1] - coarse.first_cell[body]; ++cell)
    shapes.emplace_back([&](const dealii::Point<dim> &unit) {
      return coarse.geometries[body]->position({cell, unit});
    });
  return shapes;
}

/// Add the cells of a body to the set of the body.
template <int dim>
void add_cells(const CoarseMesh<dim>             &coarse,
               const QuadraticElements<dim>      &elements,
               const unsigned int                 body,
               const Neighbourhood<dim>          &neighbourhood,
               const std::vector<CellShape<dim>> &shapes,
               CellSet<dim>                      &set)
{
  const unsigned int begin = coarse.first_cell[body], end = coarse.first_cell[body + 1];
  for (unsigned int cell = begin; cell < end; ++cell)
    {
      set.add(elements.place(dealii::CellId(cell, {})), [&](const dealii::Point<dim> &unit) {
        return coarse.geometries[body]->logical({cell - begin, unit});
      });
      set.numbers.push_back(cell);
      set.keys.push_back({{cell, 0}});
    }
  for (std::size_t p = 0; p < neighbourhood.pairs.size(); ++p)
    if (const auto &pair = neighbourhood.pairs[p]; begin <= pair[0] && pair[0] < end)
      {
        set.neighbours.push_back(pair);
        set.areas.push_back(shapes[pair[0] - begin].section(neighbourhood.axes[p]));
      }
}

/// The coarse mesh as rank 0 holds it, with the part and the rank of each cell.
template <int dim>
struct WholeMesh
{
  const CoarseMesh<dim>    &coarse;
  const Neighbourhood<dim>  neighbourhood;
  std::vector<unsigned int> part, rank;

  explicit WholeMesh(const CoarseMesh<dim> &coarse) : coarse(coarse), neighbourhood(coarse) {}
};

/// Decide the parts and the ranks of all cells. On other ranks than 0 @p whole is null. Collective.
template <int dim>
void decide_places(const Forest<dim>            &forest,
                   WholeMesh<dim>               *whole,
                   const QuadraticElements<dim> &elements,
                   const TearingParameters      &parameters,
                   const CellsPerSubdomain      &by_size)
{
  const MPI_Comm     communicator = forest.communicator();
  const auto        &geometries   = *forest.geometries();
  const unsigned int n_bodies     = geometries.size();
  const auto shapes = shapes_of_bodies<dim>(n_bodies, communicator, [&](const unsigned int body) {
    return whole ? shapes_of(whole->coarse, body) : std::vector<CellShape<dim>>();
  });
  std::vector<CellSet<dim>> sets(n_bodies);
  for (unsigned int body = 0; body < n_bodies; ++body)
    {
      auto &set        = sets[body];
      set.communicator = communicator;
      set.n_global     = static_cast<unsigned long>(geometries[body]->n_coarse_cells());
      set.n_slender    = count_slender(shapes[body], communicator);
      set.size         = geometries[body]->extent();
      set.layered      = geometries[body]->grid() != nullptr;
      if (whole)
        add_cells(whole->coarse, elements, body, whole->neighbourhood, shapes[body], set);
    }
  const Parts parts = decide_parts(sets, parameters, by_size);
  const auto  ranks =
    ranks_of_parts(parts.cells, dealii::Utilities::MPI::n_mpi_processes(communicator));
  if (whole)
    for (unsigned int body = 0; body < n_bodies; ++body)
      for (const unsigned int part : parts.of_body[body].part)
        {
          whole->part.push_back(part);
          whole->rank.push_back(ranks[body][part]);
        }
}

/// Return the cells of each rank and the cells that share a vertex with one of them, which deal.II
/// needs as ghost cells.
template <int dim>
std::vector<std::vector<unsigned int>> relevant_cells(const WholeMesh<dim> &whole,
                                                      const unsigned int    n_ranks)
{
  const auto &coarse = whole.coarse;
  using Ranks        = boost::container::small_vector<unsigned int, 2>;
  std::vector<Ranks> at_vertex(coarse.vertices.size());
  const auto         add = [](Ranks &ranks, const unsigned int rank) {
    if (std::find(ranks.begin(), ranks.end(), rank) == ranks.end())
      ranks.push_back(rank);
  };
  for (unsigned int cell = 0; cell < coarse.cells.size(); ++cell)
    for (const unsigned int vertex : coarse.cells[cell].vertices)
      add(at_vertex[vertex], whole.rank[cell]);
  std::vector<std::vector<unsigned int>> result(n_ranks);
  for (unsigned int cell = 0; cell < coarse.cells.size(); ++cell)
    {
      Ranks ranks;
      for (const unsigned int vertex : coarse.cells[cell].vertices)
        for (const unsigned int rank : at_vertex[vertex])
          add(ranks, rank);
      for (const unsigned int rank : ranks)
        result[rank].push_back(cell);
    }
  return result;
}

/// Data that rank 0 sends to a rank.
template <int dim>
struct Share
{
  dealii::TriangulationDescription::Description<dim, dim> description;
  std::vector<unsigned int>                               parts; ///< of the cells of the rank
  QuadraticElements<dim>                                  elements;
  /// of the bodies whose cells other ranks lack
  std::vector<geometry::BlockMesh<dim>> excerpts;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & description & parts & elements & excerpts;
  }
};

/// Add @p cells, which the rank needs, to the share of the rank.
template <int dim>
void describe(const WholeMesh<dim>            &whole,
              const std::vector<unsigned int> &cells,
              const unsigned int               rank,
              Share<dim>                      &share)
{
  auto                                          &description = share.description;
  std::unordered_map<unsigned int, unsigned int> number;
  for (const unsigned int cell : cells)
    {
      const auto &coarse = whole.coarse.cells[cell];
      add_cell(cell, coarse.material_id, whole.rank[cell], description);
      if (whole.rank[cell] == rank)
        share.parts.push_back(whole.part[cell]);
      description.coarse_cells.back().vertices = coarse.vertices;
      for (unsigned int &vertex : description.coarse_cells.back().vertices)
        {
          const auto [found, is_new] =
            number.emplace(vertex, description.coarse_cell_vertices.size());
          if (is_new)
            description.coarse_cell_vertices.push_back(whole.coarse.vertices[vertex]);
          vertex = found->second;
        }
      const auto &boundaries = whole.neighbourhood.boundaries[cell];
      description.cell_infos[0].back().boundary_ids.assign(boundaries.begin(), boundaries.end());
    }
}

/// Return the excerpt of a body with the given @p cells of all bodies. The mesh of a file has one
/// cell per block.
template <int dim>
geometry::BlockMesh<dim> excerpt_of(const Forest<dim>               &forest,
                                    const unsigned int               body,
                                    const std::vector<unsigned int> &cells)
{
  const auto               &first = forest.coarse().first_cell;
  std::vector<unsigned int> blocks;
  for (auto cell = std::lower_bound(cells.begin(), cells.end(), first[body]);
       cell != cells.end() && *cell < first[body + 1]; ++cell)
    blocks.push_back(*cell - first[body]);
  return geometry::excerpt(*forest.bodies()[body].imported->template blocks<dim>(), blocks);
}
} // namespace

template <int dim>
LocalCells<dim> distribute_coarse(const Forest<dim>            &forest,
                                  const QuadraticElements<dim> &elements,
                                  const TearingParameters      &parameters,
                                  const CellsPerSubdomain      &by_size,
                                  dealii::parallel::fullydistributed::Triangulation<dim> &result)
{
  const MPI_Comm                communicator = forest.communicator();
  const unsigned int            my_rank = dealii::Utilities::MPI::this_mpi_process(communicator);
  std::optional<WholeMesh<dim>> whole;
  // A formula of a boundary may fail.
  throw_collectively(communicator, [&]() {
    if (my_rank == 0)
      whole.emplace(forest.coarse());
  });
  decide_places(forest, whole ? &*whole : nullptr, elements, parameters, by_size);
  std::vector<std::vector<unsigned int>> cells;
  if (whole)
    cells = relevant_cells(*whole, dealii::Utilities::MPI::n_mpi_processes(communicator));
  auto share             = scatter<Share<dim>>(communicator, [&](const unsigned int rank) {
    Share<dim> of_rank{coarse_description(result), {}, elements.of_cells(cells[rank]), {}};
    describe(*whole, cells[rank], rank, of_rank);
    if (rank != 0)
      for (const unsigned int body : forest.bodies_of_rank_0())
        of_rank.excerpts.push_back(excerpt_of(forest, body, cells[rank]));
    return of_rank;
  });
  share.description.comm = communicator;
  result.create_triangulation(share.description);
  auto geometries = std::make_shared<Geometries<dim>>(*forest.geometries());
  for (unsigned int i = 0; i < share.excerpts.size(); ++i)
    {
      const unsigned int body       = forest.bodies_of_rank_0()[i];
      auto               parameters = forest.bodies()[body];
      parameters.imported = parameters.imported->with_blocks(std::move(share.excerpts[i]));
      (*geometries)[body] = geometry::make_geometry<dim>(parameters);
    }
  return {std::move(share.parts), std::move(share.elements), geometries};
}

#define SNUG_INSTANTIATE(dim)                                                       \
  template LocalCells<dim> distribute_coarse(                                       \
    const Forest<dim> &, const QuadraticElements<dim> &, const TearingParameters &, \
    const CellsPerSubdomain &, dealii::parallel::fullydistributed::Triangulation<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mesh
