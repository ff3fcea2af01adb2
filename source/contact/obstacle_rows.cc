#include <snug/base/errors.h>
#include <snug/contact/pair_rows.h>
#include <snug/faces/tributary.h>

#include <sstream>

namespace snug::contact {
namespace {
template <int dim>
class ObstacleRows : public RowGroup<dim>
{
public:
  using Field = typename RowGroup<dim>::Field;

  explicit ObstacleRows(const PairGeometry<dim> &pair)
    : surface(pair.surface)
    , shape(pair.shape)
    , obstacle(choose(obstacle_table<dim>(), pair.pair.obstacle->shape)
                 .make(*pair.pair.obstacle, pair.slave_size()))
    , shift(to_point<dim>(pair.pair.obstacle->displacement))
    , slave_faces(pair.sides.slave)
  {
    const SearchCriteria<dim> criteria(pair);
    std::vector<bool>         visited = pair.taken;
    for (const unsigned int face : slave_faces)
      for (const unsigned int node : surface.faces()[face].nodes)
        {
          // Hanging nodes follow their masters, which have rows. Nodes in `taken` have a row in
          // another pair with the same obstacle.
          if (visited[node] || !surface.masters(node).empty())
            continue;
          visited[node] = true;
          const auto d  = obstacle->distance(dealii::Point<dim>(pair.positions[node]));
          if (!d || !criteria.are_met(node, d->value, -d->gradient))
            continue;
          // A row of a node without an area would hold the node, but show no pressure.
          const bool has_area =
            !faces::is_without_area(surface, shape.degree(), pair.positions[node]);
          (has_area ? slave_nodes : zero_area_nodes).push_back(node);
        }
  }

  const std::vector<unsigned int> &slaves() const override { return slave_nodes; }

  std::vector<DependentMultiplier> dependent_multipliers() const override
  {
    return dependent_on_axis(surface, slave_faces, slave_nodes, zero_area_nodes);
  }

  std::vector<Row<dim>> rows(const Field &positions) const override
  {
    std::vector<Row<dim>> result;
    for (const unsigned int slave : slave_nodes)
      {
        const auto                   d = distance(positions[slave]);
        const dealii::Tensor<1, dim> n = -d.gradient;
        // The row is n . (u - w) <= d(x): contact with the obstacle moved by w uses the normal at
        // the place of the obstacle before.
        result.push_back({{{slave, n}}, d.value + n * shift, n});
      }
    return result;
  }

  std::vector<Row<dim>> row_derivatives(const Field &positions,
                                        const Field &velocity) const override
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

  void add_energy_gradient(const Field               &positions,
                           const Field               &displacement,
                           const std::vector<double> &forces,
                           Field                     &gradient) const override
  {
    AssertDimension(forces.size(), slave_nodes.size());
    for (unsigned int i = 0; i < slave_nodes.size(); ++i)
      {
        const unsigned int slave = slave_nodes[i];
        const auto         d     = distance(positions[slave]);
        // Differentiate n . (u - w) - d with n = -grad d at x: the derivative of n is -H, and that
        // of d is grad d.
        gradient[slave] -= forces[i] * (d.hessian * (displacement[slave] - shift) + d.gradient);
      }
  }

  std::vector<double> areas(const Field &positions) const override
  {
    return faces::tributary_areas<dim>({surface, slave_faces, shape}, slave_nodes, positions);
  }

  void add_area_gradient(const Field               &positions,
                         const std::vector<double> &factors,
                         Field                     &gradient) const override
  {
    faces::add_tributary_gradient<dim>({surface, slave_faces, shape}, slave_nodes, positions,
                                       factors, gradient);
  }

private:
  const mesh::Surface<dim>      &surface;
  const faces::FaceShape<dim>   &shape;
  std::unique_ptr<Obstacle<dim>> obstacle;
  dealii::Tensor<1, dim>         shift; ///< w
  std::vector<unsigned int>      slave_faces, slave_nodes;
  std::vector<unsigned int>
    zero_area_nodes; ///< slave nodes opposite to the obstacle, but without an area

  ObstacleDistance<dim> distance(const dealii::Tensor<1, dim> &x) const
  {
    const auto result = obstacle->distance(dealii::Point<dim>(x));
    if (result)
      return *result;
    std::ostringstream message;
    message << "the node at (" << x << ") has no closest point on the obstacle it was paired with";
    throw TangledMesh(message.str());
  }
};
} // namespace

template <int dim>
std::unique_ptr<RowGroup<dim>> obstacle_rows(const PairGeometry<dim> &pair)
{
  return std::make_unique<ObstacleRows<dim>>(pair);
}

template std::unique_ptr<RowGroup<2>> obstacle_rows(const PairGeometry<2> &);
template std::unique_ptr<RowGroup<3>> obstacle_rows(const PairGeometry<3> &);
} // namespace snug::contact
