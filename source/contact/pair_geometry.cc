#include <snug/contact/pair_geometry.h>
#include <snug/faces/nodal_normals.h>
#include <snug/faces/quadratic_triangle.h>
#include <snug/geometry/formula.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace snug::contact {
namespace {
/// Nodes exactly at the search distance or the largest angle are inside the limits, because the set
/// of rows must not depend on round-off.
const double round_off = 1e-9;

/// Return the diagonal over sqrt(dim-1), which is the edge length of a square. The first and the
/// last node in tensor order are opposite corners.
template <int dim>
double face_size(const std::vector<unsigned int>          &nodes,
                 const typename mesh::Surface<dim>::Field &positions)
{
  return (positions[nodes.back()] - positions[nodes.front()]).norm() / std::sqrt(dim - 1.);
}

/// Return the mean edge of a triangle, which counts as one face: it has as many rows per area as a
/// square with this edge.
template <typename Field>
double mean_edge(const faces::QuadraticTriangle &triangle, const Field &positions)
{
  double sum = 0.;
  for (unsigned int k = 0; k < 3; ++k)
    sum += (positions[triangle.corners[k]] - positions[triangle.corners[(k + 1) % 3]]).norm();
  return sum / 3.;
}

/// An obstacle that a rigid motion has moved, x = Q X + t.
template <int dim>
class MovedObstacle : public Obstacle<dim>
{
public:
  MovedObstacle(std::unique_ptr<Obstacle<dim>> obstacle, const geometry::RigidMotion<dim> &motion)
    : obstacle(std::move(obstacle)), motion(motion)
  {}

  std::optional<ObstacleDistance<dim>> distance(const dealii::Point<dim> &x) const override
  {
    auto d = obstacle->distance(dealii::Point<dim>(motion.point_back(x)));
    if (d)
      *d = {d->value, motion.vector(d->gradient), motion.Q * d->hessian * transpose(motion.Q)};
    return d;
  }

private:
  const std::unique_ptr<Obstacle<dim>> obstacle;
  const geometry::RigidMotion<dim>     motion;
};
} // namespace

template <int dim>
std::unique_ptr<Obstacle<dim>> PairGeometry<dim>::obstacle() const
{
  auto unmoved =
    choose(obstacle_table<dim>(), pair.obstacle->shape).make(*pair.obstacle, slave_size());
  if (obstacle_motion.is_identity())
    return unmoved;
  return std::make_unique<MovedObstacle<dim>>(std::move(unmoved), obstacle_motion);
}

template <int dim>
dealii::Tensor<1, dim> PairGeometry<dim>::obstacle_displacement() const
{
  return obstacle_motion.vector(to_point<dim>(pair.obstacle->displacement));
}

template <int dim>
std::vector<unsigned int> faces_of(const mesh::Surface<dim> &surface, const Side &side)
{
  std::vector<unsigned int> faces;
  for (unsigned int f = 0; f < surface.faces().size(); ++f)
    if (is_on(surface.faces()[f], side))
      faces.push_back(f);
  return faces;
}

template <int dim>
double mean_face_size(const mesh::Surface<dim>                 &surface,
                      const std::vector<unsigned int>          &faces,
                      const typename mesh::Surface<dim>::Field &positions)
{
  double sum = 0.;
  for (const unsigned int f : faces)
    sum += face_size<dim>(surface.faces()[f].nodes, positions);
  return sum / faces.size();
}

template <int dim>
double
face_height(const mesh::Surface<dim> &surface, const faces::FaceShape<dim> &shape, const Side &side)
{
  const auto &X       = surface.reference_positions();
  double      largest = 0.;
  for (const auto &face : surface.faces())
    if (is_on(face, side))
      for (unsigned int k = 0; k < face.samples.size(); ++k)
        {
          auto offset = X[face.samples[k]];
          for (unsigned int a = 0; a < face.nodes.size(); ++a)
            offset -= shape.at_sample(k).value[a] * X[face.nodes[a]];
          // Measure along the normal alone, because samples of graded cells lie beside the points
          // of the face with the same coordinates, also where the face is plane.
          const auto n =
            faces::area_vector(faces::tangents<dim>(shape.at_sample(k), face.nodes, X));
          const double height = std::abs(offset * n) / n.norm();
          if (height > round_off * face_size<dim>(face.nodes, X))
            largest = std::max(largest, height);
        }
  return largest;
}

