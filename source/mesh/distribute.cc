#include <snug/base/deal_ii_compat.h>
#include <snug/mesh/cell_shape.h>
#include <snug/mesh/distribute.h>
#include <snug/mesh/parts.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/tria_description.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace snug::mesh {
namespace {
template <int dim>
using Refined = dealii::parallel::distributed::Triangulation<dim>;

template <int dim>
using BodyCells = std::vector<typename Refined<dim>::active_cell_iterator>;

/// Return the key {level and coarse cell, path of children} of a cell.
///
/// Each level adds dim bits to the path, so 64 bits suffice for 21 levels in 3D.
template <int dim>
typename CellSet<dim>::Key key(const dealii::CellId &cell)
{
  std::uint64_t path     = 0;
  const auto    children = cell.get_child_indices();
  for (const auto child : children)
    path = path << dim | static_cast<unsigned int>(child);
  return {{std::uint64_t(children.size()) << 32 | cell.get_coarse_cell_id(), path}};
}

/// Return the owned cells of each body in the order of the space-filling curve of p4est. Over all
/// ranks, this order depends neither on the number of ranks nor on the steps of refinement.
template <int dim>
std::vector<BodyCells<dim>> owned_cells(const Refined<dim> &refined, const unsigned int n_bodies)
{
  std::vector<BodyCells<dim>> cells(n_bodies);
  for (const auto &cell : refined.active_cell_iterators())
    if (cell->is_locally_owned())
      cells[cell->material_id()].push_back(cell);
  for (auto &of_body : cells)
    std::sort(of_body.begin(), of_body.end(),
              [](const auto &a, const auto &b) { return a->id() < b->id(); });
  return cells;
}

/// Return whether all cells of a body have the same level, so that the cells lie in layers.
/// Collective.
template <int dim>
bool has_one_level(const BodyCells<dim> &cells, const MPI_Comm communicator)
{
  // The maximum of -level is minus the minimum level, so one reduction finds both.
  int levels[2] = {-1, -100}; // maximum level, and minus the minimum level
  for (const auto &cell : cells)
    {
      levels[0] = std::max(levels[0], cell->level());
      levels[1] = std::max(levels[1], -cell->level());
    }
  MPI_Allreduce(MPI_IN_PLACE, levels, 2, MPI_INT, MPI_MAX, communicator);
  return levels[0] == -levels[1];
}

template <int dim>
std::vector<CellShape<dim>> shapes_of(const CoarseMesh<dim> &coarse,
                                      const unsigned int     body,
                                      const PlacedIds<dim>  &ids,
                                      const BodyCells<dim>  &cells)
{
  std::vector<CellShape<dim>> shapes;
  for (const auto &cell : cells)
    shapes.emplace_back([&](const dealii::Point<dim> &unit) {
      return coarse.geometries[body]->position(coarse.places.point(ids.of(cell->id()), unit));
    });
  return shapes;
}

/// Return the set of the owned cells of a body. Collective.
template <int dim>
CellSet<dim> cell_set(const CoarseMesh<dim>             &coarse,
                      const QuadraticElements<dim>      &elements,
                      unsigned int                       body,
                      const std::vector<CellShape<dim>> &shapes,
                      const PlacedIds<dim>              &ids,
                      const BodyCells<dim>              &cells,
                      const MPI_Comm                     communicator)
{
  const auto  &geometry = *coarse.geometries[body];
  CellSet<dim> set;
  set.communicator = communicator;
  set.size         = geometry.extent();
  for (const auto &cell : cells)
    {
      const dealii::CellId id = ids.of(cell->id());
      set.add(elements.place(id), [&](const dealii::Point<dim> &unit) {
        return geometry.logical(coarse.places.point(id, unit));
      });
      set.numbers.push_back(cell->global_active_cell_index());
      set.keys.push_back(key<dim>(id));
      for (const unsigned int f : cell->face_indices())
        if (!cell->at_boundary(f) && cell->neighbor(f)->is_active())
          // Only one of the two cells adds the pair: the first cell if both are equal in size,
          // otherwise the finer cell. The other cell may belong to another rank.
          if (cell->id() < cell->neighbor(f)->id() || cell->neighbor_is_coarser(f))
            {
              const unsigned int other = cell->neighbor(f)->global_active_cell_index();
              set.neighbours.push_back({{set.numbers.back(), other}});
              set.areas.push_back(shapes[set.numbers.size() - 1].section(f / 2));
            }
    }
  set.n_global  = dealii::Utilities::MPI::sum<unsigned long>(set.centres.size(), set.communicator);
  set.n_slender = count_slender(shapes, set.communicator);
  set.layered   = geometry.grid() != nullptr && has_one_level<dim>(cells, communicator);
  return set;
}

/// Replace the cell ids of the forest by placed ids, and sort the coarse cells by these ids. The
/// sort makes the description reproducible, because deal.II lists coarse cells in the order in
/// which the messages of other ranks arrive.
template <int dim>
void order_coarse_cells(const PlacedIds<dim>                                    &ids,
                        dealii::TriangulationDescription::Description<dim, dim> &description)
{
  auto &coarse_ids = description.coarse_cell_index_to_coarse_cell_id;
  for (auto &id : coarse_ids)
    id = ids.of(dealii::CellId(id, {})).get_coarse_cell_id();
  for (auto &level : description.cell_infos)
    for (auto &cell : level)
      cell.id = ids.of(dealii::CellId(cell.id)).template to_binary<dim>();
  std::vector<unsigned int> order(coarse_ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](unsigned a, unsigned b) { return coarse_ids[a] < coarse_ids[b]; });
  const auto old = description;
  for (unsigned int i = 0; i < order.size(); ++i)
    {
      description.coarse_cells[i] = old.coarse_cells[order[i]];
      coarse_ids[i]               = old.coarse_cell_index_to_coarse_cell_id[order[i]];
    }
}

