#include <snug/elasticity/linear_traction.h>
#include <snug/elasticity/semi_analytic.h>

#include <algorithm>

namespace snug::elasticity {
namespace {
template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

/// Return the mean over the nodes, not over the volume.
template <int dim>
dealii::Tensor<1, dim> mean(const Nodes<dim> &x)
{
  dealii::Tensor<1, dim> sum;
  for (const auto &value : x)
    sum += value;
  return sum / double(x.size());
}

/// Return the maximum length of the vectors, which does not depend on the axes.
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

  /// Fit the motion by least squares over the nodes, all with the same weight.
  RigidMotion(const Nodes<dim> &X, const Nodes<dim> &u, const mesh::Idealization &idealization)
    : translation(mean(u))
  {
    if (idealization.is_axisymmetric())
      {
        // In axisymmetric models only the motion along the axis is rigid.
        translation[0] = 0.;
        return;
      }
    // c = (R'R)^-1 R'u holds for rotations about the mean of the nodes, where rotations are
    // orthogonal to translations, so that each part is computed alone.
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
  // A translation changes no element quantity, but would reduce the step of the deformation and
  // increase the share of rounding.
  auto shift = mean(V);
  if (idealization.is_axisymmetric())
    shift[0] = 0.;
  Nodes deforming = V;
  for (auto &v : deforming)
    v -= shift;
  // The node with the maximum velocity moves by `step` times the size of the element.
  const double largest = largest_norm(deforming);
  // The element is only translated, so all derivatives vanish.
  if (largest == 0.)
    return Nodes(X.size());
  // The size is the diagonal, because the first and last node in tensor order are opposite corners.
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
  // If refined, use u - R c. It is small where the cell moves almost rigidly, and so is the error.
  Nodes deforming = u;
  if (refined)
    {
      const RigidMotion<dim> rigid(X, u, idealization);
      const auto             centre = mean(X);
      Nodes                  R_change(X.size()); // R' c
      for (unsigned int a = 0; a < X.size(); ++a)
        {
          deforming[a] -= rigid.translation + turned(rigid.rotation, X[a] - centre);
          // R' c is the derivative of omega x (X_a - centre). The motion of the center adds a
          // translation, which K annihilates.
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
