#include <snug/base/shared_work.h>
#include <snug/contact/projection.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace snug::contact {
namespace {
/// Weights below this value are round-off of nodes that do not take part.
const double least_weight = 1e-12;

Weights nonzero(const std::vector<double> &values, const std::vector<unsigned int> &points)
{
  Weights result;
  double  sum = 0.;
  for (unsigned int k = 0; k < points.size(); ++k)
    // On an edge, the weights of the nodes of the other edges are round-off. These weights would
    // couple the row to unrelated nodes.
    if (std::abs(values[k]) >= least_weight)
      {
        result.emplace_back(points[k], values[k]);
        sum += values[k];
      }
  for (auto &weight : result)
    // Divide by the sum of the weights, because rigid translations must not open or close the gap.
    weight.second /= sum;
  std::sort(result.begin(), result.end());
  return result;
}

/// Return @p xi without round-off beyond the edges, if the face contains it.
template <int dim>
std::optional<dealii::Point<dim>> inside(dealii::Point<dim> xi)
{
  const double round_off = 1e-10;
  for (int a = 0; a < dim; ++a)
    {
      if (xi[a] < -round_off || xi[a] > 1. + round_off)
        return {};
      xi[a] = std::clamp(xi[a], 0., 1.);
    }
  return xi;
}

/// Return a projection as numbers for shared_work(); see projection_of().
template <int dim>
std::vector<double> numbers_of(const PointProjection<dim> &of)
{
  std::vector<double> numbers{double(of.face), double(of.is_normal), of.softening,
                              double(of.masters.size())};
  for (int a = 0; a < dim - 1; ++a)
    numbers.push_back(of.xi[a]);
  for (const Weights *weights : {&of.masters, &of.surface})
    for (const auto &[point, weight] : *weights)
      numbers.insert(numbers.end(), {double(point), weight});
  return numbers;
}

template <int dim>
PointProjection<dim> projection_of(const std::vector<double> &numbers)
{
  PointProjection<dim> result;
  auto                 next = numbers.begin();
  result.face               = static_cast<unsigned int>(*next++);
  result.is_normal          = *next++ != 0.;
  result.softening          = *next++;
  const double n_masters    = *next++;
  for (int a = 0; a < dim - 1; ++a)
    result.xi[a] = *next++;
  while (next != numbers.end())
    {
      Weights &weights =
        double(result.masters.size()) < n_masters ? result.masters : result.surface;
      const auto point = static_cast<unsigned int>(*next++);
      weights.emplace_back(point, *next++);
    }
  return result;
}
} // namespace

template <int dim>
Projector<dim>::Projector(const mesh::Surface<dim>        &surface,
                          const std::vector<unsigned int> &master,
                          const faces::FaceShape<dim>     &shape,
                          const Field                     &positions,
                          const Field                     &normals)
  : surface(surface)
  , shape(shape)
  , positions(positions)
  , normals(normals)
  , side(surface, master, shape, positions)
  , edges(surface, master, shape)
  , faces_at(surface.n_nodes())
{
  for (const unsigned int face : master)
    for (const unsigned int node : surface.faces()[face].nodes)
      faces_at[node].push_back(face);
}

template <int dim>
dealii::Tensor<1, dim> Projector<dim>::at_height(const dealii::Tensor<1, dim> &p,
                                                 const dealii::Tensor<1, dim> &of_slave) const
{
  if (of_slave.norm_square() == 0.)
    return p;
  const auto closest = side.closest(p);
  const auto v       = equations(closest.face, of_slave).at(closest.point.xi, p).v;
  // Where the normals are nearly parallel instead of opposite, no point is paired.
  if (v.norm_square() < 1.)
    return p;
  return p + (closest.point.position - p) * v / v.norm_square() * v;
}

