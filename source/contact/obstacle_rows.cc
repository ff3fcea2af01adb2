#include <snug/base/errors.h>
#include <snug/contact/node_rows.h>
#include <snug/contact/pair_rows.h>

#include <sstream>

namespace snug::contact {
namespace {
/// The formula of rows against an obstacle for NodeRows.
template <int dim>
class ObstacleRow
{
public:
  explicit ObstacleRow(const PairGeometry<dim> &pair)
    : obstacle(pair.obstacle()), shift(pair.obstacle_displacement())
  {
    const SearchCriteria<dim> criteria(pair);
    std::vector<bool>         visited = pair.taken;
    const auto                without_area =
      faces::nodes_without_area<dim>({pair.surface, pair.sides.slave, pair.shape}, pair.positions);
    for (const unsigned int face : pair.sides.slave)
      for (const unsigned int node : pair.surface.faces()[face].nodes)
        {
          // Hanging nodes follow their masters, which have rows. Nodes in `taken` have a row in
          // another pair with the same obstacle.
          if (visited[node] || !pair.surface.masters(node).empty())
            continue;
          visited[node] = true;
          const auto d  = obstacle->distance(dealii::Point<dim>(pair.positions[node]));
          if (!d || !criteria.are_met(node, d->value, -d->gradient))
            continue;
          // A row of a node without an area would hold the node, but show no pressure.
          (without_area[node] ? nodes.zero_area : nodes.with_rows).push_back(node);
        }
  }

  SlaveNodes nodes;

  template <typename Number>
  Row<dim, Number> row(const unsigned int                    i,
                       const faces::PointField<dim, Number> &positions,
                       const NormalFields<dim, Number> & /*normals*/) const
  {
    const unsigned int                   slave = nodes.with_rows[i];
    const auto                           d     = distance(positions.values()[slave]);
    const dealii::Tensor<1, dim, Number> dx    = positions[slave] - positions.values()[slave];
    // Value and gradient at x with their first derivatives; the value of dx is 0.
    const Number                         value = d.value + d.gradient * dx;
    const dealii::Tensor<1, dim, Number> n     = -(d.gradient + d.hessian * dx);
    // The row is n . (u - w) <= d(x): contact with the obstacle moved by w uses the normal at the
    // place of the obstacle before.
    return {{{slave, n}}, value + n * shift, n};
  }

private:
  std::unique_ptr<Obstacle<dim>> obstacle;
  dealii::Tensor<1, dim>         shift; ///< w

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
  return std::make_unique<NodeRows<dim, ObstacleRow<dim>>>(pair);
}

template std::unique_ptr<RowGroup<2>> obstacle_rows(const PairGeometry<2> &);
template std::unique_ptr<RowGroup<3>> obstacle_rows(const PairGeometry<3> &);
} // namespace snug::contact
