#ifndef snug_mesh_cell_graph_h
#define snug_mesh_cell_graph_h

#include <utility>
#include <vector>

namespace dealii {
template <int dim, int spacedim>
class Triangulation;
}

namespace snug::mesh {
/// Lists of the neighbours of each cell through faces.
using CellGraph = std::vector<std::vector<unsigned int>>;

/// Pairs a < b of owned cells, numbered in the order of the active cells,
/// that share a face or part of one; ascending.
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
owned_neighbours(const dealii::Triangulation<dim, dim> &triangulation);

/// Split every part into its face-connected pieces, numbered by their
/// first cell. @return the number of pieces.
unsigned int split_into_pieces(const CellGraph &graph, std::vector<unsigned int> &part);

/**
 * Give parts of less than a quarter of @p cells_each cells to the
 * neighbour they share most faces with; parts without neighbours stay.
 * @return the number of parts, which are numbered by their first cell.
 */
unsigned int merge_slivers(const CellGraph           &graph,
                           std::vector<unsigned int> &part,
                           unsigned int               n_parts,
                           double                     cells_each);
} // namespace snug::mesh

#endif
