#include <snug/base/deal_ii_compat.h>
#include <snug/base/gather.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/mesh/cell_shape.h>
#include <snug/mesh/coarse_description.h>
#include <snug/mesh/distribute.h>
#include <snug/mesh/parts.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

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

/// Return the first of @p n cells that a rank holds before the parts are decided.
unsigned int first_of_rank(const unsigned long n, const unsigned int rank, const MPI_Comm comm)
{
  return static_cast<unsigned int>(n * rank / dealii::Utilities::MPI::n_mpi_processes(comm));
}

/// Range of cells of a body that a rank holds before the parts are decided.
struct Run
{
  unsigned int begin, end;
};

template <int dim>
Run run_of(const CoarseMesh<dim> &coarse, const unsigned int body, const MPI_Comm communicator)
{
  const unsigned int  rank  = dealii::Utilities::MPI::this_mpi_process(communicator);
  const unsigned int  begin = coarse.first_cell[body];
  const unsigned long n     = coarse.first_cell[body + 1] - begin;
  return {begin + first_of_rank(n, rank, communicator),
          begin + first_of_rank(n, rank + 1, communicator)};
}

template <int dim>
std::vector<CellShape<dim>>
shapes_of(const CoarseMesh<dim> &coarse, const unsigned int body, const MPI_Comm communicator)
{
  const Run                   run = run_of(coarse, body, communicator);
  std::vector<CellShape<dim>> shapes;
  for (unsigned int cell = run.begin; cell < run.end; ++cell)
    shapes.emplace_back([&](const dealii::Point<dim> &unit) {
      return coarse.geometries[body]->position({cell - coarse.first_cell[body], unit});
    });
  return shapes;
}

/// Return the set of the cells of a body in the run of this rank. Collective.
template <int dim>
CellSet<dim> cell_set(const CoarseMesh<dim>             &coarse,
                      const QuadraticElements<dim>      &elements,
                      const unsigned int                 body,
                      const Neighbourhood<dim>          &neighbourhood,
                      const std::vector<CellShape<dim>> &shapes,
                      const MPI_Comm                     communicator)
{
  const auto        &geometry = *coarse.geometries[body];
  const unsigned int begin    = coarse.first_cell[body];
  const Run          run      = run_of(coarse, body, communicator);
  CellSet<dim>       set;
  set.communicator = communicator;
  set.n_global     = coarse.first_cell[body + 1] - begin;
  set.n_slender    = count_slender(shapes, communicator);
  set.size         = geometry.extent();
  set.layered      = geometry.grid() != nullptr;
  for (unsigned int cell = run.begin; cell < run.end; ++cell)
    {
      set.add(elements.place(dealii::CellId(cell, {})), [&](const dealii::Point<dim> &unit) {
        return geometry.logical({cell - begin, unit});
      });
      set.numbers.push_back(cell);
      set.keys.push_back({{cell, 0}});
    }
  for (std::size_t p = 0; p < neighbourhood.pairs.size(); ++p)
    if (const auto &pair = neighbourhood.pairs[p]; run.begin <= pair[0] && pair[0] < run.end)
      {
        set.neighbours.push_back(pair);
        set.areas.push_back(shapes[pair[0] - run.begin].section(neighbourhood.axes[p]));
      }
  return set;
}

/// Parts and ranks of all cells, equal on every rank.
struct Places
{
  std::vector<unsigned int> part, rank;
};

template <int dim>
Places decide_places(const CoarseMesh<dim>        &coarse,
                     const QuadraticElements<dim> &elements,
                     const Neighbourhood<dim>     &neighbourhood,
                     const TearingParameters      &parameters,
                     const CellsPerSubdomain      &by_size,
                     const MPI_Comm                communicator)
{
  std::vector<CellSet<dim>> sets;
  const auto                shapes =
    shapes_of_bodies<dim>(coarse.geometries.size(), communicator, [&](const unsigned int body) {
      return shapes_of(coarse, body, communicator);
    });
  for (unsigned int body = 0; body < coarse.geometries.size(); ++body)
    sets.push_back(cell_set(coarse, elements, body, neighbourhood, shapes[body], communicator));
  const Parts parts = decide_parts(sets, parameters, by_size);
  const auto  ranks =
    ranks_of_parts(parts.cells, dealii::Utilities::MPI::n_mpi_processes(communicator));
  Places places;
  for (unsigned int body = 0; body < sets.size(); ++body)
    for (const auto &of_rank : all_gather(communicator, parts.of_body[body].part))
      for (const unsigned int part : of_rank)
        {
          places.part.push_back(part);
          places.rank.push_back(ranks[body][part]);
        }
  return places;
}

/// Return the cells of @p rank and the cells that share a vertex with a cell of @p rank, which
/// deal.II needs as ghost cells.
template <int dim>
std::vector<unsigned int>
relevant_cells(const CoarseMesh<dim> &coarse, const Places &places, const unsigned int rank)
{
  std::vector<bool> at_owned(coarse.vertices.size(), false);
  for (unsigned int cell = 0; cell < coarse.cells.size(); ++cell)
    if (places.rank[cell] == rank)
      for (const unsigned int vertex : coarse.cells[cell].vertices)
        at_owned[vertex] = true;
  std::vector<unsigned int> result;
  for (unsigned int cell = 0; cell < coarse.cells.size(); ++cell)
    if (std::any_of(coarse.cells[cell].vertices.begin(), coarse.cells[cell].vertices.end(),
                    [&](const unsigned int vertex) { return at_owned[vertex]; }))
      result.push_back(cell);
  return result;
}
} // namespace

template <int dim>
std::vector<unsigned int> distribute(const CoarseMesh<dim>        &coarse,
                                     const QuadraticElements<dim> &elements,
                                     const TearingParameters      &parameters,
                                     const CellsPerSubdomain      &by_size,
                                     dealii::parallel::fullydistributed::Triangulation<dim> &result)
{
  const MPI_Comm           communicator = deal_ii_compat::communicator(result);
  const Neighbourhood<dim> neighbourhood(coarse);
  const Places             places =
    decide_places(coarse, elements, neighbourhood, parameters, by_size, communicator);
  auto                      description = coarse_description(result);
  const unsigned int        none        = static_cast<unsigned int>(-1);
  std::vector<unsigned int> number(coarse.vertices.size(), none);
  for (const unsigned int cell :
       relevant_cells(coarse, places, dealii::Utilities::MPI::this_mpi_process(communicator)))
    {
      add_cell(cell, coarse.cells[cell].material_id, places.rank[cell], description);
      description.coarse_cells.back().vertices = coarse.cells[cell].vertices;
      for (unsigned int &vertex : description.coarse_cells.back().vertices)
        {
          if (number[vertex] == none)
            {
              number[vertex] = description.coarse_cell_vertices.size();
              description.coarse_cell_vertices.push_back(coarse.vertices[vertex]);
            }
          vertex = number[vertex];
        }
      const auto &boundaries = neighbourhood.boundaries[cell];
      description.cell_infos[0].back().boundary_ids.assign(boundaries.begin(), boundaries.end());
    }
  result.create_triangulation(description);
  std::vector<unsigned int> parts;
  for (const auto &cell : result.active_cell_iterators())
    if (cell->is_locally_owned())
      parts.push_back(places.part[cell->id().get_coarse_cell_id()]);
  return parts;
}

#define SNUG_INSTANTIATE(dim)                                                           \
  template std::vector<unsigned int> distribute(                                        \
    const CoarseMesh<dim> &, const QuadraticElements<dim> &, const TearingParameters &, \
    const CellsPerSubdomain &, dealii::parallel::fullydistributed::Triangulation<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mesh
