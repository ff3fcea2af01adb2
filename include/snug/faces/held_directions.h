#ifndef snug_faces_held_directions_h
#define snug_faces_held_directions_h

#include <deal.II/base/tensor.h>

#include <vector>

namespace snug::faces {
/// Orthonormal directions that supports hold, per surface node.
template <int dim>
using HeldDirections = std::vector<std::vector<dealii::Tensor<1, dim>>>;

/// Return @p v without its components along @p held.
template <int dim, typename Number>
dealii::Tensor<1, dim, Number> free_part(dealii::Tensor<1, dim, Number>             v,
                                         const std::vector<dealii::Tensor<1, dim>> &held)
{
  for (const auto &q : held)
    v -= (v * q) * q;
  return v;
}
} // namespace snug::faces

#endif
