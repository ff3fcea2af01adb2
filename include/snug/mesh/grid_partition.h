#ifndef snug_mesh_grid_partition_h
#define snug_mesh_grid_partition_h

#include <snug/mesh/partition.h>

namespace snug::mesh {
/// Partition one body by slabs along the logical axes, cut between layers of cells. Collective.
template <int dim>
Partition grid_partition(const CellSet<dim> &set, double cells_each);

/// The parts of grid_partition() for a body whose cells are a grid without refinement. All numbers
/// are computed from the layers at which the grid is cut, so no rank needs all cells.
template <int dim>
class GridParts
{
public:
  using Counts = typename geometry::CellGrid<dim>::Counts;

  /// Cut the grid of a body of the lengths @p size, see CellSet, into parts of about
  /// @p cells_each cells.
  GridParts(const geometry::CellGrid<dim> &grid,
            const dealii::Tensor<1, dim>  &size,
            double                         cells_each);

  /// Return the number of parts, some of which may have no cells.
  unsigned int n_parts() const;

  /// Return the number of parts that have cells.
  unsigned long n_filled() const;

  /// Return the number of cells of the parts before @p part, which may be n_parts().
  unsigned long cells_before(unsigned int part) const;

  /// Return the part of the cell in the layers @p at.
  unsigned int part(const Counts &at) const;

  /// Return the first layers of a part, and the first layers behind it.
  std::pair<Counts, Counts> layers(unsigned int part) const;

private:
  /// first layer of each slab along the axes, then the number of layers
  std::array<std::vector<unsigned int>, dim> first_layer;

  unsigned int n_slabs(unsigned int axis) const { return first_layer[axis].size() - 1; }
};
} // namespace snug::mesh

#endif
