#ifndef snug_mesh_cell_graph_h
#define snug_mesh_cell_graph_h

#include <array>
#include <vector>

namespace dealii {
template <int dim, int spacedim>
class Triangulation;
}

namespace snug::mesh {
/// For each cell, the list of neighbours that share a face with the cell.
using CellGraph = std::vector<std::vector<unsigned int>>;

/// Pairs of cells that share a face or part of a face.
using CellPairs = std::vector<std::array<unsigned int, 2>>;

/// Return the ascending pairs a < b of neighbouring owned cells. Owned cells are numbered in the
/// order of the active cells.
template <int dim>
CellPairs owned_neighbours(const dealii::Triangulation<dim, dim> &triangulation);

/// Return the graph of the cells with the numbers @p cells. The nodes of the graph are the
/// positions in this list. Pairs with other cells are ignored.
CellGraph cell_graph(const std::vector<unsigned int> &cells, const CellPairs &pairs);

/// Split every part into its face-connected pieces. Pieces are numbered in the order of their
/// first cells. @return the number of pieces.
unsigned int split_into_pieces(const CellGraph &graph, std::vector<unsigned int> &part);

/**
 * Merge each part of less than a quarter of @p cells_each cells into the neighbouring part with
 * the maximum number of shared faces. Parts without neighbours stay.
 * Parts are then numbered in the order of their first cells.
 */
void merge_slivers(const CellGraph           &graph,
                   std::vector<unsigned int> &part,
                   unsigned int               n_parts,
                   double                     cells_each);
} // namespace snug::mesh

#endif
