#include <snug/base/blocked_signals.h>
#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/mesh/partition.h>

#include <deal.II/base/mpi.h>

#include <metis.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

namespace snug::mesh {
using geometry::no_element;

namespace {
/// Return the entries of all ranks on rank @p root, rank after rank, and nothing on other ranks.
template <typename T>
std::vector<T> on_rank(const unsigned int root, MPI_Comm communicator, const std::vector<T> &values)
{
  std::vector<T> all;
  for (const auto &of_rank : gather(communicator, values, root))
    all.insert(all.end(), of_rank.begin(), of_rank.end());
  return all;
}

/// The cell graph with the areas of the shared faces.
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
  // The pairs are listed rank by rank, so the neighbours of each cell are sorted.
  for (auto &of_cell : result)
    std::sort(of_cell.begin(), of_cell.end());
  return result;
}

/// Return an area as an integer edge weight for METIS. The average weight is usual_weight.
idx_t weight(const double area, const double mean)
{
  // METIS sums the weights in 32 bits, which suffices for 10 million cells.
  const double usual_weight = 30., largest = 1e5;
  return narrow<idx_t>(std::lround(std::clamp(usual_weight * area / mean, 1., largest)));
}

/// A graph whose vertices are whole elements and the cells that belong to none.
struct ElementGraph
{
  FaceAreas                 areas;
  std::vector<unsigned int> vertex; ///< of each cell
  /// work of each vertex for METIS; empty if all vertices are cells
  std::vector<idx_t> work;
};

/// Contract the cells of each element to one vertex. Vertices are in the order of their first
/// cells.
ElementGraph contracted(const FaceAreas &cells, const std::vector<CellPlace> &places)
{
  const double                                   unit = 10.; // work of a cell without an element
  ElementGraph                                   graph;
  std::unordered_map<unsigned int, unsigned int> of_element;
  std::vector<double>                            work;
  for (const auto &[element, of_cell] : places)
    {
      const unsigned int next = work.size();
      graph.vertex.push_back(
        element == no_element ? next : of_element.emplace(element, next).first->second);
      work.resize(std::max<std::size_t>(next, graph.vertex.back() + 1), 0.);
      work[graph.vertex.back()] += of_cell;
    }
  std::vector<std::map<unsigned int, double>> sums(work.size());
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    for (const auto &[neighbour, area] : cells[cell])
      if (graph.vertex[neighbour] != graph.vertex[cell])
        sums[graph.vertex[cell]][graph.vertex[neighbour]] += area;
  for (const auto &of_vertex : sums)
    graph.areas.emplace_back(of_vertex.begin(), of_vertex.end());
  if (!of_element.empty())
    for (const double of_vertex : work)
      graph.work.push_back(std::max(1l, std::lround(unit * of_vertex)));
  return graph;
}

/// METIS is deterministic: equal graphs with the same numbering give equal parts.
std::vector<unsigned int>
metis_parts(const FaceAreas &graph, std::vector<idx_t> work, unsigned int n_parts)
{
  std::vector<unsigned int> part(graph.size(), 0);
  if (n_parts <= 1)
    return part;
  if (n_parts >= graph.size())
    {
      std::iota(part.begin(), part.end(), 0);
      return part;
    }
  // METIS is called without deal.II's SparsityTools. Square sparsity patterns of deal.II store the
  // diagonal, which METIS receives as loops, and the loops worsen the cuts by up to a fifth.
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
  idx_t                n = narrow<idx_t>(graph.size()), k = n_parts, one = 1, cut = 0;
  const BlockedSignals during_call;
  // METIS recommends these methods for few and for many parts.
  const auto method = k <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  if (method(&n, &one, start.data(), neighbours.data(), work.empty() ? nullptr : work.data(),
             nullptr, weights.data(), &k, nullptr, nullptr, options, &cut,
             parts.data()) != METIS_OK)
    throw std::runtime_error("METIS could not partition the cells");
  part.assign(parts.begin(), parts.end());
  return part;
}

/// Return the positions of @p keys in ascending order of the keys.
template <typename Key>
std::vector<unsigned int> sorted_order(const std::vector<Key> &keys)
{
  std::vector<unsigned int> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](unsigned int a, unsigned int b) { return keys[a] < keys[b]; });
  return order;
}

