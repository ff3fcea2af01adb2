#include <snug/contact/face_tree.h>
#include <snug/contact/projection.h>
#include <snug/faces/closest_point.h>
#include <snug/faces/outer_edges.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace snug::contact {
namespace {
/// Weights below this are round-off of nodes that do not take part.
const double least_weight = 1e-12;

/// The nearest face of a master side.
template <int dim>
class MasterSide
{
public:
  struct Found
  {
    unsigned int             face; ///< surface index
    faces::ClosestPoint<dim> point;
  };

  MasterSide(const mesh::Surface<dim>                 &surface,
             const std::vector<unsigned int>          &faces,
             const faces::FaceShape<dim>              &shape,
             const typename mesh::Surface<dim>::Field &positions)
    : shape(shape), faces(faces), tree(surface, faces, shape, positions)
  {}

  Found closest(const dealii::Tensor<1, dim> &p) const
  {
    // A little more than the bound, so that faces which are equally close are candidates, too, and
    // also where the distance is zero.
    dealii::BoundingBox<dim> cube({dealii::Point<dim>(p), dealii::Point<dim>(p)});
    cube.extend(tree.bound(p) * (1. + 1e-6) + 1e-6 * tree.extent(tree.nearest_box(p)));
    // By index, as the first of those that tie is taken: on matching meshes the closest point is
    // often a corner of four faces, and rounding must not choose between them.
    const auto                            candidates = tree.meeting(cube);
    std::vector<faces::ClosestPoint<dim>> points;
    std::size_t                           best = 0;
    for (const std::size_t i : candidates)
      {
        points.push_back(faces::closest_point(shape, tree.nodes(i), p));
        if (points.back().squared_distance < points[best].squared_distance)
          best = points.size() - 1;
      }
    std::size_t first = 0;
    // Ends at `best` at the latest, which ties with itself.
    while (!ties(points[first], points[best], tree.extent(candidates[best])))
      ++first;
    return {faces[candidates[first]], points[first]};
  }

private:
  const faces::FaceShape<dim>     &shape;
  const std::vector<unsigned int> &faces;
  const FaceTree<dim>              tree;

  /// Equally close: the same point, which faces share, or another one at
  /// the same distance but for round-off. Points in between are different
  /// answers, of which the closer is right. @p extent: of a face, with which
  /// rounding of positions is compared.
  bool
  ties(const faces::ClosestPoint<dim> &a, const faces::ClosestPoint<dim> &best, double extent) const
  {
    const double apart = (a.position - best.position).norm();
    return apart <= 1e-11 * extent ||
           (apart > 1e-3 * extent && a.squared_distance <= best.squared_distance * (1. + 1e-12));
  }
};

Projection::Weights nonzero(const std::vector<double>       &values,
                            const std::vector<unsigned int> &points)
{
  Projection::Weights result;
  double              sum = 0.;
  for (unsigned int k = 0; k < points.size(); ++k)
    // On an edge the nodes of the other edges have weights that are rounding: they would couple the
    // row to nodes that it has nothing to do with.
    if (std::abs(values[k]) >= least_weight)
      {
        result.emplace_back(points[k], values[k]);
        sum += values[k];
      }
  for (auto &weight : result)
    // What was left out is made up for: rigid translations must not open or close the gap.
    weight.second /= sum;
  std::sort(result.begin(), result.end());
  return result;
}

/// The rays of a master side along its normals.
template <int dim>
class NormalRays
{
public:
  using Field = typename mesh::Surface<dim>::Field;
  using Xi    = dealii::Point<dim - 1>;

  NormalRays(const mesh::Surface<dim>        &surface,
             const std::vector<unsigned int> &faces,
             const faces::FaceShape<dim>     &shape,
             const Field                     &positions,
             const Field                     &normals)
    : surface(surface)
    , shape(shape)
    , positions(positions)
    , normals(normals)
    , at_node(surface.n_nodes())
  {
    for (const unsigned int face : faces)
      for (const unsigned int node : surface.faces()[face].nodes)
        at_node[node].push_back(face);
  }

  /// Face and coordinates where the ray to @p p begins, near those of the closest point; none
  /// where the side ends.
  std::optional<std::pair<unsigned int, Xi>>
  find(const dealii::Tensor<1, dim> &p, const unsigned int face, const Xi &closest) const
  {
    std::vector<unsigned int> candidates = {face};
    for (const unsigned int node : surface.faces()[face].nodes)
      candidates.insert(candidates.end(), at_node[node].begin(), at_node[node].end());
    // The face of the closest point first, then its neighbours by number.
    std::sort(candidates.begin() + 1, candidates.end());
    for (const unsigned int candidate : candidates)
      {
        Xi xi = candidate == face ? closest : Xi();
        if (candidate != face)
          for (int a = 0; a < dim - 1; ++a)
            xi[a] = 0.5;
        if (solve(p, surface.faces()[candidate].nodes, xi))
          return std::make_pair(candidate, xi);
      }
    return {};
  }

