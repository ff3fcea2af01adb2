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
template <int dim>
bool makes_cubes(const CellSet<dim> &set, const std::string &method)
{
  const double few = 0.1;
  return set.layered && method != "METIS" && set.n_slender <= few * set.n_global;
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

/// The sizes of parts are halved until every rank can have a part. Slabs may be empty, so the parts
/// with cells are counted instead of computed. Collective.
template <int dim>
Parts decide_parts(const std::vector<CellSet<dim>> &sets,
                   const TearingParameters         &parameters,
                   const CellsPerSubdomain         &by_size)
{
  const MPI_Comm communicator = sets.front().communicator;
  unsigned long  n_cells      = 0;
  for (const auto &set : sets)
    n_cells += set.n_global;
  std::vector<double> cells_each;
  for (const auto &set : sets)
    if (parameters.subdomains == 0)
      cells_each.push_back(
        makes_cubes(set, parameters.method) ? by_size.compact : by_size.other / work_per_cell(set));
    else
      cells_each.push_back(std::max(1., double(n_cells) / parameters.subdomains));
  if (parameters.subdomains == 0)
    for (unsigned int body = 0; body < parameters.nearly_incompressible.size(); ++body)
      if (parameters.nearly_incompressible[body])
        cells_each[body] *= larger_subdomains(dim);
  const unsigned long least =
    parameters.at_least_ranks
      ? std::min<unsigned long>(n_cells, dealii::Utilities::MPI::n_mpi_processes(communicator))
      : 1;
  Parts parts;
  do
    {
      parts = {partitions(parameters.method, sets, cells_each), {}};
      for (unsigned int body = 0; body < sets.size(); ++body)
        {
          parts.cells.push_back(cells_of_parts(parts.of_body[body], communicator));
          cells_each[body] /= 2.;
        }
  } while (n_filled(parts) < least && cells_each.front() > 0.1);
  return parts;
}

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
        // number of cells that the rank lacks for an equal share of all bodies so far
        share.push_back(std::max(0., all / n_ranks - has));
      const double shares = std::accumulate(share.begin(), share.end(), 0.);
      unsigned int rank   = 0;
      // The cells of the body are arranged on a line, on which each rank has a section that ends
      // at end. A part occupies [before, before + part], and is assigned to the rank whose section
      // contains the middle of this interval.
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

template Parts
decide_parts(const std::vector<CellSet<2>> &, const TearingParameters &, const CellsPerSubdomain &);
template Parts
decide_parts(const std::vector<CellSet<3>> &, const TearingParameters &, const CellsPerSubdomain &);
} // namespace snug::mesh
