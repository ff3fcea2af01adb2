#ifndef snug_mesh_cell_shape_h
#define snug_mesh_cell_shape_h

#include <deal.II/base/point.h>

#include <mpi.h>

#include <array>
#include <functional>
#include <vector>

namespace snug::mesh {
/// Longest over shortest axis of cells of which cubes of cells are nearly cubes.
constexpr double compact_aspect = 1.8;

/// The axes of a cell, from one face's centre to that of the opposite one [length].
template <int dim>
class CellShape
{
public:
  /// @p position of coordinates in the unit cell.
  explicit CellShape(const std::function<dealii::Point<dim>(const dealii::Point<dim> &)> &position);

  /// Area of the section across @p axis [length^(dim-1)].
  double section(unsigned int axis) const;

  /// Whether axes differ by more than compact_aspect.
  bool is_slender() const;

private:
  std::array<dealii::Tensor<1, dim>, dim> axes;
};
/// Shapes of this rank's cells, body by body, where @p of_body may throw on one rank alone.
/// Collective.
template <int dim>
std::vector<std::vector<CellShape<dim>>>
shapes_of_bodies(std::size_t                                                     n_bodies,
                 MPI_Comm                                                        communicator,
                 const std::function<std::vector<CellShape<dim>>(unsigned int)> &of_body);

/// Of all ranks. Collective.
template <int dim>
unsigned long count_slender(const std::vector<CellShape<dim>> &shapes, MPI_Comm communicator);
} // namespace snug::mesh

#endif
