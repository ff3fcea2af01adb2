#include <snug/contact/point_gaps.h>
#include <snug/contact/projection.h>

namespace snug::contact {
template <int dim>
PointGaps<dim>::PointGaps(const PairGeometry<dim> &pair) : positions(pair.positions)
{
  const auto &parameters = pair.pair.parameters;
  if (parameters.gap != "0")
    offset = std::make_unique<geometry::Formula<dim>>("Gap", parameters.gap);
  if (pair.pair.obstacle)
    {
      obstacle = choose(obstacle_table<dim>(), pair.pair.obstacle->shape)
                   .make(*pair.pair.obstacle, pair.slave_size());
      shift = to_point<dim>(pair.pair.obstacle->displacement);
      return;
    }
  master_faces = pair.sides.master;
  normals      = std::make_unique<SupportedNormals<dim>>(pair.surface, master_faces, pair.shape,
                                                    positions, pair.held);
  projector    = std::make_unique<Projector<dim>>(pair.surface, master_faces, pair.shape, positions,
                                               normals->normals());
}

template <int dim>
PointGaps<dim>::~PointGaps() = default;

template <int dim>
std::optional<PointGap<dim>> PointGaps<dim>::at(const dealii::Tensor<1, dim> &x) const
{
  PointGap<dim> result;
  if (obstacle)
    {
      const auto d = obstacle->distance(dealii::Point<dim>(x));
      if (!d)
        return {};
      result.normal = -d->gradient;
      result.gap    = d->value + result.normal * shift;
    }
  else
    {
      const auto foot = projector->onto(x);
      if (!foot)
        return {};
      dealii::Tensor<1, dim> to_master = -1. * x;
      for (const auto &[node, weight] : foot->masters)
        result.normal -= weight * normals->normals()[node];
      for (const auto &[point, weight] : foot->surface)
        to_master += weight * positions[point];
      result.normal /= result.normal.norm();
      result.gap     = result.normal * to_master + foot->relief;
      result.masters = foot->masters;
    }
  if (offset)
    result.gap += offset->value(dealii::Point<dim>(x));
  return result;
}

template class PointGaps<2>;
template class PointGaps<3>;
} // namespace snug::contact
