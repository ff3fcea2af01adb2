#ifndef snug_mesh_cell_shape_h
#define snug_mesh_cell_shape_h

#include <deal.II/base/point.h>

#include <array>
#include <functional>

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
} // namespace snug::mesh

#endif
