#include <snug/faces/face_shape.h>

namespace snug::faces {
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
} // namespace snug::faces
