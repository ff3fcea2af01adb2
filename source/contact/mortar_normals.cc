#include <snug/contact/mortar_normals.h>
#include <snug/contact/opposite_faces.h>

#include <deal.II/base/numbers.h>

namespace snug::contact {
template <int dim>
MortarNormals<dim>::MortarNormals(const PairGeometry<dim> &pair)
  : surface(pair.surface)
  , shape(pair.shape)
  , sides(pair.sides)
  , held(pair.held)
  , has_mean_normals(pair.has_mean_normals())
{
  if (!has_mean_normals || sides.master.empty())
    return;
  const PairNormals<dim> normals(pair);
  const auto            &values = normals.values();
  const Projector<dim>   projector(surface, sides.master, shape, pair.positions, values.master);
  const double           least_cosine = std::cos(steepest_angle / 180. * dealii::numbers::PI);
  std::vector<bool>      visited(surface.n_nodes(), false);
  for (const unsigned int face : sides.slave)
    for (const unsigned int node : surface.faces()[face].nodes)
      {
        if (visited[node])
          continue;
        visited[node]            = true;
        const auto            &n = values.slave[node];
        const Projection<dim>  found{projector.nearest(pair.positions[node], n), node};
        dealii::Tensor<1, dim> of_master;
        for (const auto &[master, weight] : found.masters)
          of_master += weight * values.master[master];
        if (-(n * of_master) >= least_cosine * of_master.norm())
          projections.emplace_back(surface, shape, found, pair.positions, values);
      }
}

template <int dim>
template <typename Number>
mortar::MortarFace<dim, Number>
MortarNormals<dim>::slave_face(const unsigned int                    face,
                               const faces::PointField<dim, Number> &x,
                               const faces::PointField<dim, Number> &n) const
{
  auto result = mortar::mortar_face(surface, shape, face, x);
  if (!has_mean_normals)
    return result;
  typename faces::FaceShape<dim>::Coordinates middle;
  for (int a = 0; a < dim - 1; ++a)
    middle[a] = 0.5;
  const auto  values = shape.at(middle).value;
  const auto &nodes  = surface.faces()[face].nodes;
  auto       &sum    = result.direction.emplace();
  for (unsigned int k = 0; k < nodes.size(); ++k)
    for (int d = 0; d < dim; ++d)
      sum[d] += values[k] * n[nodes[k]][d];
  return result;
}

template <int dim>
MortarNormals<dim>::Values::Values(const MortarNormals &of, const Field &positions)
  : of(of)
  , positions(positions)
  , own(of.surface, of.sides.slave, of.shape, positions, &of.held)
  , unit(own.normals())
{
  if (!of.has_mean_normals)
    return;
  pair.emplace(of.surface, of.shape, of.sides, true, positions, of.held);
  const faces::PointField<dim, double> x(positions), n(pair->values().master),
    m(pair->values().slave);
  for (const auto &projection : of.projections)
    unit[projection.paired.slave] = projection.at(x, NormalFields<dim, double>{n, m}).normal;
}

template <int dim>
typename MortarNormals<dim>::Field
MortarNormals<dim>::Values::derivative(const Field &velocity) const
{
  using Number = faces::Differential<1>;
  auto result  = own.derivative(velocity);
  if (!pair)
    return result;
  const auto                           slopes = pair->derivative(velocity);
  const faces::PointField<dim, Number> x(positions, velocity),
    n(pair->values().master, slopes.master), m(pair->values().slave, slopes.slave);
  for (const auto &projection : of.projections)
    {
      const auto normal = projection.at(x, NormalFields<dim, Number>{n, m}).normal;
      for (int d = 0; d < dim; ++d)
        result[projection.paired.slave][d] = normal[d].slope[0];
    }
  return result;
}

template <int dim>
void MortarNormals<dim>::Values::add_transpose(const Field &of_normals, Field &gradient) const
{
  if (!pair)
    {
      own.add_transpose(of_normals, gradient);
      return;
    }
  Field                             of_own = of_normals;
  typename PairNormals<dim>::Fields of_pair{Field(of_own.size()), Field(of_own.size())};
  faces::Recording                  recording;
  for (const auto &projection : of.projections)
    {
      const unsigned int node = projection.paired.slave;
      of_own[node]            = {};
      if (of_normals[node].norm_square() == 0.)
        continue;
      recording.clear();
      const faces::PointField<dim, faces::Recorded> x(positions, recording),
        n(pair->values().master, recording), m(pair->values().slave, recording);
      recording.add(projection.at(x, NormalFields<dim, faces::Recorded>{n, m}).normal,
                    of_normals[node]);
      recording.sweep();
      x.add_derivatives(gradient);
      n.add_derivatives(of_pair.master);
      m.add_derivatives(of_pair.slave);
    }
  own.add_transpose(of_own, gradient);
  pair->add_transpose(of_pair, gradient);
}

template class MortarNormals<2>;
template class MortarNormals<3>;
#define SNUG_INSTANTIATE(dim, Number)                                                             \
  template mortar::MortarFace<dim, Number> MortarNormals<dim>::slave_face(                        \
    unsigned int, const faces::PointField<dim, Number> &, const faces::PointField<dim, Number> &) \
    const;
SNUG_INSTANTIATE(2, double)
SNUG_INSTANTIATE(2, faces::Differential<1>)
SNUG_INSTANTIATE(2, faces::Recorded)
SNUG_INSTANTIATE(3, double)
SNUG_INSTANTIATE(3, faces::Differential<1>)
SNUG_INSTANTIATE(3, faces::Recorded)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