template <int dim>
std::vector<double> node_face_sizes(const mesh::Surface<dim>                 &surface,
                                    const typename mesh::Surface<dim>::Field &positions)
{
  std::vector<double> sizes(surface.n_nodes(), 0.);
  for (unsigned int f = 0; f < surface.faces().size(); ++f)
    {
      const auto  &nodes    = surface.faces()[f].nodes;
      const auto   triangle = faces::quadratic_triangle(surface, f);
      const double size =
        triangle ? mean_edge(*triangle, positions) : face_size<dim>(nodes, positions);
      for (const unsigned int node : nodes)
        // Take the largest face, because tangential slips and pairing drifts are compared with what
        // the mesh resolves at the node.
        sizes[node] = std::max(sizes[node], size);
    }
  return sizes;
}

template <int dim>
std::function<double(const dealii::Point<dim> &)> resistance(const Pair &pair)
{
  const auto formula =
    std::make_shared<const geometry::Formula<dim>>(pair.name(), pair.parameters.resistance());
  return [formula](const dealii::Point<dim> &x) { return formula->value(x); };
}

template <int dim>
std::vector<DependentMultiplier>
dependent_without_area(const mesh::Surface<dim>        &surface,
                       const std::vector<unsigned int> &faces,
                       const std::vector<unsigned int> &slaves,
                       const std::vector<unsigned int> &zero_area_nodes)
{
  std::map<unsigned int, unsigned int> rows_of;
  for (unsigned int i = 0; i < slaves.size(); ++i)
    rows_of[slaves[i]] = i;
  std::vector<DependentMultiplier>               result;
  std::map<unsigned int, std::set<unsigned int>> middles; // rows, by corner
  const std::set<unsigned int> without_area(zero_area_nodes.begin(), zero_area_nodes.end());
  for (const unsigned int f : faces)
    {
      auto nodes = surface.faces()[f].nodes;
      if (without_area.count(nodes.back()) > 0)
        std::reverse(nodes.begin(), nodes.end());
      if (dim == 2 && without_area.count(nodes.front()) > 0 && nodes.size() == 3 &&
          rows_of.count(nodes[1]) > 0 && rows_of.count(nodes[2]) > 0)
        result.push_back(
          {nodes.front(), {{rows_of[nodes[1]], 4. / 3.}, {rows_of[nodes[2]], -1. / 3.}}});
      if (dim == 3)
        for (const unsigned int corner : nodes)
          if (without_area.count(corner) > 0)
            for (const unsigned int node : nodes)
              if (const auto row = rows_of.find(node); row != rows_of.end())
                middles[corner].insert(row->second);
    }
  for (const auto &[corner, rows] : middles)
    {
      result.push_back({corner, {}});
      for (const unsigned int row : rows)
        result.back().rows.emplace_back(row, 1. / double(rows.size()));
    }
  return result;
}

template <int dim>
SearchCriteria<dim>::SearchCriteria(const PairGeometry<dim> &pair)
  : normals(faces::NodalNormals<dim>(pair.surface, pair.sides.slave, pair.shape, pair.positions)
              .normals())
{
  const PairParameters &parameters = pair.pair.parameters;
  // The value 0 means no limit.
  largest_distance = parameters.search_distance == 0.
                       ? std::numeric_limits<double>::infinity()
                       : parameters.search_distance * (1. + round_off);
  least_cosine     = std::cos(parameters.largest_angle / 180. * dealii::numbers::PI) - round_off;
}

#define SNUG_INSTANTIATE(dim)                                                                   \
  template std::vector<unsigned int> faces_of(const mesh::Surface<dim> &, const Side &);        \
  template double mean_face_size(const mesh::Surface<dim> &, const std::vector<unsigned int> &, \
                                 const mesh::Surface<dim>::Field &);                            \
  template double face_height(const mesh::Surface<dim> &, const faces::FaceShape<dim> &,        \
                              const Side &);                                                    \
  template std::vector<double> node_face_sizes(const mesh::Surface<dim> &,                      \
                                               const mesh::Surface<dim>::Field &);              \
  template std::function<double(const dealii::Point<dim> &)> resistance(const Pair &);          \
  template std::vector<DependentMultiplier>                  dependent_without_area(            \
                     const mesh::Surface<dim> &, const std::vector<unsigned int> &,             \
                     const std::vector<unsigned int> &, const std::vector<unsigned int> &);     \
  template struct PairGeometry<dim>;                                                            \
  template class SearchCriteria<dim>;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
