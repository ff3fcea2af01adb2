#ifndef snug_state_rigid_modes_h
#define snug_state_rigid_modes_h

#include <snug/mesh/idealization.h>
#include <snug/qp/multi_vector.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace snug::state {
/// Return translations and rotations about @p centre over @p length at @p positions, one mode per
/// column: 6 modes of a solid, 3 modes in plane sections, and the translation along the axis in
/// axisymmetric sections.
template <int dim>
qp::MultiVector rigid_motions(const mesh::Idealization                  &idealization,
                              const std::vector<dealii::Tensor<1, dim>> &positions,
                              const dealii::Tensor<1, dim>              &centre,
                              double                                     length);

/// Orthonormalise the columns by Gram-Schmidt, in two sweeps because of round-off.
void orthonormalise(qp::MultiVector &R);
} // namespace snug::state

#endif