  /// Where the ray from @p xi of @p face meets the true surface: coordinates of its samples.
  Xi on_surface(const unsigned int face, const Xi &xi) const
  {
    const auto            &of     = surface.faces()[face];
    const auto             values = shape.at(xi);
    const auto             t      = faces::tangents<dim>(values, of.nodes, positions);
    dealii::Tensor<1, dim> x, v;
    for (unsigned int k = 0; k < of.nodes.size(); ++k)
      {
        x += values.value[k] * positions[of.nodes[k]];
        v += values.value[k] * normals[of.nodes[k]];
      }
    dealii::Tensor<2, dim> frame;
    for (int d = 0; d < dim; ++d)
      {
        for (int a = 0; a < dim - 1; ++a)
          frame[d][a] = t[a][d];
        frame[d][dim - 1] = v[d];
      }
    const auto to_frame = dealii::invert(frame);
    Xi         result   = xi;
    // The surface is nearly parallel to the face: its height comes in as a small factor each time.
    for (unsigned int iteration = 0; iteration < 10; ++iteration)
      {
        const auto             at = shape.samples_at(result);
        dealii::Tensor<1, dim> y  = -x;
        for (unsigned int k = 0; k < of.samples.size(); ++k)
          y += at.value[k] * positions[of.samples[k]];
        const auto off = to_frame * y;
        for (int a = 0; a < dim - 1; ++a)
          result[a] -= off[a];
      }
    return result;
  }

private:
  const mesh::Surface<dim>              &surface;
  const faces::FaceShape<dim>           &shape;
  const Field                           &positions, &normals;
  std::vector<std::vector<unsigned int>> at_node; ///< faces

  /// Newton's method for xi and the length t of the ray.
  bool solve(const dealii::Tensor<1, dim> &p, const std::vector<unsigned int> &nodes, Xi &xi) const
  {
    const double       converged = 1e-15, inside = 1e-10;
    const unsigned int max_iterations = 30;
    double             t              = 0.;
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        const auto             values = shape.at(xi);
        dealii::Tensor<1, dim> x, v;
        for (unsigned int k = 0; k < nodes.size(); ++k)
          {
            x += values.value[k] * (positions[nodes[k]] - p);
            v += values.value[k] * normals[nodes[k]];
          }
        if (iteration == 0)
          t = -(x * v) / v.norm_square();
        const auto             tx = faces::tangents<dim>(values, nodes, positions);
        const auto             tv = faces::tangents<dim>(values, nodes, normals);
        dealii::Tensor<2, dim> jacobian;
        for (int d = 0; d < dim; ++d)
          {
            for (int a = 0; a < dim - 1; ++a)
              jacobian[d][a] = tx[a][d] + t * tv[a][d];
            jacobian[d][dim - 1] = v[d];
          }
        if (!(std::abs(dealii::determinant(jacobian)) > 0.))
          return false;
        const auto step = -(dealii::invert(jacobian) * (x + t * v));
        double     move = 0.;
        for (int a = 0; a < dim - 1; ++a)
          {
            xi[a] += step[a];
            move += std::abs(step[a]);
          }
        t += step[dim - 1];
        if (!(move < 10.))
          return false;
        if (move <= converged || (iteration + 1 == max_iterations && move < 1e-12))
          {
            for (int a = 0; a < dim - 1; ++a)
              {
                if (xi[a] < -inside || xi[a] > 1. + inside)
                  return false;
                xi[a] = std::clamp(xi[a], 0., 1.);
              }
            return true;
          }
      }
    return false;
  }
};
} // namespace

template <int dim>
std::vector<Projection> project(const mesh::Surface<dim>                 &surface,
                                const PairFaces                          &sides,
                                const faces::FaceShape<dim>              &shape,
                                const typename mesh::Surface<dim>::Field &positions,
                                const typename mesh::Surface<dim>::Field &normals)
{
  std::vector<Projection> result;
  if (sides.master.empty())
    return result;
  const MasterSide<dim>        master(surface, sides.master, shape, positions);
  const NormalRays<dim>        rays(surface, sides.master, shape, positions, normals);
  const faces::OuterEdges<dim> edges(surface, sides.master, shape);
  std::vector<bool>            visited(surface.n_nodes(), false);
  for (const unsigned int slave_face : sides.slave)
    for (const unsigned int slave : surface.faces()[slave_face].nodes)
      {
        // Faces share nodes, of which each is projected once; hanging ones never.
        if (visited[slave] || !surface.masters(slave).empty())
          continue;
        visited[slave]     = true;
        const auto closest = master.closest(positions[slave]);
        // Beyond the end of the master side the closest point stays on its edge, and the row would
        // hold back a node that passes by the master side.
        const double excess = edges.excess(closest.face, closest.point.xi,
                                           positions[slave] - closest.point.position, positions);
        if (excess >= edge_tolerance)
          continue;
        const auto ray        = rays.find(positions[slave], closest.face, closest.point.xi);
        const auto [face, xi] = ray.value_or(std::make_pair(closest.face, closest.point.xi));
        const auto &of        = surface.faces()[face];
        const auto  masters   = nonzero(shape.at(xi).value, of.nodes);
        // Where the ray begins on the side, as in a symmetry plane, nothing ends.
        const double beyond = ray ? 0. : std::max(0., excess);
        result.push_back(
          {slave, face, masters,
           of.samples.empty()
             ? masters
             : nonzero(shape.samples_at(rays.on_surface(face, xi)).value, of.samples),
           edge_relief(beyond, mean_face_size(surface, {face}, positions))});
      }
  return result;
}

template std::vector<Projection> project(const mesh::Surface<2> &,
                                         const PairFaces &,
                                         const faces::FaceShape<2> &,
                                         const mesh::Surface<2>::Field &,
                                         const mesh::Surface<2>::Field &);
template std::vector<Projection> project(const mesh::Surface<3> &,
                                         const PairFaces &,
                                         const faces::FaceShape<3> &,
                                         const mesh::Surface<3>::Field &,
                                         const mesh::Surface<3>::Field &);
} // namespace snug::contact
