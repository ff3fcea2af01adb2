#include <snug/supports/dirichlet_constraints.h>

#include <algorithm>

namespace snug::supports {
template <int dim>
void DirichletConstraints<dim>::add_energy_gradient(
  const Field                            &positions,
  const Field                            &displacement,
  const std::vector<std::vector<double>> &reactions,
  Field                                  &gradient) const
{
  if (!follow_positions())
    return;
  const auto                x = surface.gather(positions);
  const auto                u = surface.gather(displacement);
  const auto                n = normals(x);
  std::vector<SurfaceField> normal_gradients(sides.size(), SurfaceField(surface.n_nodes()));
  SurfaceField              at_surface(surface.n_points());
  for (unsigned int i = 0; i < n_nodes(); ++i)
    if (follows_positions(i))
      {
        const unsigned int node = surface_nodes[i], first = first_hold[i];
        // Reactions belong to orthonormal directions, but normals and the directions about an axis
        // are given directions d_j. Add the derivative of d_j . u - v_j with constant v_j.
        const auto multipliers =
          Orthonormalised<dim>(given_frame(i, x, n)).given_multipliers(reactions[i]);
        for (unsigned int j = 0; j < multipliers.size(); ++j)
          {
            const auto of_d = multipliers[j] * u[node];
            at_surface[node] += transpose(component(first + j).derivative(x[node])) * of_d;
            if (component(first + j).is_normal())
              normal_gradients[holds[first + j].side][node] += of_d;
          }
      }
  for (unsigned int side = 0; side < sides.size(); ++side)
    n[side].add_transpose(normal_gradients[side], at_surface);
  surface.add_owned(at_surface, gradient);
}

/// Convert the reactions, which belong to orthonormal directions, to the directions of the
/// supports.
template <int dim>
std::vector<typename DirichletConstraints<dim>::Force>
DirichletConstraints<dim>::forces(const Field                            &positions,
                                  const std::vector<std::vector<double>> &reactions) const
{
  const auto         x      = surface.gather(positions);
  const auto         n      = normals(x);
  const auto         bodies = surface.bodies_of_points();
  std::vector<Force> result;
  for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      const auto node        = surface_nodes[i];
      const auto frame       = given_frame(i, x, n);
      const auto multipliers = Orthonormalised<dim>(frame).given_multipliers(reactions[i]);
      for (unsigned int j = 0; j < multipliers.size(); ++j)
        // From K u + B'lambda = f, a multiplier acts against its direction.
        result.push_back({holders[holds[first_hold[i] + j].holder].face, bodies[node], x[node],
                          -multipliers[j] * frame.directions[j]});
    }
  return result;
}

template <int dim>
dealii::Tensor<2, dim> DirichletConstraints<dim>::reaction_directions(
  const unsigned int                           global_node,
  const std::pair<unsigned int, unsigned int> &boundary) const
{
  const unsigned int held_node = find(global_node);
  if (held_node == n_nodes())
    return {};
  // Constant directions come first, so that they are orthonormal among themselves.
  const unsigned int         first = first_hold[held_node], n = n_constant(held_node);
  const Orthonormalised<dim> constant(
    given_frame(surface_nodes[held_node], first, first + n, surface.reference_positions(), {}));
  const auto &q              = constant.frame().directions;
  const auto  is_of_boundary = [&](const unsigned int j) {
    return holders[holds[first + j].holder].boundary == boundary;
  };
  dealii::Tensor<2, dim> of_boundary, of_others;
  for (unsigned int j = 0; j < n; ++j)
    (is_of_boundary(j) ? of_boundary : of_others) += outer_product(q[j], q[j]);
  if (follows_positions(held_node) && is_of_boundary(n))
    return dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) - of_others;
  return of_boundary;
}

#define SNUG_INSTANTIATE(dim)                                                                \
  template void DirichletConstraints<dim>::add_energy_gradient(                              \
    const Field &, const Field &, const std::vector<std::vector<double>> &, Field &) const;  \
  template std::vector<typename DirichletConstraints<dim>::Force>                            \
  DirichletConstraints<dim>::forces(const Field &, const std::vector<std::vector<double>> &) \
    const;                                                                                   \
  template dealii::Tensor<2, dim> DirichletConstraints<dim>::reaction_directions(            \
    unsigned int, const std::pair<unsigned int, unsigned int> &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::supports
