#include <snug/elasticity/linear_traction.h>
#include <snug/elasticity/semi_analytic.h>

#include <algorithm>

namespace snug::elasticity {
namespace {
template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

/// Of the nodes, not of the volume.
template <int dim>
dealii::Tensor<1, dim> mean(const Nodes<dim> &x)
{
  dealii::Tensor<1, dim> sum;
  for (const auto &value : x)
    sum += value;
  return sum / double(x.size());
}

/// Of the vectors' lengths, which does not depend on the axes.
template <int dim>
double largest_norm(const Nodes<dim> &x)
{
  double norm = 0.;
  for (const auto &value : x)
    norm = std::max(norm, value.norm());
  return norm;
}

/// The rigid motion nearest to nodal values, about the mean of X.
template <int dim>
struct RigidMotion
{
  dealii::Tensor<1, dim> translation;
  dealii::Tensor<1, 3>   rotation;

  /// In the sense of least squares over the nodes, all with the same weight.
  RigidMotion(const Nodes<dim> &X, const Nodes<dim> &u, const mesh::Idealization &idealization)
    : translation(mean(u))
  {
    if (idealization.is_axisymmetric())
      {
        // Only the motion along the axis is rigid there.
        translation[0] = 0.;
        return;
      }
    // c = (R'R)^-1 R'u for rotations about the mean of the nodes, where they are orthogonal to the
    // translations: each part is found alone.
    const auto             centre = mean(X);
    dealii::Tensor<2, dim> second;
    dealii::Tensor<1, 3>   moments;
    for (unsigned int a = 0; a < X.size(); ++a)
      {
        second += outer_product(X[a] - centre, X[a] - centre);
        moments += moment_of(X[a] - centre, u[a]);
      }
    rotation = inverse<dim>(inertia(second)) * moments;
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
  // A translation changes no element quantity, but would make the step of the deformation smaller
  // and the part of rounding larger.
  auto shift = mean(V);
  if (idealization.is_axisymmetric())
    shift[0] = 0.;
  Nodes deforming = V;
  for (auto &v : deforming)
    v -= shift;
  // The fastest node moves by `step` times the size of the element.
  const double largest = largest_norm(deforming);
  // A translated element: all derivatives vanish.
  if (largest == 0.)
    return Nodes(X.size());
  // The diagonal, as the first and last node in tensor order are opposite corners.
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
  // u - R c if refined: small where the cell moves almost rigidly, and with
  // it the error.
  Nodes deforming = u;
  if (refined)
    {
      const RigidMotion<dim> rigid(X, u, idealization);
      const auto             centre = mean(X);
      Nodes                  R_change(X.size()); // R' c
      for (unsigned int a = 0; a < X.size(); ++a)
        {
          deforming[a] -= rigid.translation + turned(rigid.rotation, X[a] - centre);
          // Of omega x (X_a - centre); the move of the centre adds a translation, which K does not
          // see.
          R_change[a] = turned(rigid.rotation, V[a]);
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
