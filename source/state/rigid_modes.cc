#include <snug/state/rigid_modes.h>

#include <cmath>

namespace snug::state {
template <int dim>
qp::MultiVector rigid_motions(const mesh::Idealization                  &idealization,
                              const std::vector<dealii::Tensor<1, dim>> &positions,
                              const dealii::Tensor<1, dim>              &centre,
                              double                                     length)
{
  // Component c of node a is row dim a + c; translations come first, then rotations.
  qp::MultiVector modes(dim * positions.size(), idealization.n_rigid_motions());
  if (idealization.is_axisymmetric())
    {
      for (unsigned int a = 0; a < positions.size(); ++a)
        // A rotation about the axis leaves the section, and a move along r would strain the hoops.
        modes(dim * a + 1, 0) = 1.;
      return modes;
    }
  for (unsigned int a = 0; a < positions.size(); ++a)
    {
      const dealii::Tensor<1, dim> x = (positions[a] - centre) / length;
      for (unsigned int c = 0; c < dim; ++c)
        modes(dim * a + c, c) = 1.;
      if (dim == 2)
        {
          modes(dim * a, 2)     = -x[1];
          modes(dim * a + 1, 2) = x[0];
          continue;
        }
      for (unsigned int axis = 0; axis < 3; ++axis)
        {
          // e_axis x x, with (axis, b, c) a right-handed system. "% dim" satisfies the compiler in
          // 2D.
          const unsigned int b = (axis + 1) % 3, c = (axis + 2) % 3;
          modes(dim * a + b, dim + axis) = -x[c % dim];
          modes(dim * a + c, dim + axis) = x[b % dim];
        }
    }
  return modes;
}

/// Subtract from each column its parts along the columns before (k < j), then divide the column by
/// its length (k = j).
void orthonormalise(qp::MultiVector &R)
{
  for (unsigned int sweep = 0; sweep < 2; ++sweep)
    for (unsigned int j = 0; j < R.n_columns(); ++j)
      {
        for (unsigned int k = 0; k <= j; ++k)
          {
            double product = 0.;
            for (unsigned int i = 0; i < R.n_rows(); ++i)
              product += R(i, j) * R(i, k);
            const double scale = 1. / std::sqrt(product);
            for (unsigned int i = 0; i < R.n_rows(); ++i)
              if (k < j)
                R(i, j) -= product * R(i, k);
              else
                R(i, j) *= scale;
          }
      }
}

template qp::MultiVector rigid_motions(const mesh::Idealization &,
                                       const std::vector<dealii::Tensor<1, 2>> &,
                                       const dealii::Tensor<1, 2> &,
                                       double);
template qp::MultiVector rigid_motions(const mesh::Idealization &,
                                       const std::vector<dealii::Tensor<1, 3>> &,
                                       const dealii::Tensor<1, 3> &,
                                       double);
} // namespace snug::state
