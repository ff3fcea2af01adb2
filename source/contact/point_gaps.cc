#include <snug/contact/point_gaps.h>
#include <snug/contact/projection.h>

namespace snug::contact {
template <int dim>
PointGaps<dim>::PointGaps(const PairGeometry<dim> &pair,
                          const JoinedPair        &joined,
                          const Formulas          &formulas)
  : positions(pair.positions)
  , joined(joined)
  , formulas(formulas)
  , surface(pair.surface)
  , slave_motion(pair.slave_motion)
  , sides(pair.sides)
{
  if (pair.pair.obstacle)
    {
      obstacle = pair.obstacle();
      shift    = pair.obstacle_displacement();
      return;
    }
  normals   = std::make_unique<PairNormals<dim>>(pair.surface, pair.shape, sides,
                                                 pair.has_mean_normals(), positions, pair.held);
  projector = std::make_unique<Projector<dim>>(pair.surface, sides.master, pair.shape, positions,
                                               normals->values().master);
  if (pair.pair.parameters.method == Method::mortar && !pair.has_mean_normals())
    slave_normals = std::make_unique<faces::NodalNormals<dim>>(pair.surface, sides.slave,
                                                               pair.shape, positions, &pair.held);
}

template <int dim>
PointGaps<dim>::~PointGaps() = default;

/// Return the point of the master's true surface over the foot point.
template <int dim>
dealii::Tensor<1, dim> PointGaps<dim>::place(const PointProjection<dim> &projection) const
{
  dealii::Tensor<1, dim> y;
  for (const auto &[point, weight] : projection.surface)
    y += weight * positions[point];
  return y;
}

/// Return the projection of @p x along the slave's normal. Each step moves the point along the
/// slave's normal to the height of its foot point and projects it along the master's normals. A
/// step multiplies the error by the square of the angle between the two normals.
template <int dim>
std::optional<PointProjection<dim>>
PointGaps<dim>::project(const dealii::Tensor<1, dim> &x,
                        const dealii::Tensor<1, dim> &slave_normal) const
{
  auto result = projector->onto(x, {});
  for (unsigned int step = 0; step < 3 && result; ++step)
    result = projector->onto(x + (slave_normal * (place(*result) - x)) /
                                   slave_normal.norm_square() * slave_normal,
                             {});
  return result;
}

template <int dim>
std::optional<PointGap<dim>> PointGaps<dim>::at(const dealii::Tensor<1, dim> &x,
                                                const Weights                &slave,
                                                const Boundary               &boundary) const
{
  PointGap<dim> result;
  Boundary      master;
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
      // The normal of the slave, which PairNormals contain only if they are means.
      const auto &of_slave = slave_normals ? slave_normals->normals() : normals->values().slave;
      for (const auto &[node, weight] : slave)
        result.normal += weight * of_slave[node];
      const auto nearest =
        slave_normals ? project(x, result.normal) : projector->onto(x, result.normal);
      if (!nearest)
        return {};
      if (!slave_normals)
        for (const auto &[node, weight] : nearest->masters)
          result.normal -= weight * normals->values().master[node];
      // Normalize, because interpolated normals are shorter between nodes, as in mortar rows, and
      // an offset is too large in comparison.
      result.normal /= result.normal.norm();
      result.gap       = result.normal * (place(*nearest) - x) + nearest->softening;
      result.masters   = nearest->masters;
      const auto &face = surface.faces()[nearest->face];
      master           = {face.body, face.boundary};
    }
  result.pair = joined.pair_of(boundary, master);
  result.gap += offset(result.pair, x);
  return result;
}

/// Return the gap formula of a pair of the scene at @p x in space.
template <int dim>
double PointGaps<dim>::offset(const unsigned int pair, const dealii::Tensor<1, dim> &x) const
{
  return formulas[pair] ? formulas[pair]->value(dealii::Point<dim>(slave_motion.point_back(x)))
                        : 0.;
}

template <int dim>
double PointGaps<dim>::given(const dealii::Tensor<1, dim> &x, const Boundary &boundary) const
{
  double result = offset(joined.pair_of(boundary, {}), x);
  if (obstacle)
    if (const auto d = obstacle->distance(dealii::Point<dim>(x)))
      result += d->value;
  return result;
}

template class PointGaps<2>;
template class PointGaps<3>;
} // namespace snug::contact
