#include <snug/contact/projection.h>
#include <snug/faces/closest_point.h>
#include <snug/faces/outer_edges.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace snug::contact {
namespace {
/// Weights below this are round-off of nodes that do not take part.
const double least_weight = 1e-12;

/**
 * Bézier control points of the face with Lagrange @p nodes: their hull
 * contains the face, also a quadratic one that bulges beyond its nodes.
 */
template <int dim>
std::vector<dealii::Tensor<1, dim>> hull_points(const faces::FaceShape<dim>        &shape,
                                                std::vector<dealii::Tensor<1, dim>> nodes)
{
  if (shape.degree() == 1)
    return nodes;
  // middle control point of a parabola: 2 x_1 - (x_0 + x_2)/2
  const unsigned int n_lines = nodes.size() / 3;
  for (int direction = 0; direction < dim - 1; ++direction)
    for (unsigned int line = 0; line < n_lines; ++line)
      {
        const unsigned int stride = direction == 0 ? 1 : 3;
        const unsigned int first  = direction == 0 ? 3 * line : line;
        auto              &middle = nodes[first + stride];
        middle                    = 2. * middle - 0.5 * (nodes[first] + nodes[first + 2 * stride]);
      }
  return nodes;
}

/// The master side of a pair, searched by a tree of face boxes.
template <int dim>
class MasterSide
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  struct Found
  {
    unsigned int             face; ///< surface index
    faces::ClosestPoint<dim> point;
  };

  MasterSide(const mesh::Surface<dim>        &surface,
             const std::vector<unsigned int> &faces,
             const faces::FaceShape<dim>     &shape,
             const Field                     &positions)
    : shape(shape)
    , faces(faces)
    , nodes(node_positions(surface, faces, positions))
    , boxes(face_boxes(shape, nodes))
    , tree(dealii::pack_rtree_of_indices(boxes))
  {}

  Found closest(const dealii::Tensor<1, dim> &p) const
  {
    namespace bgi = boost::geometry::index;
    const dealii::Point<dim> centre(p);
    // An upper bound of the distance from the faces of the nearest boxes,
    // then all faces whose boxes meet the cube of that size around p.
    double bound = std::numeric_limits<double>::infinity();
    // Four, as the face of the nearest box need not be the nearest face; any number gives a bound.
    for (const auto i : tree | bgi::adaptors::queried(bgi::nearest(centre, 4)))
      bound = std::min(bound, faces::closest_point(shape, nodes[i], p).squared_distance);
    double reach = 0.;
    for (const auto i : tree | bgi::adaptors::queried(bgi::nearest(centre, 1)))
      reach = extent(i);
    // A little more than the bound, so that faces which are equally close are candidates, too, and
    // also where the distance is zero.
    reach                    = std::sqrt(bound) * (1. + 1e-6) + 1e-6 * reach;
    dealii::Point<dim> lower = centre, upper = centre;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] -= reach;
        upper[d] += reach;
      }
    const dealii::BoundingBox<dim> cube({lower, upper});

    std::vector<std::size_t> candidates;
    for (const auto i : tree | bgi::adaptors::queried(bgi::intersects(cube)))
      candidates.push_back(i);
    // By index, as the first of those that tie is taken: on matching meshes the closest point is
    // often a corner of four faces, and rounding must not choose between them.
    std::sort(candidates.begin(), candidates.end());
    std::vector<faces::ClosestPoint<dim>> points;
    std::size_t                           best = 0;
    for (const std::size_t i : candidates)
      {
        points.push_back(faces::closest_point(shape, nodes[i], p));
        if (points.back().squared_distance < points[best].squared_distance)
          best = points.size() - 1;
      }
    std::size_t first = 0;
    // Ends at `best` at the latest, which ties with itself.
    while (!ties(points[first], points[best], extent(candidates[best])))
      ++first;
    return {faces[candidates[first]], points[first]};
  }

private:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;
  using Boxes = std::vector<dealii::BoundingBox<dim>>;

  const faces::FaceShape<dim>                                                 &shape;
  const std::vector<unsigned int>                                             &faces;
  const std::vector<Nodes>                                                     nodes;
  const Boxes                                                                  boxes;
  const decltype(dealii::pack_rtree_of_indices(std::declval<const Boxes &>())) tree;

  std::vector<Nodes> node_positions(const mesh::Surface<dim>        &surface,
                                    const std::vector<unsigned int> &faces,
                                    const Field                     &positions)
  {
    std::vector<Nodes> result(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (const unsigned int node : surface.faces()[faces[i]].nodes)
        result[i].push_back(positions[node]);
    return result;
  }

  Boxes face_boxes(const faces::FaceShape<dim> &shape, const std::vector<Nodes> &nodes)
  {
    Boxes result;
    for (const Nodes &face : nodes)
      {
        std::vector<dealii::Point<dim>> points;
        for (const auto &point : hull_points<dim>(shape, face))
          points.emplace_back(point);
        result.emplace_back(points);
      }
    return result;
  }

  /// The diagonal of the box: the length that rounding of positions is compared with.
  double extent(std::size_t i) const
  {
    const auto &corners = boxes[i].get_boundary_points();
    return corners.first.distance(corners.second);
  }

  /// Equally close: the same point, which faces share, or another one at
  /// the same distance but for round-off. Points in between are different
  /// answers, of which the closer is right.
  bool
  ties(const faces::ClosestPoint<dim> &a, const faces::ClosestPoint<dim> &best, double extent) const
  {
    const double apart = (a.position - best.position).norm();
    return apart <= 1e-11 * extent ||
           (apart > 1e-3 * extent && a.squared_distance <= best.squared_distance * (1. + 1e-12));
  }
};

template <int dim>
std::vector<std::pair<unsigned int, double>> weights(const faces::FaceShape<dim>     &shape,
                                                     const dealii::Point<dim - 1>    &xi,
                                                     const std::vector<unsigned int> &nodes)
{
  const auto                                   values = shape.at(xi);
  std::vector<std::pair<unsigned int, double>> result;
  double                                       sum = 0.;
  for (unsigned int k = 0; k < nodes.size(); ++k)
    // On an edge the nodes of the other edges have weights that are rounding: they would couple the
    // row to nodes that it has nothing to do with.
    if (std::abs(values.value[k]) >= least_weight)
      {
        result.emplace_back(nodes[k], values.value[k]);
        sum += values.value[k];
      }
  for (auto &weight : result)
    // What was left out is made up for: rigid translations must not open or close the gap.
    weight.second /= sum;
  std::sort(result.begin(), result.end());
  return result;
}
} // namespace

template <int dim>
std::vector<Projection> project(const mesh::Surface<dim>                 &surface,
                                const PairFaces                          &sides,
                                const faces::FaceShape<dim>              &shape,
                                const typename mesh::Surface<dim>::Field &positions)
{
  std::vector<Projection> result;
  if (sides.master.empty())
    return result;
  const MasterSide<dim>        master(surface, sides.master, shape, positions);
  const faces::OuterEdges<dim> edges(surface, sides.master, shape);
  std::vector<bool>            visited(surface.n_nodes(), false);
  for (const unsigned int slave_face : sides.slave)
    for (const unsigned int slave : surface.faces()[slave_face].nodes)
      {
        // Faces share nodes, of which each is projected once; hanging ones never.
        if (visited[slave] || !surface.masters(slave).empty())
          continue;
        visited[slave]   = true;
        const auto found = master.closest(positions[slave]);
        // Beyond the end of the master side the closest point stays on its edge, and the row would
        // hold back a node that passes by the master side.
        if (edges.excess(found.face, found.point.xi, positions[slave] - found.point.position,
                         positions) > edge_tolerance)
          continue;
        result.push_back(
          {slave, weights(shape, found.point.xi, surface.faces()[found.face].nodes)});
      }
  return result;
}

template std::vector<Projection> project(const mesh::Surface<2> &,
                                         const PairFaces &,
                                         const faces::FaceShape<2> &,
                                         const mesh::Surface<2>::Field &);
template std::vector<Projection> project(const mesh::Surface<3> &,
                                         const PairFaces &,
                                         const faces::FaceShape<3> &,
                                         const mesh::Surface<3>::Field &);
} // namespace snug::contact
