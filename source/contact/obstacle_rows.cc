#include <snug/base/errors.h>
#include <snug/contact/obstacle_rows.h>
#include <snug/faces/tributary.h>

#include <sstream>

namespace snug::contact {
template <int dim>
ObstacleRows<dim>::ObstacleRows(const PairGeometry<dim> &pair)
  : surface(pair.surface)
  , shape(pair.shape)
  , obstacle(choose(obstacle_table<dim>(), pair.pair.obstacle->shape)
               .make(*pair.pair.obstacle, pair.slave_size()))
  , shift(to_point<dim>(pair.pair.obstacle->displacement))
  , slave_faces(pair.sides.slave)
{
  const Opposition<dim> opposition(pair);
  std::vector<bool>     visited = pair.taken;
  for (const unsigned int face : slave_faces)
    for (const unsigned int node : surface.faces()[face].nodes)
      {
        // Hanging nodes follow their masters, which have rows; `taken` are rows of an earlier pair
        // with the same obstacle.
        if (visited[node] || !surface.masters(node).empty())
          continue;
        visited[node] = true;
        const auto d  = obstacle->distance(dealii::Point<dim>(pair.positions[node]));
        if (d && opposition.holds(node, d->value, -d->gradient))
          slave_nodes.push_back(node);
      }
}

template <int dim>
const std::vector<unsigned int> &ObstacleRows<dim>::slaves() const
{
  return slave_nodes;
}

template <int dim>
ObstacleDistance<dim> ObstacleRows<dim>::distance(const dealii::Tensor<1, dim> &x) const
{
  const auto result = obstacle->distance(dealii::Point<dim>(x));
  if (result)
    return *result;
  std::ostringstream message;
  message << "the node at (" << x << ") has no closest point on the obstacle it was paired with";
  throw TangledMesh(message.str());
}

template <int dim>
std::vector<Row<dim>> ObstacleRows<dim>::rows(const Field &positions) const
{
  std::vector<Row<dim>> result;
  for (const unsigned int slave : slave_nodes)
    {
      const auto                   d = distance(positions[slave]);
      const dealii::Tensor<1, dim> n = -d.gradient;
      // n . (u - w) <= d(x): the obstacle moved by w is met with the normal at its place before.
      result.push_back({{{slave, n}}, d.value + n * shift, n});
    }
  return result;
}

template <int dim>
std::vector<Row<dim>> ObstacleRows<dim>::row_derivatives(const Field &positions,
                                                         const Field &velocity) const
{
  std::vector<Row<dim>> result;
  for (const unsigned int slave : slave_nodes)
    {
      const auto d = distance(positions[slave]);
      // n = -grad d
      const dealii::Tensor<1, dim> dn   = -1. * (d.hessian * velocity[slave]);
      const double                 dgap = d.gradient * velocity[slave] + dn * shift;
      result.push_back({{{slave, dn}}, dgap, dn});
    }
  return result;
}

template <int dim>
void ObstacleRows<dim>::add_energy_gradient(const Field               &positions,
                                            const Field               &displacement,
                                            const std::vector<double> &forces,
                                            Field                     &gradient) const
{
  AssertDimension(forces.size(), slave_nodes.size());
  for (unsigned int i = 0; i < slave_nodes.size(); ++i)
    {
      const unsigned int slave = slave_nodes[i];
      const auto         d     = distance(positions[slave]);
      // of n . (u - w) - d
      // n = -grad d at x: its derivative is -H, and gap' = grad d.
      gradient[slave] -= forces[i] * (d.hessian * (displacement[slave] - shift) + d.gradient);
    }
}

template <int dim>
std::vector<double> ObstacleRows<dim>::areas(const Field &positions) const
{
  return faces::tributary_areas<dim>({surface, slave_faces, shape}, slave_nodes, positions);
}

template <int dim>
void ObstacleRows<dim>::add_area_gradient(const Field               &positions,
                                          const std::vector<double> &factors,
                                          Field                     &gradient) const
{
  faces::add_tributary_gradient<dim>({surface, slave_faces, shape}, slave_nodes, positions, factors,
                                     gradient);
}

template class ObstacleRows<2>;
template class ObstacleRows<3>;
} // namespace snug::contact