/// Return connected parts without slivers.
std::vector<unsigned int>
parts_of_graph(const CellGraph &graph, const ElementGraph &elements, double cells_each)
{
  const unsigned int        n_parts   = std::max(1l, std::lround(graph.size() / cells_each));
  const auto                of_vertex = metis_parts(elements.areas, elements.work, n_parts);
  std::vector<unsigned int> part;
  for (const unsigned int vertex : elements.vertex)
    part.push_back(of_vertex[vertex]);
  // METIS balances the numbers of cells but may return disconnected parts. A piece of a few cells
  // would be a subdomain with a factorization and a kernel of its own.
  merge_slivers(graph, part, split_into_pieces(graph, part), cells_each);
  return part;
}

/// The cells of a body of all ranks, gathered on one rank.
template <int dim>
class GatheredCells
{
public:
  /// Gather the cells on rank @p root. Collective.
  GatheredCells(const CellSet<dim> &set, const unsigned int root)
    : keys(on_rank(root, set.communicator, set.keys))
    , numbers(on_rank(root, set.communicator, set.numbers))
    , places(on_rank(root, set.communicator, set.places))
    , neighbours(on_rank(root, set.communicator, set.neighbours))
    , areas(on_rank(root, set.communicator, set.areas))
  {}

  /// Return the part of each cell, rank after rank.
  std::vector<unsigned int> parts(const double cells_each) const
  {
    // The gathered order depends on the number of ranks, but the order of the keys does not.
    const auto                order = sorted_order(keys);
    std::vector<unsigned int> cells;
    std::vector<CellPlace>    sorted_places;
    for (const unsigned int i : order)
      {
        cells.push_back(numbers[i]);
        sorted_places.push_back(places[i]);
      }
    const auto graph  = contracted(face_areas(cells, neighbours, areas), sorted_places);
    const auto sorted = parts_of_graph(cell_graph(cells, neighbours), graph, cells_each);
    std::vector<unsigned int> result(order.size());
    for (unsigned int i = 0; i < order.size(); ++i)
      result[order[i]] = sorted[i];
    return result;
  }

private:
  std::vector<typename CellSet<dim>::Key> keys;
  std::vector<unsigned int>               numbers;
  std::vector<CellPlace>                  places;
  CellPairs                               neighbours;
  std::vector<double>                     areas;
};

/// Return the parts of the cells of this rank. @p parts holds the parts of all cells on rank
/// @p root. Collective.
template <int dim>
Partition
share(const CellSet<dim> &set, const std::vector<unsigned int> &parts, const unsigned int root)
{
  // All ranks receive all parts, one integer per cell, because a scatter would need counts.
  const auto        &comm   = set.communicator;
  const auto         all    = dealii::Utilities::MPI::broadcast(comm, parts, root);
  const auto         counts = all_gather(comm, static_cast<unsigned int>(set.numbers.size()));
  const unsigned int rank   = dealii::Utilities::MPI::this_mpi_process(comm);
  // The range of this rank follows the ranges of lower ranks, as on_rank() has joined the ranges.
  const auto first = all.begin() + std::accumulate(counts.begin(), counts.begin() + rank, 0u);
  Partition  result;
  result.part.assign(first, first + counts[rank]);
  result.n_parts = *std::max_element(all.begin(), all.end()) + 1;
  return result;
}
} // namespace

/// All bodies are gathered before the first body is partitioned, so that ranks partition
/// concurrently.
template <int dim>
std::vector<Partition> graph_partitions(const std::vector<const CellSet<dim> *> &bodies,
                                        const std::vector<double>               &cells_each)
{
  std::vector<GatheredCells<dim>> gathered;
  std::vector<unsigned int>       root;
  for (unsigned int i = 0; i < bodies.size(); ++i)
    {
      root.push_back(i % dealii::Utilities::MPI::n_mpi_processes(bodies[i]->communicator));
      gathered.emplace_back(*bodies[i], root[i]);
    }
  std::vector<std::vector<unsigned int>> parts(bodies.size());
  for (unsigned int i = 0; i < bodies.size(); ++i)
    if (root[i] == dealii::Utilities::MPI::this_mpi_process(bodies[i]->communicator))
      parts[i] = gathered[i].parts(cells_each[i]);
  std::vector<Partition> result;
  for (unsigned int i = 0; i < bodies.size(); ++i)
    result.push_back(share(*bodies[i], parts[i], root[i]));
  return result;
}

template std::vector<Partition> graph_partitions(const std::vector<const CellSet<2> *> &,
                                                 const std::vector<double> &);
template std::vector<Partition> graph_partitions(const std::vector<const CellSet<3> *> &,
                                                 const std::vector<double> &);
} // namespace snug::mesh
