#ifndef snug_mesh_cell_shape_h
#define snug_mesh_cell_shape_h

#include <deal.II/base/point.h>

#include <mpi.h>

#include <array>
#include <functional>
#include <vector>

namespace snug::mesh {
/// Maximum ratio of the longest to the shortest axis of a cell that counts as nearly cubic.
constexpr double compact_aspect = 1.8;

/// The axes of a cell, vectors from the centre of a face to the centre of the opposite face
/// [length].
template <int dim>
class CellShape
{
public:
  /// Compute the axes. @p position maps coordinates in the unit cell to positions.
  explicit CellShape(const std::function<dealii::Point<dim>(const dealii::Point<dim> &)> &position);

  /// Return the area of the section normal to @p axis [length^(dim-1)].
  double section(unsigned int axis) const;

  /// Return whether the ratio of the longest to the shortest axis exceeds compact_aspect.
  bool is_slender() const;

private:
  std::array<dealii::Tensor<1, dim>, dim> axes;
};
/// Return the shapes of the cells of this rank, body by body. @p of_body returns the shapes of one
/// body and may throw on one rank alone. Collective.
template <int dim>
std::vector<std::vector<CellShape<dim>>>
shapes_of_bodies(std::size_t                                                     n_bodies,
                 MPI_Comm                                                        communicator,
                 const std::function<std::vector<CellShape<dim>>(unsigned int)> &of_body);

/// Return the number of slender cells of all ranks. Collective.
template <int dim>
unsigned long count_slender(const std::vector<CellShape<dim>> &shapes, MPI_Comm communicator);
} // namespace snug::mesh

#endif
