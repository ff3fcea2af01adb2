#ifndef snug_mesh_partition_h
#define snug_mesh_partition_h

#include <snug/base/choice.h>
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
  unsigned int subdomains = 0;      ///< of all bodies, a target; 0: by size
  std::string  method     = "auto"; ///< a name of partition_table()
  /// as many as ranks, where there are cells enough; not an entry
  bool at_least_ranks = true;
  /// bodies of which subdomains by size are larger, see larger_subdomains(); not an entry
  std::vector<bool> nearly_incompressible;

  void declare(Entries &entries);
};

/**
 * The cells of one body that a rank holds before the parts are decided.
 * Cells have numbers, unique over ranks, and keys {level and coarse cell,
 * path of children}, which order them in the same way on any number of
 * ranks.
 */
template <int dim>
struct CellSet
{
  using Key = std::array<std::uint64_t, 2>;

  MPI_Comm                        communicator;
  std::vector<dealii::Point<dim>> centres; ///< logical
  std::vector<unsigned int>       numbers;
  std::vector<Key>                keys;
  /// by their numbers; each pair of the body on one rank only
  CellPairs              neighbours;
  std::vector<double>    areas;     ///< of the faces that these share [length^(dim-1)]
  unsigned long          n_global;  ///< cells of the body
  unsigned long          n_slender; ///< of those, axes differ by more than compact_aspect
  dealii::Tensor<1, dim> size;      ///< along the logical axes
  bool                   layered;   ///< all cells lie in layers along the logical axes
};

/// Parts of one body, the same on any number of ranks.
struct Partition
{
  std::vector<unsigned int> part; ///< of each cell of this rank
  unsigned int              n_parts = 1;
};

/**
 * Whether the cells of a body are partitioned by a grid, else as a graph: rows "auto", "grid" and
 * "METIS".
 *
 * Parts that are cubes of cells with flat sides need half the iterations
 * of the ragged ones a graph partitioner finds (54 subdomains of 6^3
 * cells, two cubes: 14 against 31 for a linear solve to 1e-6).
 */
template <int dim>
const ChoiceTable<bool(const CellSet<dim> &)> &partition_table();

/**
 * Each body into parts of about @p cells_each cells, by the row @p method of partition_table().
 * Collective.
 */
template <int dim>
std::vector<Partition> partitions(const std::string               &method,
                                  const std::vector<CellSet<dim>> &bodies,
                                  const std::vector<double>       &cells_each);

/// Of one body: slabs along the logical axes, cut between layers of cells.
template <int dim>
Partition grid_partition(const CellSet<dim> &set, double cells_each);

/// By METIS: the cell graph of each whole body, gathered on one rank, the bodies on the ranks in
/// turn. Its edges weigh as much as the faces' areas: parts of flat cells are not flat.
template <int dim>
std::vector<Partition> graph_partitions(const std::vector<const CellSet<dim> *> &bodies,
                                        const std::vector<double>               &cells_each);
} // namespace snug::mesh

#endif
