#ifndef snug_mesh_partition_h
#define snug_mesh_partition_h

#include <snug/base/choice.h>

#include <deal.II/base/point.h>

#include <mpi.h>

#include <vector>

namespace snug
{
  namespace mesh
  {
    /// Lists of the neighbours of each cell through faces.
    using CellGraph = std::vector<std::vector<unsigned int>>;

    /// The cells of one body, as far as a rank holds them, and the body.
    template <int dim>
    struct CellSet
    {
      MPI_Comm                        communicator;
      CellGraph                       graph;    ///< of this rank's cells
      std::vector<dealii::Point<dim>> centres;  ///< logical, of the same cells
      unsigned long                   n_global; ///< cells of the body
      dealii::Tensor<1, dim>          size;     ///< of the body's box [length]
    };

    /**
     * Ways to partition the cells of a body into parts of about a given
     * number: the part of each cell of this rank. Collective. Rows "grid" and
     * "METIS".
     *
     * Parts that are cubes of cells with flat sides need half the iterations
     * of the ragged ones a graph partitioner finds (54 subdomains of 6^3
     * cells, two cubes: 14 against 31 for a linear solve to 1e-6).
     */
    template <int dim>
    const ChoiceTable<std::vector<unsigned int>(const CellSet<dim> &, double)> &
    partition_table();
  } // namespace mesh
} // namespace snug

#endif
