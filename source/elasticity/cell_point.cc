#include <snug/base/assertions.h>
#include <snug/elasticity/cell_point.h>


namespace snug::elasticity {
template <int dim>
dealii::Tensor<2, dim> jacobian(const mesh::LagrangePoint<dim>            &shape,
                                const std::vector<dealii::Tensor<1, dim>> &X)
{
  SNUG_ASSERT_EQUAL(X.size(), shape.gradient.size());
  dealii::Tensor<2, dim> J;
  for (unsigned int a = 0; a < X.size(); ++a)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        J[c][d] += X[a][c] * shape.gradient[a][d];
  return J;
}

template <int dim>
dealii::Tensor<1, dim> value(const mesh::LagrangePoint<dim>            &shape,
                             const std::vector<dealii::Tensor<1, dim>> &u)
{
  SNUG_ASSERT_EQUAL(u.size(), shape.value.size());
  dealii::Tensor<1, dim> result;
  for (unsigned int a = 0; a < u.size(); ++a)
    result += shape.value[a] * u[a];
  return result;
}

template <int dim>
InverseJacobian<dim>::InverseJacobian(const mesh::LagrangePoint<dim> &shape,
                                      const Nodes                    &X,
                                      const mesh::Idealization       &idealization)
  : shape(shape)
  , inverse(invert(jacobian(shape, X)))
  , radius(idealization.is_axisymmetric() ? value(shape, X)[0] : 0.)
{}

/// Compute du/dx = du/d xi J^-1, and u_r / r in axisymmetric models.
template <int dim>
dealii::Tensor<2, 3> InverseJacobian<dim>::gradient(const Nodes &u) const
{
  const auto           in_plane = jacobian(shape, u) * inverse;
  dealii::Tensor<2, 3> result;
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = 0; d < dim; ++d)
      result[c][d] = in_plane[c][d];
  if (radius != 0.)
    result[2][2] = value(shape, u)[0] / radius;
  return result;
}

template <int dim>
CellPoint<dim>::CellPoint(const mesh::LagrangePoint<dim> &shape,
                          const Nodes                    &X,
                          const mesh::Idealization       &idealization)
  : shape(shape), inverse_radius(0.)
{
  // J_cd = dX_c / d xi_d, so that g_a = J^-T dN_a/d xi is the row vector dN_a/d xi times J^-1.
  const dealii::Tensor<2, dim> J       = jacobian(shape, X);
  const dealii::Tensor<2, dim> inverse = invert(J);

  dV = shape.weight * determinant(J);
  if (dim == 2)
    {
      const auto x = value(shape, X);
      // The weight is the thickness or 2 pi r. It makes dV the volume in space of the point.
      dV *= idealization.weight(x);
      if (idealization.is_axisymmetric())
        // Gauss points lie off the axis. A point on the axis would have an infinite inverse radius.
        inverse_radius = 1. / x[0];
    }
  for (unsigned int a = 0; a < X.size(); ++a)
    // These are gradients in the plane of a section. gradient() adds the out-of-plane entry.
    gradients[a] = shape.gradient[a] * inverse;
}

template <int dim>
dealii::Tensor<2, 3> CellPoint<dim>::gradient(const Nodes &u) const
{
  SNUG_ASSERT_EQUAL(u.size(), shape.value.size());
  dealii::Tensor<2, dim> sum;
  for (unsigned int a = 0; a < u.size(); ++a)
    sum += outer_product(u[a], gradients[a]);
  dealii::Tensor<2, 3> result;
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = 0; d < dim; ++d)
      result[c][d] = sum[c][d];
  if (inverse_radius != 0.)
    // u_r / r is the strain of circles about the axis.
    result[2][2] = value(shape, u)[0] * inverse_radius;
  return result;
}

/// Apply the transpose of gradient(), times dV. Internal forces of a stress and gradients with
/// respect to positions both use this function.
template <int dim>
void CellPoint<dim>::add_flux(const dealii::Tensor<2, 3> &flux, Nodes &f) const
{
  SNUG_ASSERT_EQUAL(f.size(), shape.value.size());
  dealii::Tensor<2, dim> in_plane;
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = 0; d < dim; ++d)
      in_plane[c][d] = dV * flux[c][d];
  // The flux is zero in plane sections, because no force works on the strain across them.
  const double hoop = dV * flux[2][2] * inverse_radius;
  for (unsigned int a = 0; a < f.size(); ++a)
    {
      f[a] += in_plane * gradients[a];
      f[a][0] += hoop * shape.value[a];
    }
}

/// Apply the transpose of value(), times dV.
template <int dim>
void CellPoint<dim>::add_source(const dealii::Tensor<1, dim> &source, Nodes &f) const
{
  SNUG_ASSERT_EQUAL(f.size(), shape.value.size());
  for (unsigned int a = 0; a < f.size(); ++a)
    f[a] += dV * shape.value[a] * source;
}

#define SNUG_INSTANTIATE(dim)                                                            \
  template dealii::Tensor<2, dim> jacobian(const mesh::LagrangePoint<dim> &,             \
                                           const std::vector<dealii::Tensor<1, dim>> &); \
  template dealii::Tensor<1, dim> value(const mesh::LagrangePoint<dim> &,                \
                                        const std::vector<dealii::Tensor<1, dim>> &);    \
  template struct InverseJacobian<dim>;                                                  \
  template struct CellPoint<dim>;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::elasticity
