#include <snug/base/narrow.h>
#include <snug/mesh/partition.h>

#include <deal.II/base/mpi.h>

#include <metis.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

namespace snug::mesh {
namespace {
/// All ranks' entries, rank after rank; nothing on other ranks.
template <typename T>
std::vector<T> on_rank_0(MPI_Comm communicator, const std::vector<T> &values)
{
  std::vector<T> all;
  for (const auto &of_rank : dealii::Utilities::MPI::gather(communicator, values))
    all.insert(all.end(), of_rank.begin(), of_rank.end());
  return all;
}

/// The graph with the areas of the faces.
using FaceAreas = std::vector<std::vector<std::pair<unsigned int, double>>>;

FaceAreas face_areas(const std::vector<unsigned int> &cells,
                     const CellPairs                 &pairs,
                     const std::vector<double>       &areas)
{
  std::unordered_map<unsigned int, unsigned int> place;
  for (unsigned int i = 0; i < cells.size(); ++i)
    place[cells[i]] = i;
  FaceAreas result(cells.size());
  for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      const unsigned int a = place.at(pairs[p][0]), b = place.at(pairs[p][1]);
      result[a].emplace_back(b, areas[p]);
      result[b].emplace_back(a, areas[p]);
    }
  // pairs come rank by rank
  for (auto &of_cell : result)
    std::sort(of_cell.begin(), of_cell.end());
  return result;
}

/// Areas as METIS takes them, integers that are usual_weight on average.
idx_t weight(const double area, const double mean)
{
  // METIS sums them in 32 bits: enough for 10 million cells.
  const double usual_weight = 30., largest = 1e5;
  return narrow<idx_t>(std::lround(std::clamp(usual_weight * area / mean, 1., largest)));
}

/// METIS is deterministic: equal graphs, numbered alike, give equal parts.
std::vector<unsigned int> metis_parts(const FaceAreas &graph, unsigned int n_parts)
{
  std::vector<unsigned int> part(graph.size(), 0);
  if (n_parts <= 1)
    return part;
  if (n_parts >= graph.size())
    {
      std::iota(part.begin(), part.end(), 0);
      return part;
    }
  // Not through deal.II's SparsityTools: the diagonal that its square patterns store reaches METIS
  // as loops, and worsens the cuts by up to a fifth.
  std::vector<idx_t> start(1, 0), neighbours, weights, parts(graph.size());
  double             mean = 0.;
  for (const auto &of_cell : graph)
    {
      for (const auto &[neighbour, area] : of_cell)
        {
          neighbours.push_back(narrow<idx_t>(neighbour));
          mean += area;
        }
      start.push_back(narrow<idx_t>(neighbours.size()));
    }
  mean /= double(neighbours.size());
  for (const auto &of_cell : graph)
    for (const auto &face : of_cell)
      weights.push_back(weight(face.second, mean));
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  idx_t n = narrow<idx_t>(graph.size()), k = n_parts, one = 1, cut = 0;
  // The methods METIS recommends for few and for many parts.
  const auto method = k <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  if (method(&n, &one, start.data(), neighbours.data(), nullptr, nullptr, weights.data(), &k,
             nullptr, nullptr, options, &cut, parts.data()) != METIS_OK)
    throw std::runtime_error("METIS could not partition the cells");
  part.assign(parts.begin(), parts.end());
  return part;
}

/// The positions of @p keys in ascending order.
template <typename Key>
std::vector<unsigned int> sorted_order(const std::vector<Key> &keys)
{
  std::vector<unsigned int> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](unsigned int a, unsigned int b) { return keys[a] < keys[b]; });
  return order;
}

/// Connected parts without slivers.
std::vector<unsigned int>
parts_of_graph(const CellGraph &graph, const FaceAreas &areas, double cells_each)
{
  const unsigned int n_parts = std::max(1l, std::lround(graph.size() / cells_each));
  auto               part    = metis_parts(areas, n_parts);
  // METIS balances numbers of cells, but leaves parts in pieces; a piece of a few cells would be a
  // subdomain with a factorization and kernel of its own.
  merge_slivers(graph, part, split_into_pieces(graph, part), cells_each);
  return part;
}
} // namespace

template <int dim>
Partition graph_partition(const CellSet<dim> &set, double cells_each)
{
  const auto               &comm       = set.communicator;
  const unsigned int        rank       = dealii::Utilities::MPI::this_mpi_process(comm);
  const auto                keys       = on_rank_0(comm, set.keys);
  const auto                numbers    = on_rank_0(comm, set.numbers);
  const auto                neighbours = on_rank_0(comm, set.neighbours);
  const auto                areas      = on_rank_0(comm, set.areas);
  std::vector<unsigned int> parts(keys.size());
  if (rank == 0)
    {
      // The gathered order depends on the number of ranks, that by keys does not.
      const auto                order = sorted_order(keys);
      std::vector<unsigned int> cells;
      for (const unsigned int i : order)
        cells.push_back(numbers[i]);
      const auto sorted_parts = parts_of_graph(cell_graph(cells, neighbours),
                                               face_areas(cells, neighbours, areas), cells_each);
      for (unsigned int i = 0; i < order.size(); ++i)
        parts[order[i]] = sorted_parts[i];
    }
  // all parts to all ranks: an integer per cell, where a scatter would need counts
  parts = dealii::Utilities::MPI::broadcast(comm, parts);
  const auto counts =
    dealii::Utilities::MPI::all_gather(comm, static_cast<unsigned int>(set.numbers.size()));
  // this rank's range, as on_rank_0() has joined them
  const auto first = parts.begin() + std::accumulate(counts.begin(), counts.begin() + rank, 0u);
  Partition  result;
  result.part.assign(first, first + counts[rank]);
  result.n_parts = *std::max_element(parts.begin(), parts.end()) + 1;
  return result;
}

template Partition graph_partition(const CellSet<2> &, double);
template Partition graph_partition(const CellSet<3> &, double);
} // namespace snug::mesh
