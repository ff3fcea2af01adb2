#include <snug/base/assertions.h>
#include <snug/elasticity/element.h>
#include <snug/elasticity/stress.h>


namespace snug::elasticity {
namespace {
/// Identity tensor in space for all idealizations, like the gradients.
const dealii::SymmetricTensor<2, 3> identity = dealii::unit_symmetric_tensor<3>();
} // namespace

/// Return the derivatives, exact for the quadrature as well as for the integral, because Gauss
/// points move with the cell.
template <int dim>
std::vector<typename Element<dim>::Nodes>
Element<dim>::internal_force_derivatives(const Nodes              &X,
                                         const std::vector<Nodes> &velocities,
                                         const Material           &material,
                                         const Nodes              &u) const
{
  const auto                        points = gauss_points(X);
  const auto                        states = point_states(points, material, u);
  std::vector<Nodes>                result;
  std::vector<dealii::Tensor<2, 3>> grad_V(points.size());
  std::vector<double>               dilatation(points.size());
  for (const Nodes &V : velocities)
    {
      // Project the derivative of div u in the moving cell.
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          grad_V[q] = points[q].gradient(V);
          // (pi div u)' = pi ((div u)' - theta div V) follows from differentiating int psi_i (pi
          // div u - div u) dV = 0 along V, with functions psi_i that move with the cell.
          dilatation[q] =
            -trace(states[q].gradient * grad_V[q]) - states[q].theta * trace(grad_V[q]);
        }
      take_dilatation(points, dilatation);
      result.emplace_back(n_nodes());
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const auto &state = states[q];
          // (grad u)' at fixed nodal values
          const dealii::Tensor<2, 3> grad_u = -1. * state.gradient * grad_V[q];
          const dealii::Tensor<2, 3> stress = state.stress;
          const double               theta  = dilatation[q] - trace(grad_u);
          // derivative of (dV stress g_a) = dV (change g_a)
          // (g_a)' = -(grad V)' g_a and (dV)' = dV div V, collected in a tensor that acts on g_a
          const dealii::Tensor<2, 3> change =
            cauchy_stress(material,
                          strain(idealization, material, grad_u) + theta / 3. * identity) +
            trace(grad_V[q]) * stress - stress * transpose(grad_V[q]);
          points[q].add_flux(change, result.back());
        }
    }
  return result;
}

/// Compute Eshelby's energy-momentum tensor of w'Ku. The flux of this tensor through the shape
/// functions is the gradient with respect to the node positions. It is symmetric in u and w.
template <int dim>
void Element<dim>::add_energy_gradient(const Nodes    &X,
                                       const Material &material,
                                       const Nodes    &u,
                                       const Nodes    &w,
                                       const double    factor,
                                       Nodes          &gradient) const
{
  const auto points   = gauss_points(X);
  const auto states_u = point_states(points, material, u);
  const auto states_w = point_states(points, material, w);
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      const auto                &of_u     = states_u[q];
      const auto                &of_w     = states_w[q];
      const dealii::Tensor<2, 3> stress_u = of_u.stress;
      const dealii::Tensor<2, 3> stress_w = of_w.stress;
      const double               density =
        // sigma_u : grad w contains p_u div w. The other part of the stationary integral of B-bar
        // is theta_u p_w with p_w = tr(sigma_w)/3.
        scalar_product(stress_u, of_w.gradient) - of_u.theta * trace(stress_w) / 3.;
      const dealii::Tensor<2, 3> energy_momentum = density * identity -
                                                   transpose(of_w.gradient) * stress_u -
                                                   transpose(of_u.gradient) * stress_w;
      points[q].add_flux(factor * energy_momentum, gradient);
    }
}

template <int dim>
void Element<dim>::body_force_derivative(const Nodes &X,
                                         const Nodes &V,
                                         const Nodes &b,
                                         Nodes       &f) const
{
  SNUG_ASSERT_EQUAL(b.size(), gauss.size());
  f.assign(n_nodes(), {});
  const auto points = gauss_points(X);
  for (unsigned int q = 0; q < points.size(); ++q)
    // (dV)' = dV div V, and b is fixed to the material and does not change.
    points[q].add_source(trace(points[q].gradient(V)) * b[q], f);
}

template <int dim>
void Element<dim>::add_body_force_gradient(const Nodes &X,
                                           const Nodes &b,
                                           const Nodes &u,
                                           const double factor,
                                           Nodes       &gradient) const
{
  SNUG_ASSERT_EQUAL(b.size(), gauss.size());
  const auto points = gauss_points(X);
  for (unsigned int q = 0; q < points.size(); ++q)
    // The flux uses identity : grad V = div V.
    points[q].add_flux(factor * (value(points[q].shape, u) * b[q]) * identity, gradient);
}

template <int dim>
void Element<dim>::add_volume_gradient(const Nodes &X, const double factor, Nodes &gradient) const
{
  for (const auto &point : gauss_points(X))
    point.add_flux(factor * identity, gradient);
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template std::vector<Element<dim>::Nodes> Element<dim>::internal_force_derivatives(              \
    const Nodes &, const std::vector<Nodes> &, const Material &, const Nodes &) const;             \
  template void Element<dim>::add_energy_gradient(const Nodes &, const Material &, const Nodes &,  \
                                                  const Nodes &, double, Nodes &) const;           \
  template void Element<dim>::body_force_derivative(const Nodes &, const Nodes &, const Nodes &,   \
                                                    Nodes &) const;                                \
  template void Element<dim>::add_body_force_gradient(const Nodes &, const Nodes &, const Nodes &, \
                                                      double, Nodes &) const;                      \
  template void Element<dim>::add_volume_gradient(const Nodes &, double, Nodes &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::elasticity
