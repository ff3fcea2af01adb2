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
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (nodes[i].follows)
      {
        const Node &node = nodes[i];
        // Reactions belong to orthonormal directions, but normals and the directions about an axis
        // are given directions d_j. Add the derivative of d_j . u - v_j with constant v_j.
        const auto multipliers =
          Orthonormalised<dim>(given_frame(node, x, n)).given_multipliers(reactions[i]);
        for (unsigned int j = 0; j < node.holds.size(); ++j)
          {
            const Hold &hold = node.holds[j];
            const auto  of_d = multipliers[j] * u[node.surface_node];
            at_surface[node.surface_node] +=
              transpose(hold.component.derivative(x[node.surface_node])) * of_d;
            if (hold.component.is_normal())
              normal_gradients[hold.side][node.surface_node] += of_d;
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
  for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      const auto frame       = given_frame(nodes[i], x, n);
      const auto multipliers = Orthonormalised<dim>(frame).given_multipliers(reactions[i]);
      for (unsigned int j = 0; j < multipliers.size(); ++j)
        // From K u + B'lambda = f, a multiplier acts against its direction.
        result.push_back({nodes[i].holds[j].face, bodies[nodes[i].surface_node],
                          x[nodes[i].surface_node], -multipliers[j] * frame.directions[j]});
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
  const auto            &q = constant_frames[held_node].directions;
  dealii::Tensor<2, dim> of_boundary, of_others;
  for (unsigned int j = 0; j < q.size(); ++j)
    if (const Hold &hold = nodes[held_node].holds[j]; !hold.component.follows_positions())
      (hold.boundary == boundary ? of_boundary : of_others) += outer_product(q[j], q[j]);
    else if (hold.boundary == boundary)
      return dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) - of_others;
    else
      break;
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
