#include <snug/mesh/cell_graph.h>

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <map>
#include <unordered_map>

namespace snug::mesh {
template <int dim>
CellPairs owned_neighbours(const dealii::Triangulation<dim, dim> &triangulation)
{
  std::vector<unsigned int> number(triangulation.n_active_cells());
  unsigned int              n_owned = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      // Only owned cells are numbered; ghost cells and artificial cells are active as well.
      number[cell->active_cell_index()] = n_owned++;
  // At a face between cells of different levels, only the finer cell has an active neighbour.
  CellPairs pairs;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int f : cell->face_indices())
        if (!cell->at_boundary(f) && cell->neighbor(f)->is_active() &&
            cell->neighbor(f)->is_locally_owned())
          {
            const unsigned int a = number[cell->active_cell_index()];
            const unsigned int b = number[cell->neighbor(f)->active_cell_index()];
            pairs.push_back({{std::min(a, b), std::max(a, b)}});
          }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

CellGraph cell_graph(const std::vector<unsigned int> &cells, const CellPairs &pairs)
{
  std::unordered_map<unsigned int, unsigned int> place;
  for (unsigned int i = 0; i < cells.size(); ++i)
    place[cells[i]] = i;
  CellGraph graph(cells.size());
  for (const auto &pair : pairs)
    {
      const auto a = place.find(pair[0]), b = place.find(pair[1]);
      if (a == place.end() || b == place.end())
        continue;
      graph[a->second].push_back(b->second);
      graph[b->second].push_back(a->second);
    }
  return graph;
}

/// The seeds ascend, so pieces are numbered in the order of their first cells for any numbering of
/// the parts.
unsigned int split_into_pieces(const CellGraph &graph, std::vector<unsigned int> &part)
{
  const unsigned int        none = static_cast<unsigned int>(-1);
  std::vector<unsigned int> piece(graph.size(), none);
  unsigned int              n_pieces = 0;
  for (unsigned int seed = 0; seed < graph.size(); ++seed)
    if (piece[seed] == none)
      {
        std::vector<unsigned int> front(1, seed);
        piece[seed] = n_pieces;
        while (!front.empty())
          {
            const unsigned int cell = front.back();
            front.pop_back();
            for (const unsigned int next : graph[cell])
              if (piece[next] == none && part[next] == part[seed])
                {
                  piece[next] = n_pieces;
                  front.push_back(next);
                }
          }
        ++n_pieces;
      }
  part = piece;
  return n_pieces;
}

void merge_slivers(const CellGraph           &graph,
                   std::vector<unsigned int> &part,
                   unsigned int               n_parts,
                   double                     cells_each)
{
  for (unsigned int sliver = 0; sliver < n_parts; ++sliver)
    {
      // number of faces shared with each other part; empty if the part fills a body
      std::map<unsigned int, unsigned int> shared;
      unsigned int                         size = 0;
      for (unsigned int i = 0; i < graph.size(); ++i)
        if (part[i] == sliver)
          {
            ++size;
            for (const unsigned int j : graph[i])
              if (part[j] != sliver)
                ++shared[part[j]];
          }
      // The size includes slivers merged before, so two slivers together may form a part.
      if (size >= 0.25 * cells_each || shared.empty())
        continue;
      const auto best =
        // Among equal maxima the part with the smallest number is taken, which is reproducible.
        std::max_element(shared.begin(), shared.end(),
                         [](const auto &a, const auto &b) { return a.second < b.second; });
      for (unsigned int &p : part)
        if (p == sliver)
          p = best->first;
    }
  // Merging leaves gaps in the numbers of parts, so parts are numbered again.
  split_into_pieces(graph, part);
}

template CellPairs owned_neighbours(const dealii::Triangulation<2, 2> &);
template CellPairs owned_neighbours(const dealii::Triangulation<3, 3> &);
} // namespace snug::mesh
