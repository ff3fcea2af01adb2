#ifndef snug_mesh_cell_graph_h
#define snug_mesh_cell_graph_h

#include <array>
#include <vector>

namespace dealii {
template <int dim, int spacedim>
class Triangulation;
}

namespace snug::mesh {
/// Lists of the neighbours of each cell through faces.
using CellGraph = std::vector<std::vector<unsigned int>>;

/// Cells that share a face or part of one.
using CellPairs = std::vector<std::array<unsigned int, 2>>;

/// Pairs a < b of owned cells, numbered in the order of the active cells;
/// ascending.
template <int dim>
CellPairs owned_neighbours(const dealii::Triangulation<dim, dim> &triangulation);

/// Graph of the cells called @p cells, by their places in that list; pairs
/// with other cells do not count.
CellGraph cell_graph(const std::vector<unsigned int> &cells, const CellPairs &pairs);

/// Split every part into its face-connected pieces, numbered by their
/// first cell. @return the number of pieces.
unsigned int split_into_pieces(const CellGraph &graph, std::vector<unsigned int> &part);

/**
 * Give parts of less than a quarter of @p cells_each cells to the
 * neighbour they share most faces with; parts without neighbours stay.
 * Parts are then numbered by their first cell.
 */
void merge_slivers(const CellGraph           &graph,
                   std::vector<unsigned int> &part,
                   unsigned int               n_parts,
                   double                     cells_each);
} // namespace snug::mesh

#endif