/// A cell and its part, in the form in which ranks send them.
using CellPart = std::pair<dealii::CellId::binary_type, unsigned int>;

/// Return the parts of the owned cells of @p result, which other ranks have sent.
template <int dim>
std::vector<unsigned int>
received_parts(const dealii::parallel::fullydistributed::Triangulation<dim> &result,
               const std::map<unsigned int, std::vector<CellPart>>          &sent)
{
  std::map<dealii::CellId::binary_type, unsigned int> part_of_cell;
  for (const auto &message :
       dealii::Utilities::MPI::some_to_some(deal_ii_compat::communicator(result), sent))
    for (const auto &cell : message.second)
      part_of_cell.insert(cell);
  std::vector<unsigned int> parts;
  for (const auto &cell : result.active_cell_iterators())
    if (cell->is_locally_owned())
      parts.push_back(part_of_cell.at(cell->id().template to_binary<dim>()));
  return parts;
}
} // namespace

template <int dim>
std::vector<unsigned int>
distribute_refined(const CoarseMesh<dim>                                  &coarse,
                   const QuadraticElements<dim>                           &elements,
                   const TearingParameters                                &parameters,
                   const CellsPerSubdomain                                &by_size,
                   const Refined<dim>                                     &refined,
                   dealii::parallel::fullydistributed::Triangulation<dim> &result)
{
  const MPI_Comm            communicator = deal_ii_compat::communicator(refined);
  const unsigned int        n_bodies     = coarse.geometries.size();
  const PlacedIds<dim>      ids(refined);
  const auto                cells = owned_cells<dim>(refined, n_bodies);
  std::vector<CellSet<dim>> sets;
  const auto shapes = shapes_of_bodies<dim>(n_bodies, communicator, [&](const unsigned int body) {
    return shapes_of(coarse, body, ids, cells[body]);
  });
  for (unsigned int body = 0; body < n_bodies; ++body)
    sets.push_back(cell_set(coarse, elements, body, shapes[body], ids, cells[body], communicator));
  const Parts parts = decide_parts(sets, parameters, by_size);
  const auto  ranks =
    ranks_of_parts(parts.cells, dealii::Utilities::MPI::n_mpi_processes(communicator));
  dealii::LinearAlgebra::distributed::Vector<double> rank_of_cell(
    refined.global_active_cell_index_partitioner().lock());
  std::map<unsigned int, std::vector<CellPart>> sent;
  for (unsigned int body = 0; body < n_bodies; ++body)
    for (unsigned int i = 0; i < cells[body].size(); ++i)
      {
        const auto        &cell                        = cells[body][i];
        const unsigned int part                        = parts.of_body[body].part[i];
        const unsigned int rank                        = ranks[body][part];
        rank_of_cell[cell->global_active_cell_index()] = rank;
        // Parts are sent separately, because the description cannot hold the parts.
        sent[rank].push_back({ids.of(cell->id()).template to_binary<dim>(), part});
      }
  // The function takes the ranks as a vector of doubles, which represent ranks exactly.
  auto description =
    dealii::TriangulationDescription::Utilities::create_description_from_triangulation(
      refined, rank_of_cell);
  order_coarse_cells(ids, description);
  result.create_triangulation(description);
  return received_parts(result, sent);
}

template <int dim>
LocalCells<dim> distribute(const Forest<dim>                                      &forest,
                           const QuadraticElements<dim>                           &elements,
                           const TearingParameters                                &parameters,
                           const CellsPerSubdomain                                &by_size,
                           dealii::parallel::fullydistributed::Triangulation<dim> &result)
{
  if (forest.triangulation())
    return {distribute_refined(forest.coarse(), elements, parameters, by_size,
                               *forest.triangulation(), result),
            elements, forest.geometries()};
  if (forest.are_grids() && choose(partition_table(), parameters.method).make(true))
    return {distribute_grids(*forest.geometries(), parameters, by_size, result), elements,
            forest.geometries()};
  return distribute_coarse(forest, elements, parameters, by_size, result);
}

#define SNUG_INSTANTIATE(dim)                                                               \
  template std::vector<unsigned int> distribute_refined(                                    \
    const CoarseMesh<dim> &, const QuadraticElements<dim> &, const TearingParameters &,     \
    const CellsPerSubdomain &, const dealii::parallel::distributed::Triangulation<dim> &,   \
    dealii::parallel::fullydistributed::Triangulation<dim> &);                              \
  template LocalCells<dim> distribute(const Forest<dim> &, const QuadraticElements<dim> &,  \
                                      const TearingParameters &, const CellsPerSubdomain &, \
                                      dealii::parallel::fullydistributed::Triangulation<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mesh
