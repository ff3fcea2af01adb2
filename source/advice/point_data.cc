#include <snug/advice/point_data.h>

#include <algorithm>
#include <cmath>

namespace snug::advice {
namespace {
/// Tolerance relative to the maximum of the data. Loads that break a symmetry by a thousandth are
/// found.
constexpr double tolerance = 1e-6;

const unsigned int points_per_boundary = 64;
} // namespace

template <int dim>
PointData<dim>::PointData(const Subject<dim> &subject, const TrueBodies<dim> &bodies)
  : subject(subject)
  , surface_points(bodies.surface_points(points_per_boundary))
  , inner_points(bodies.inner_points(points_per_boundary))
  , length(bodies.size())
{
  for (const auto &pair : subject.model().pairs)
    {
      gaps.emplace_back("Gap", pair.parameters.gap);
      obstacles.push_back(pair.obstacle
                            ? choose(contact::obstacle_table<dim>(), pair.obstacle->shape)
                                .make(*pair.obstacle, 0.01 * length)
                            : nullptr);
    }
  const auto raise = [](double &largest, const double value) {
    largest = std::max(largest, value);
  };
  for (unsigned int c = 0; c < subject.model().load_cases.size(); ++c)
    for (const auto *points : {&surface_points, &inner_points})
      for (const auto &at : *points)
        {
          const auto of = actions(at, c);
          raise(prescribed, of.prescribed.norm());
          raise(traction, of.traction.norm());
          raise(body_force, of.body_force.norm());
          raise(force, of.force.norm());
          raise(moment, of.moment.norm());
        }
  for (const auto &at : surface_points)
    for (const auto &touch : touches(at))
      raise(gap, std::abs(touch.gap));
}

template <int dim>
const elasticity::Material &PointData<dim>::material(const Place<dim> &at) const
{
  return subject.model()
    .bodies[at.body]
    .materials[subject.mesh().geometry(at.body).region(at.cell)];
}

template <int dim>
dealii::Tensor<2, dim> PointData<dim>::held(const Place<dim> &at) const
{
  std::vector<Vector> basis;
  for (const auto &support : subject.model().supports)
    if (support.body == at.body && support.boundary == at.boundary && at.normal.norm() > 0.)
      {
        Vector direction;
        if (support.component == dim)
          direction = at.normal;
        else
          direction[support.component] = 1.;
        for (const auto &other : basis)
          direction -= (direction * other) * other;
        if (direction.norm() > 1e-3)
          basis.push_back(direction / direction.norm());
      }
  dealii::Tensor<2, dim> P;
  for (const auto &direction : basis)
    P += outer_product(direction, direction);
  return P;
}

/// Prescribed components are those of supports, whose directions are at right angles or, at oblique
/// faces, differ in the same way on both sides of a symmetry.
template <int dim>
typename PointData<dim>::Actions PointData<dim>::actions(const Place<dim>  &at,
                                                         const unsigned int load_case) const
{
  Actions     result;
  const auto &loads   = subject.model().load_cases[load_case].bodies[at.body];
  const bool  surface = at.normal.norm() > 0.;
  if (!surface)
    {
      if (loads.body_force)
        result.body_force = loads.body_force(at.x);
      result.body_force += material(at).density * loads.gravity;
      return result;
    }
  for (const auto &support : subject.model().supports)
    if (support.body == at.body && support.boundary == at.boundary && support.values[load_case])
      {
        const double value = support.values[load_case](at.x);
        if (support.component == dim)
          result.prescribed += value * at.normal;
        else
          result.prescribed[support.component] += value;
      }
  const auto found = loads.boundaries.find(at.boundary);
  if (found == loads.boundaries.end())
    return result;
  const auto &load = found->second;
  if (load.traction)
    result.traction = load.traction(at.x);
  if (load.pressure)
    result.traction -= load.pressure(at.x) * at.normal;
  result.force  = load.resultant.force;
  result.moment = load.resultant.moment;
  return result;
}

template <int dim>
std::vector<typename PointData<dim>::Touch> PointData<dim>::touches(const Place<dim> &at) const
{
  std::vector<Touch> result;
  for (unsigned int p = 0; p < gaps.size(); ++p)
    {
      const auto &pair = subject.model().pairs[p];
      if (!pair.slave.has({at.body, at.boundary}) && !pair.master.has({at.body, at.boundary}))
        continue;
      Touch touch{gaps[p].value(at.x), 0., {}, {}, bool(obstacles[p])};
      if (obstacles[p])
        if (const auto found = obstacles[p]->distance(at.x))
          {
            touch.distance = found->value;
            touch.normal   = found->gradient;
            for (unsigned int d = 0; d < pair.obstacle->displacement.size(); ++d)
              touch.motion[d] = pair.obstacle->displacement[d];
          }
      result.push_back(touch);
    }
  return result;
}

template <int dim>
bool PointData<dim>::is_in_contact(const Place<dim> &at) const
{
  return !touches(at).empty();
}

template <int dim>
bool PointData<dim>::is_free_of_loads(const Place<dim> &at) const
{
  for (unsigned int c = 0; c < subject.model().load_cases.size(); ++c)
    {
      const auto of = actions(at, c);
      if (of.prescribed.norm() + of.traction.norm() + of.force.norm() + of.moment.norm() > 0.)
        return false;
    }
  return true;
}

template <int dim>
bool PointData<dim>::same_touches(const Place<dim>             &from,
                                  const Place<dim>             &to,
                                  const dealii::Tensor<2, dim> &Q) const
{
  const auto here = touches(from), there = touches(to);
  const auto same = [&](const Touch &a, const Touch &b) {
    return a.has_obstacle == b.has_obstacle && std::abs(a.gap - b.gap) <= tolerance * gap &&
           std::abs(a.distance - b.distance) <= tolerance * length &&
           (Q * a.normal - b.normal).norm() <= 1e-3 &&
           (Q * a.motion - b.motion).norm() <= tolerance * a.motion.norm();
  };
  return here.size() == there.size() &&
         std::all_of(here.begin(), here.end(), [&](const Touch &touch) {
           return std::any_of(there.begin(), there.end(),
                              [&](const Touch &other) { return same(touch, other); });
         });
}

template <int dim>
bool PointData<dim>::same_material(const Place<dim> &from, const Place<dim> &to) const
{
  const auto &a = material(from), &b = material(to);
  return a.youngs_modulus == b.youngs_modulus && a.poissons_ratio == b.poissons_ratio &&
         a.density == b.density &&
         subject.model().bodies[from.body].formulation ==
           subject.model().bodies[to.body].formulation;
}

template <int dim>
bool PointData<dim>::agree(const Place<dim>             &from,
                           const Place<dim>             &to,
                           const dealii::Tensor<2, dim> &Q) const
{
  if (!same_material(from, to) || !same_touches(from, to, Q) ||
      (Q * held(from) * transpose(Q) - held(to)).norm() > 1e-3)
    return false;
  // moments are axial: a mirror turns them over
  dealii::Tensor<2, 3> axial;
  axial[2][2] = 1.;
  for (unsigned int i = 0; i < dim && dim == 3; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      axial[i][j] = Q[i][j];
  axial *= determinant(Q);
  for (unsigned int c = 0; c < subject.model().load_cases.size(); ++c)
    {
      const auto a = actions(from, c), b = actions(to, c);
      if ((Q * a.prescribed - b.prescribed).norm() > tolerance * prescribed ||
          (Q * a.traction - b.traction).norm() > tolerance * traction ||
          (Q * a.body_force - b.body_force).norm() > tolerance * body_force ||
          (Q * a.force - b.force).norm() > tolerance * force ||
          (axial * a.moment - b.moment).norm() > tolerance * moment)
        return false;
    }
  return true;
}

template class PointData<2>;
template class PointData<3>;
} // namespace snug::advice
