#include <snug/mesh/parts.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace snug::mesh {
namespace {
/// Return the numbers of cells of the parts on all ranks. Collective.
std::vector<unsigned long> cells_of_parts(const Partition &partition, MPI_Comm communicator)
{
  std::vector<unsigned long> cells(partition.n_parts, 0);
  for (const unsigned int part : partition.part)
    ++cells[part];
  dealii::Utilities::MPI::sum(cells, communicator, cells);
  return cells;
}

/// Return the number of parts that have cells.
unsigned int n_filled(const Parts &parts)
{
  unsigned int n = 0;
  for (const auto &body : parts.cells)
    n += body.size() - std::count(body.begin(), body.end(), 0ul);
  return n;
}

/// Return whether parts are cubes of cells that are nearly cubic, except for at most 10 percent
/// of the cells.
bool makes_cubes(const CellsOfBody &body, const std::string &method)
{
  const double few = 0.1;
  return body.layered && method != "METIS" && body.n_slender <= few * body.n_global;
}

/// Return the mean number of unknowns of the cells divided by that of a cell of no element, rounded
/// so that the order of the sum does not matter. Collective.
template <int dim>
double work_per_cell(const CellSet<dim> &set)
{
  double work = 0.;
  for (const auto &place : set.places)
    work += place.second;
  work = dealii::Utilities::MPI::sum(work, set.communicator) / set.n_global;
  return std::round(1e6 * work) / 1e6;
}
} // namespace

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

double larger_subdomains(const unsigned int dim)
{
  return dim == 3 ? 8. : 1.;
}

/// Slabs may be empty, so the parts with cells are counted instead of computed.
void make_parts(const unsigned int                                               dim,
                const std::vector<CellsOfBody>                                  &bodies,
                const TearingParameters                                         &parameters,
                const CellsPerSubdomain                                         &by_size,
                const unsigned int                                               n_ranks,
                const std::function<unsigned long(const std::vector<double> &)> &make)
{
  unsigned long n_cells = 0;
  for (const auto &body : bodies)
    n_cells += body.n_global;
  std::vector<double> cells_each;
  for (const auto &body : bodies)
    if (parameters.subdomains == 0)
      cells_each.push_back(makes_cubes(body, parameters.method) ? by_size.compact
                                                                : by_size.other / body.work);
    else
      cells_each.push_back(std::max(1., double(n_cells) / parameters.subdomains));
  if (parameters.subdomains == 0)
    for (unsigned int body = 0; body < parameters.nearly_incompressible.size(); ++body)
      if (parameters.nearly_incompressible[body])
        cells_each[body] *= larger_subdomains(dim);
  const unsigned long least =
    parameters.at_least_ranks ? std::min<unsigned long>(n_cells, n_ranks) : 1;
  while (make(cells_each) < least)
    {
      for (double &cells : cells_each)
        cells /= 2.;
      if (cells_each.front() <= 0.1)
        break;
    }
}

template <int dim>
Parts decide_parts(const std::vector<CellSet<dim>> &sets,
                   const TearingParameters         &parameters,
                   const CellsPerSubdomain         &by_size)
{
  const MPI_Comm           communicator = sets.front().communicator;
  std::vector<CellsOfBody> bodies;
  for (const auto &set : sets)
    bodies.push_back({set.n_global, set.n_slender, set.layered, work_per_cell(set)});
  Parts parts;
  make_parts(dim, bodies, parameters, by_size,
             dealii::Utilities::MPI::n_mpi_processes(communicator),
             [&](const std::vector<double> &cells_each) {
               parts = {partitions(parameters.method, sets, cells_each), {}};
               for (const auto &partition : parts.of_body)
                 parts.cells.push_back(cells_of_parts(partition, communicator));
               return n_filled(parts);
             });
  return parts;
}

/// The cells of the body are arranged on a line, on which each rank has a section that ends at end.
/// A part is assigned to the rank whose section contains the middle of the part.
std::vector<unsigned int>
RankRuns::next_body(const unsigned int                                n_parts,
                    const std::function<unsigned long(unsigned int)> &cells_before)
{
  const unsigned int n_ranks = load.size();
  const double       own     = cells_before(n_parts);
  all += own;
  std::vector<double> share;
  for (const double has : load)
    // number of cells that the rank lacks for an equal share of all bodies so far
    share.push_back(std::max(0., all / n_ranks - has));
  const double              shares = std::accumulate(share.begin(), share.end(), 0.);
  std::vector<unsigned int> first  = {0};
  double                    end    = 0.;
  for (unsigned int rank = 0; rank < n_ranks; ++rank)
    {
      end += share[rank] * own / shares;
      unsigned int low = first.back(), high = n_parts;
      while (low < high)
        {
          const unsigned int  part   = low + (high - low) / 2;
          const unsigned long before = cells_before(part);
          if (rank + 1 < n_ranks && before + 0.5 * (cells_before(part + 1) - before) > end)
            high = part;
          else
            low = part + 1;
        }
      load[rank] += cells_before(low) - cells_before(first.back());
      first.push_back(low);
    }
  return first;
}

std::vector<std::vector<unsigned int>>
ranks_of_parts(const std::vector<std::vector<unsigned long>> &cells, unsigned int n_ranks)
{
  std::vector<std::vector<unsigned int>> ranks;
  RankRuns                               runs(n_ranks);
  for (const auto &body : cells)
    {
      std::vector<unsigned long> before(1, 0);
      for (const unsigned long part : body)
        before.push_back(before.back() + part);
      const auto first = runs.next_body(body.size(), [&](unsigned int p) { return before[p]; });
      ranks.emplace_back();
      for (unsigned int rank = 0; rank < n_ranks; ++rank)
        ranks.back().resize(first[rank + 1], rank);
    }
  return ranks;
}

template Parts
decide_parts(const std::vector<CellSet<2>> &, const TearingParameters &, const CellsPerSubdomain &);
template Parts
decide_parts(const std::vector<CellSet<3>> &, const TearingParameters &, const CellsPerSubdomain &);
} // namespace snug::mesh
