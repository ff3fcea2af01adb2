#include <snug/base/deal_ii_compat.h>
#include <snug/mesh/distribute.h>

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

/// {level and coarse cell, path of children}
///
/// Each level adds dim bits to the path, so 64 bits are enough for 21 levels in 3D.
template <int dim>
typename CellSet<dim>::Key key(const typename Refined<dim>::active_cell_iterator &cell)
{
  std::uint64_t path   = 0;
  auto          parent = typename Refined<dim>::cell_iterator(cell);
  const auto    level  = static_cast<std::uint64_t>(cell->level());
  // Named, as its children are a view into it.
  const dealii::CellId id = cell->id();
  for (const auto child : id.get_child_indices())
    path = path << dim | static_cast<unsigned int>(child);
  while (parent->level() > 0)
    parent = parent->parent();
  return {{level << 32 | static_cast<unsigned int>(parent->index()), path}};
}

/// From one face's centre to that of the opposite one.
template <int dim>
using CellAxes = std::array<dealii::Tensor<1, dim>, dim>;

template <int dim>
CellAxes<dim> axes_of(const geometry::BodyGeometry<dim> &geometry,
                      const geometry::CoarseCells<dim>  &coarse,
                      const dealii::CellId              &cell)
{
  CellAxes<dim> axes;
  for (unsigned int d = 0; d < dim; ++d)
    {
      auto low = geometry::unit_centre<dim>(), high = low;
      low[d]  = 0.;
      high[d] = 1.;
      axes[d] =
        geometry.position(coarse.point(cell, high)) - geometry.position(coarse.point(cell, low));
    }
  return axes;
}

/// Of the cell's section across an axis.
double area_across(const CellAxes<2> &axes, const unsigned int axis)
{
  return axes[1 - axis].norm();
}

double area_across(const CellAxes<3> &axes, const unsigned int axis)
{
  return dealii::cross_product_3d(axes[(axis + 1) % 3], axes[(axis + 2) % 3]).norm();
}

template <int dim>
bool is_slender(const CellAxes<dim> &axes)
{
  std::vector<double> lengths;
  for (const auto &axis : axes)
    lengths.push_back(axis.norm());
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  return *longest > compact_aspect * *shortest;
}

/// Whether the body is refined evenly, so that its cells lie in layers. Collective.
template <int dim>
bool has_one_level(unsigned int body, const Refined<dim> &refined)
{
  // -(smallest) is the largest of -level: one reduction does for both
  int levels[2] = {-1, -100}; // largest, and smallest with a minus
  for (const auto &cell : refined.active_cell_iterators())
    if (cell->is_locally_owned() && cell->material_id() == body)
      {
        levels[0] = std::max(levels[0], cell->level());
        levels[1] = std::max(levels[1], -cell->level());
      }
  MPI_Allreduce(MPI_IN_PLACE, levels, 2, MPI_INT, MPI_MAX, deal_ii_compat::communicator(refined));
  return levels[0] == -levels[1];
}

/// The owned cells of a body in the order of active cells. Collective.
template <int dim>
CellSet<dim> cell_set(const geometry::BodyGeometry<dim> &geometry,
                      unsigned int                       body,
                      const geometry::CoarseCells<dim>  &coarse,
                      const Refined<dim>                &refined)
{
  CellSet<dim> set;
  set.communicator        = deal_ii_compat::communicator(refined);
  set.size                = geometry.extent();
  unsigned long n_slender = 0;
  for (const auto &cell : refined.active_cell_iterators())
    if (cell->is_locally_owned() && cell->material_id() == body)
      {
        const unsigned int number = cell->global_active_cell_index();
        set.centres.push_back(
          geometry.logical(coarse.point(cell->id(), geometry::unit_centre<dim>())));
        set.numbers.push_back(number);
        set.keys.push_back(key<dim>(cell));
        const auto axes = axes_of(geometry, coarse, cell->id());
        n_slender += is_slender<dim>(axes);
        for (const unsigned int f : cell->face_indices())
          if (!cell->at_boundary(f) && cell->neighbor(f)->is_active())
            {
              const unsigned int other = cell->neighbor(f)->global_active_cell_index();
              // One side enters the pair: of equal cells the one with the smaller number, else the
              // finer one. The other may belong to another rank.
              if (number < other || cell->neighbor_is_coarser(f))
                {
                  set.neighbours.push_back({{number, other}});
                  set.areas.push_back(area_across(axes, f / 2));
                }
            }
      }
  set.n_global  = dealii::Utilities::MPI::sum<unsigned long>(set.centres.size(), set.communicator);
  set.n_slender = dealii::Utilities::MPI::sum(n_slender, set.communicator);
  set.layered   = geometry.has_grid() && has_one_level(body, refined);
  return set;
}

