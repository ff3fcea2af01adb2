#ifndef snug_mesh_partition_h
#define snug_mesh_partition_h

#include <snug/base/choice.h>

#include <deal.II/base/bounding_box.h>

#include <vector>

namespace snug
{
  namespace mesh
  {
    /// Lists of the neighbours of each cell through faces.
    using CellGraph = std::vector<std::vector<unsigned int>>;

    /**
     * Ways to partition cells into about @p n parts: graph and bounding boxes
     * of the cells -> part of each. Rows "grid" and "METIS".
     *
     * Parts that are cubes of cells with flat sides need half the iterations
     * of the ragged ones a graph partitioner finds (54 subdomains of 6^3
     * cells, two cubes: 13 against 29 for a linear solve to 1e-6).
     */
    template <int dim>
    const ChoiceTable<
      std::vector<unsigned int>(const CellGraph &,
                                const std::vector<dealii::BoundingBox<dim>> &,
                                unsigned int)> &
    partition_table();
  } // namespace mesh
} // namespace snug

#endif
