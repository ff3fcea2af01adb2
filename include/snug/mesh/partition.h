#ifndef snug_mesh_partition_h
#define snug_mesh_partition_h

#include <snug/base/choice.h>
#include <snug/geometry/body_geometry.h>
#include <snug/mesh/cell_graph.h>

#include <deal.II/base/point.h>

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace snug {
class Entries;
}

namespace snug::mesh {
/// Entries of `subsection Decomposition`.
struct TearingParameters
{
  unsigned int subdomains = 0;      ///< target number for all bodies; 0: by size
  std::string  method     = "auto"; ///< a name of partition_table()
  /// number of subdomains along the edge of a cluster, see find_clusters(); 0: by their number
  unsigned int cluster_edge = 0;
  /// if true, there are at least as many subdomains as ranks, provided that there are enough
  /// cells; not an entry
  bool at_least_ranks = true;
  /// bodies whose subdomains by size are larger, see larger_subdomains(); not an entry
  std::vector<bool> nearly_incompressible = {};

  void declare(Entries &entries);
};

/// The element that must not be divided (see QuadraticElements), or no_element, and the number of
/// unknowns of the cell divided by that of a cell of no element.
using CellPlace = std::pair<unsigned int, double>;

/**
 * The cells of one body that a rank holds before the parts are decided.
 * Cells have numbers that are unique over ranks. Cells also have keys {level and coarse cell,
 * path of children}, which give the same order of cells on any number of
 * ranks.
 */
template <int dim>
struct CellSet
{
  using Key = std::array<std::uint64_t, 2>;

  MPI_Comm                        communicator;
  std::vector<dealii::Point<dim>> centres; ///< logical
  std::vector<CellPlace>          places;
  std::vector<unsigned int>       numbers;
  std::vector<Key>                keys;
  /// pairs of numbers of cells that share a face; each pair of the body is on one rank only
  CellPairs              neighbours;
  std::vector<double>    areas;     ///< of the shared faces of neighbours [length^(dim-1)]
  unsigned long          n_global;  ///< number of cells of the body
  unsigned long          n_slender; ///< number of cells with CellShape::is_slender()
  dealii::Tensor<1, dim> size;      ///< along the logical axes
  bool                   layered;   ///< all cells lie in layers along the logical axes

  /// Add the place and the centre of a cell. @p logical returns the logical position at
  /// coordinates in the cell. The centre of a cell of an element is that of the element, so that a
  /// grid does not divide elements.
  template <typename Logical>
  void add(const CellPlace &place, const Logical &logical)
  {
    const auto centre = geometry::unit_centre<dim>();
    places.push_back(place);
    centres.push_back(
      logical(place.first == geometry::no_element ? centre : dealii::Point<dim>(2. * centre)));
  }
};

/// Parts of one body, the same on any number of ranks.
struct Partition
{
  std::vector<unsigned int> part; ///< of each cell of this rank
  unsigned int              n_parts = 1;
};

/**
 * Return the rows "auto", "grid" and "METIS" of the entry Method. A row returns whether the cells
 * of a body are partitioned by a grid, given whether they all lie in layers along the logical axes;
 * otherwise the cells are partitioned as a graph.
 *
 * Parts that are cubes of cells with flat sides need half as many iterations as the ragged parts
 * of a graph partitioner (measured on two cubes with 54 subdomains of 6^3
 * cells: 14 against 31 iterations for a linear solve to 1e-6).
 */
const ChoiceTable<bool(bool)> &partition_table();

/**
 * Partition each body into parts of about @p cells_each cells by the row @p method of
 * partition_table(). Collective.
 */
template <int dim>
std::vector<Partition> partitions(const std::string               &method,
                                  const std::vector<CellSet<dim>> &bodies,
                                  const std::vector<double>       &cells_each);

/// Partition the cell graph of each whole body by METIS. Each graph is gathered on one rank, and
/// the bodies take the ranks in turn. The weights of the graph edges are the areas of the faces,
/// so that parts of flat cells are not flat. Collective.
template <int dim>
std::vector<Partition> graph_partitions(const std::vector<const CellSet<dim> *> &bodies,
                                        const std::vector<double>               &cells_each);
} // namespace snug::mesh

#endif