/// Numbers of cells of the parts, of all ranks. Collective.
std::vector<unsigned long> cells_of_parts(const Partition &partition, MPI_Comm communicator)
{
  std::vector<unsigned long> cells(partition.n_parts, 0);
  for (const unsigned int part : partition.part)
    ++cells[part];
  dealii::Utilities::MPI::sum(cells, communicator, cells);
  return cells;
}

/// Parts of each body, and their numbers of cells on all ranks together.
struct Parts
{
  std::vector<Partition>                  of_body;
  std::vector<std::vector<unsigned long>> cells;

  unsigned int n_filled() const
  {
    unsigned int n = 0;
    for (const auto &body : cells)
      n += body.size() - std::count(body.begin(), body.end(), 0ul);
    return n;
  }
};

/// Whether parts are cubes of nearly cubic cells, but for some.
template <int dim>
bool makes_cubes(const CellSet<dim> &set, const std::string &method)
{
  const double few = 0.1;
  return set.layered && method != "METIS" && set.n_slender <= few * set.n_global;
}

/// Parts are halved until every rank can have one; slabs may be empty, so the numbers are counted
/// rather than computed. Collective.
template <int dim>
Parts decide_parts(const std::vector<CellSet<dim>> &sets,
                   const TearingParameters         &parameters,
                   const CellsPerSubdomain         &by_size)
{
  const MPI_Comm communicator = sets.front().communicator;
  unsigned long  n_cells      = 0;
  for (const auto &set : sets)
    n_cells += set.n_global;
  const auto         &partition = choose(partition_table<dim>(), parameters.method).make;
  std::vector<double> cells_each;
  for (const auto &set : sets)
    if (parameters.subdomains == 0)
      cells_each.push_back(makes_cubes(set, parameters.method) ? by_size.compact : by_size.other);
    else
      cells_each.push_back(std::max(1., double(n_cells) / parameters.subdomains));
  const unsigned long least =
    parameters.at_least_ranks
      ? std::min<unsigned long>(n_cells, dealii::Utilities::MPI::n_mpi_processes(communicator))
      : 1;
  Parts parts;
  do
    {
      parts = Parts();
      for (unsigned int body = 0; body < sets.size(); ++body)
        {
          parts.of_body.push_back(partition(sets[body], cells_each[body]));
          parts.cells.push_back(cells_of_parts(parts.of_body.back(), communicator));
          cells_each[body] /= 2.;
        }
  } while (parts.n_filled() < least && cells_each.front() > 0.1);
  return parts;
}

/// The same description on every run: deal.II lists coarse cells in the
/// order in which other ranks' messages arrive.
template <int dim>
void order_coarse_cells(const Refined<dim>                                      &refined,
                        dealii::TriangulationDescription::Description<dim, dim> &description)
{
  auto &ids = description.coarse_cell_index_to_coarse_cell_id;
  std::map<dealii::types::coarse_cell_id, unsigned int> index;
  for (const auto &cell : refined.cell_iterators_on_level(0))
    index[cell->id().get_coarse_cell_id()] = cell->index();
  std::vector<unsigned int> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](unsigned a, unsigned b) { return index[ids[a]] < index[ids[b]]; });
  const auto old = description;
  for (unsigned int i = 0; i < order.size(); ++i)
    {
      description.coarse_cells[i] = old.coarse_cells[order[i]];
      ids[i]                      = old.coarse_cell_index_to_coarse_cell_id[order[i]];
    }
}
/// A cell and its part, as ranks send it.
using CellPart = std::pair<dealii::CellId::binary_type, unsigned int>;

