#include <snug/elasticity/semi_analytic.h>

#include <algorithm>

namespace snug::elasticity {
namespace {
template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

template <int dim>
dealii::Tensor<1, dim> mean(const Nodes<dim> &x)
{
  dealii::Tensor<1, dim> sum;
  for (const auto &value : x)
    sum += value;
  return sum / double(x.size());
}

template <int dim>
double largest_norm(const Nodes<dim> &x)
{
  double norm = 0.;
  for (const auto &value : x)
    norm = std::max(norm, value.norm());
  return norm;
}

/// Rotations in the plane have one component, in space three.
dealii::Tensor<1, 1> moment(const dealii::Tensor<1, 2> &x, const dealii::Tensor<1, 2> &v)
{
  return dealii::Tensor<1, 1>({x[0] * v[1] - x[1] * v[0]});
}

dealii::Tensor<1, 3> moment(const dealii::Tensor<1, 3> &x, const dealii::Tensor<1, 3> &v)
{
  return cross_product_3d(x, v);
}

dealii::Tensor<1, 2> rotated(const dealii::Tensor<1, 1> &omega, const dealii::Tensor<1, 2> &x)
{
  return dealii::Tensor<1, 2>({-omega[0] * x[1], omega[0] * x[0]});
}

dealii::Tensor<1, 3> rotated(const dealii::Tensor<1, 3> &omega, const dealii::Tensor<1, 3> &x)
{
  return cross_product_3d(omega, x);
}

dealii::Tensor<2, 1> inertia(const dealii::Tensor<1, 2> &x)
{
  dealii::Tensor<2, 1> result;
  result[0][0] = x.norm_square();
  return result;
}

dealii::Tensor<2, 3> inertia(const dealii::Tensor<1, 3> &x)
{
  return x.norm_square() * dealii::unit_symmetric_tensor<3>() - outer_product(x, x);
}

/// The rigid motion nearest to nodal values, about the mean of X.
template <int dim>
struct RigidMotion
{
  static constexpr int n_rotations = dim == 2 ? 1 : 3;

  dealii::Tensor<1, dim>         translation;
  dealii::Tensor<1, n_rotations> rotation;

  RigidMotion(const Nodes<dim> &X, const Nodes<dim> &u, const mesh::Idealization &idealization)
    : translation(mean(u))
  {
    if (idealization.is_axisymmetric())
      {
        translation[0] = 0.;
        return;
      }
    const auto                     centre = mean(X);
    dealii::Tensor<2, n_rotations> sum;
    dealii::Tensor<1, n_rotations> moments;
    for (unsigned int a = 0; a < X.size(); ++a)
      {
        sum += inertia(X[a] - centre);
        moments += moment(X[a] - centre, u[a]);
      }
    rotation = invert(sum) * moments;
  }
};
} // namespace

template <int dim>
SemiAnalytic<dim>::SemiAnalytic(const Stencil            &stencil,
                                const bool                refined,
                                const double              step,
                                const mesh::Idealization &idealization)
  : stencil(stencil), refined(refined), step(step), idealization(idealization)
{}

template <int dim>
typename SemiAnalytic<dim>::Nodes
SemiAnalytic<dim>::load_derivative(const NodeFunction<dim> &f, const Nodes &X, const Nodes &V) const
{
  auto shift = mean(V);
  if (idealization.is_axisymmetric())
    shift[0] = 0.;
  Nodes deforming = V;
  for (auto &v : deforming)
    v -= shift;
  const double largest = largest_norm(deforming);
  if (largest == 0.)
    return Nodes(X.size());
  const double size = (X.back() - X.front()).norm();
  return difference<dim>(stencil, f, X, deforming, step * size / largest);
}

template <int dim>
void SemiAnalytic<dim>::internal_force_derivative(const Element<dim> &element,
                                                  const Nodes        &X,
                                                  const Nodes        &V,
                                                  const Material     &material,
                                                  const Nodes        &u,
                                                  Nodes              &r) const
{
  Nodes deforming = u;
  if (refined)
    {
      const RigidMotion<dim> rigid(X, u, idealization);
      const auto             centre = mean(X);
      Nodes                  R_change(X.size()); // R' c
      for (unsigned int a = 0; a < X.size(); ++a)
        {
          deforming[a] -= rigid.translation + rotated(rigid.rotation, X[a] - centre);
          R_change[a] = rotated(rigid.rotation, V[a]);
        }
      element.internal_force(X, material, R_change, r);
    }
  const auto by_differences = load_derivative(
    [&](const Nodes &x, Nodes &f) { element.internal_force(x, material, deforming, f); }, X, V);
  if (!refined)
    r.assign(X.size(), {});
  for (unsigned int a = 0; a < X.size(); ++a)
    r[a] = by_differences[a] - r[a];
}

template class SemiAnalytic<2>;
template class SemiAnalytic<3>;
} // namespace snug::elasticity
