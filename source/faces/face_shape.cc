#include <snug/faces/face_shape.h>

namespace snug::faces {
/// Return the tangents if @p field contains positions, or their derivatives if it contains
/// velocities.
template <int dim>
typename FaceShape<dim>::Tangents tangents(const typename FaceShape<dim>::Values    &values,
                                           const std::vector<unsigned int>          &nodes,
                                           const typename mesh::Surface<dim>::Field &field)
{
  typename FaceShape<dim>::Tangents t;
  for (unsigned int k = 0; k < nodes.size(); ++k)
    for (int i = 0; i < dim - 1; ++i)
      t[i] += values.gradient[k][i] * field[nodes[k]];
  return t;
}

/// Return cross_product_2d(t) of deal.II, (t_y, -t_x), which is t rotated by -90 degrees. Faces are
/// oriented such that this vector, or t_1 x t_2, points out of the body.
dealii::Tensor<1, 2> area_vector(const std::array<dealii::Tensor<1, 2>, 1> &t)
{
  return dealii::cross_product_2d(t[0]);
}

dealii::Tensor<1, 3> area_vector(const std::array<dealii::Tensor<1, 3>, 2> &t)
{
  return dealii::cross_product_3d(t[0], t[1]);
}

/// Use that the area vector is linear in the tangent in 2D and bilinear in 3D.
dealii::Tensor<1, 2> area_vector_derivative(const std::array<dealii::Tensor<1, 2>, 1> &,
                                            const std::array<dealii::Tensor<1, 2>, 1> &dt)
{
  return area_vector(dt);
}

dealii::Tensor<1, 3> area_vector_derivative(const std::array<dealii::Tensor<1, 3>, 2> &t,
                                            const std::array<dealii::Tensor<1, 3>, 2> &dt)
{
  return dealii::cross_product_3d(dt[0], t[1]) + dealii::cross_product_3d(t[0], dt[1]);
}

std::array<dealii::Tensor<1, 2>, 1>
area_vector_transpose(const std::array<dealii::Tensor<1, 2>, 1> &, const dealii::Tensor<1, 2> &b)
{
  // The transpose of a rotation by -90 degrees is the rotation by 90 degrees.
  return {{-dealii::cross_product_2d(b)}};
}

std::array<dealii::Tensor<1, 3>, 2>
area_vector_transpose(const std::array<dealii::Tensor<1, 3>, 2> &t, const dealii::Tensor<1, 3> &b)
{
  // b . (t_1' x t_2 + t_1 x t_2') = t_1' . (t_2 x b) + t_2' . (b x t_1)
  return {{dealii::cross_product_3d(t[1], b), dealii::cross_product_3d(b, t[0])}};
}

template typename FaceShape<2>::Tangents tangents<2>(const FaceShape<2>::Values &,
                                                     const std::vector<unsigned int> &,
                                                     const mesh::Surface<2>::Field &);
template typename FaceShape<3>::Tangents tangents<3>(const FaceShape<3>::Values &,
                                                     const std::vector<unsigned int> &,
                                                     const mesh::Surface<3>::Field &);
} // namespace snug::faces