/// Parts of the owned cells of @p result, which other ranks have sent.
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

std::vector<std::vector<unsigned int>>
ranks_of_parts(const std::vector<std::vector<unsigned long>> &cells, unsigned int n_ranks)
{
  std::vector<std::vector<unsigned int>> ranks;
  std::vector<double>                    load(n_ranks, 0.);
  double                                 all = 0.;
  for (const auto &body : cells)
    {
      const double own = std::accumulate(body.begin(), body.end(), 0.);
      all += own;
      std::vector<double> share;
      for (const double has : load)
        // what the rank lacks for an equal share of all bodies so far
        share.push_back(std::max(0., all / n_ranks - has));
      const double shares = std::accumulate(share.begin(), share.end(), 0.);
      unsigned int rank   = 0;
      // The body's cells on a line: a part takes [before, before + part], and goes to the rank
      // whose section, up to end, has the middle of that.
      double end = share[0] * own / shares, before = 0.;
      ranks.emplace_back();
      for (const unsigned long part : body)
        {
          while (before + 0.5 * part > end && rank + 1 < n_ranks)
            end += share[++rank] * own / shares;
          before += part;
          load[rank] += part;
          ranks.back().push_back(rank);
        }
    }
  return ranks;
}

CellsPerSubdomain cells_per_subdomain(const unsigned int  dim,
                                      const unsigned int  degree,
                                      const Idealization &idealization)
{
  const auto cells = [&](const double edge) { return std::pow(edge / degree, dim); };
  if (idealization.is_axisymmetric())
    return {cells(64.), cells(64.)};
  return dim == 3 ? CellsPerSubdomain{cells(5.), cells(6.3)}
                  : CellsPerSubdomain{cells(12.), cells(14.)};
}

template <int dim>
std::vector<unsigned int> distribute(const Geometries<dim>   &geometries,
                                     const TearingParameters &parameters,
                                     const CellsPerSubdomain &by_size,
                                     const Refined<dim>      &refined,
                                     dealii::parallel::fullydistributed::Triangulation<dim> &result)
{
  const geometry::CoarseCells<dim> coarse(refined);
  std::vector<CellSet<dim>>        sets;
  for (unsigned int body = 0; body < geometries.size(); ++body)
    sets.push_back(cell_set(*geometries[body], body, coarse, refined));
  const Parts parts = decide_parts(sets, parameters, by_size);
  const auto  ranks =
    ranks_of_parts(parts.cells,
                   dealii::Utilities::MPI::n_mpi_processes(deal_ii_compat::communicator(refined)));
  // cell sets have the owned cells of a body in the order of this loop
  std::vector<unsigned int>                          next(geometries.size(), 0);
  dealii::LinearAlgebra::distributed::Vector<double> rank_of_cell(
    refined.global_active_cell_index_partitioner().lock());
  std::map<unsigned int, std::vector<CellPart>> sent;
  for (const auto &cell : refined.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const unsigned int body                        = cell->material_id();
        const unsigned int part                        = parts.of_body[body].part[next[body]++];
        const unsigned int rank                        = ranks[body][part];
        rank_of_cell[cell->global_active_cell_index()] = rank;
        // Parts travel apart from the description, which has no room for them.
        sent[rank].push_back({cell->id().template to_binary<dim>(), part});
      }
  // Takes the ranks as a vector of doubles, which are exact for them.
  auto description =
    dealii::TriangulationDescription::Utilities::create_description_from_triangulation(
      refined, rank_of_cell);
  order_coarse_cells(refined, description);
  result.create_triangulation(description);
  return received_parts(result, sent);
}

#define SNUG_INSTANTIATE(dim)                                                      \
  template std::vector<unsigned int> distribute(                                   \
    const Geometries<dim> &, const TearingParameters &, const CellsPerSubdomain &, \
    const dealii::parallel::distributed::Triangulation<dim> &,                     \
    dealii::parallel::fullydistributed::Triangulation<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mesh