template <int dim>
std::optional<std::pair<unsigned int, dealii::Point<dim - 1>>>
Projector<dim>::find_normal(const dealii::Tensor<1, dim>           &p,
                            const dealii::Tensor<1, dim>           &of_slave,
                            const typename NearestFace<dim>::Found &start) const
{
  std::vector<unsigned int> candidates = {start.face};
  for (const unsigned int node : surface.faces()[start.face].nodes)
    candidates.insert(candidates.end(), faces_at[node].begin(), faces_at[node].end());
  // The face of the closest point comes first, then its neighbours by number.
  std::sort(candidates.begin() + 1, candidates.end());
  dealii::Point<dim - 1> middle;
  for (int a = 0; a < dim - 1; ++a)
    middle[a] = 0.5;
  for (const unsigned int candidate : candidates)
    if (const auto found = equations(candidate, of_slave)
                             .solve(p, candidate == start.face ? start.point.xi : middle))
      if (const auto xi = inside(found->values.point))
        return std::make_pair(candidate, *xi);
  return {};
}

template <int dim>
std::optional<PointProjection<dim>>
Projector<dim>::onto(const dealii::Tensor<1, dim> &p, const dealii::Tensor<1, dim> &of_slave) const
{
  const auto q       = at_height(p, of_slave);
  const auto closest = side.closest(q);
  // Beyond the end of the master side the closest point stays on its edge, and the row would hold
  // back a node that passes by the master side.
  const double excess =
    edges.excess(closest.face, closest.point.xi, q - closest.point.position, positions);
  if (excess >= edge_tolerance)
    return {};
  return projection(p, of_slave, closest, excess);
}

template <int dim>
PointProjection<dim> Projector<dim>::projection(const dealii::Tensor<1, dim>           &p,
                                                const dealii::Tensor<1, dim>           &of_slave,
                                                const typename NearestFace<dim>::Found &start,
                                                const double excess) const
{
  const auto normal     = find_normal(p, of_slave, start);
  const auto [face, xi] = normal.value_or(std::make_pair(start.face, start.point.xi));
  const auto &of        = surface.faces()[face];
  const auto  masters   = nonzero(shape.at(xi).value, of.nodes);
  // Where the normal begins on the side, as in a symmetry plane, the side does not end, so the
  // softening is 0.
  const double beyond = normal ? 0. : std::max(0., excess);
  const auto   meets =
    of.samples.empty()
        ? masters
        : nonzero(equations(face, of_slave).intersection(xi).values.value, of.samples);
  const double softening = edge_softening(beyond, mean_face_size(surface, {face}, positions));
  return PointProjection<dim>{face, xi, bool(normal), masters, meets, softening};
}

template <int dim>
std::vector<Projection<dim>> project(const mesh::Surface<dim>                 &surface,
                                     const PairFaces                          &sides,
                                     const faces::FaceShape<dim>              &shape,
                                     const typename mesh::Surface<dim>::Field &positions,
                                     const typename PairNormals<dim>::Fields  &normals)
{
  std::vector<Projection<dim>> result;
  if (sides.master.empty())
    return result;
  const Projector<dim>      projector(surface, sides.master, shape, positions, normals.master);
  std::vector<bool>         visited(surface.n_nodes(), false);
  std::vector<unsigned int> slaves;
  for (const unsigned int slave_face : sides.slave)
    for (const unsigned int slave : surface.faces()[slave_face].nodes)
      // Faces share nodes, so each node is projected once. Hanging nodes are not projected.
      if (!visited[slave] && surface.masters(slave).empty())
        {
          visited[slave] = true;
          slaves.push_back(slave);
        }
  const auto numbers =
    shared_work(surface.communicator(), std::vector<double>(slaves.size(), 1.),
                [&](const unsigned int i) {
                  const auto found = projector.onto(positions[slaves[i]], normals.slave[slaves[i]]);
                  return found ? numbers_of(*found) : std::vector<double>();
                });
  for (unsigned int i = 0; i < slaves.size(); ++i)
    if (!numbers[i].empty())
      result.push_back({projection_of<dim>(numbers[i]), slaves[i]});
  return result;
}

template class Projector<2>;
template class Projector<3>;
template std::vector<Projection<2>> project(const mesh::Surface<2> &,
                                            const PairFaces &,
                                            const faces::FaceShape<2> &,
                                            const mesh::Surface<2>::Field &,
                                            const PairNormals<2>::Fields &);
template std::vector<Projection<3>> project(const mesh::Surface<3> &,
                                            const PairFaces &,
                                            const faces::FaceShape<3> &,
                                            const mesh::Surface<3>::Field &,
                                            const PairNormals<3>::Fields &);
} // namespace snug::contact
