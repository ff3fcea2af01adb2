#include <snug/contact/face_tree.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::contact {
namespace {
/**
 * Return the Bézier control points of the face with Lagrange @p nodes. The convex hull of the
 * control points contains the face, also a quadratic face that bulges beyond its nodes.
 */
template <int dim>
std::vector<dealii::Point<dim>> hull_points(const faces::FaceShape<dim>        &shape,
                                            std::vector<dealii::Tensor<1, dim>> nodes)
{
  // middle control point of a parabola: 2 x_1 - (x_0 + x_2)/2
  const unsigned int n_lines = nodes.size() / 3;
  for (int direction = 0; direction < dim - 1 && shape.degree() == 2; ++direction)
    for (unsigned int line = 0; line < n_lines; ++line)
      {
        const unsigned int stride = direction == 0 ? 1 : 3;
        const unsigned int first  = direction == 0 ? 3 * line : line;
        auto              &middle = nodes[first + stride];
        middle                    = 2. * middle - 0.5 * (nodes[first] + nodes[first + 2 * stride]);
      }
  return {nodes.begin(), nodes.end()};
}

template <int dim>
std::vector<std::vector<dealii::Tensor<1, dim>>>
nodes_of(const mesh::Surface<dim>                 &surface,
         const std::vector<unsigned int>          &faces,
         const typename mesh::Surface<dim>::Field &positions)
{
  std::vector<std::vector<dealii::Tensor<1, dim>>> result;
  for (const unsigned int face : faces)
    result.push_back(face_nodes(surface, face, positions));
  return result;
}

template <int dim>
std::vector<dealii::BoundingBox<dim>>
boxes_of(const faces::FaceShape<dim>                            &shape,
         const std::vector<std::vector<dealii::Tensor<1, dim>>> &faces)
{
  std::vector<dealii::BoundingBox<dim>> result;
  for (const auto &nodes : faces)
    result.emplace_back(hull_points<dim>(shape, nodes));
  return result;
}

/// Return the distance between @p x and a box; 0 inside.
template <int dim>
double distance(const dealii::BoundingBox<dim> &box, const dealii::Tensor<1, dim> &x)
{
  const auto &[lower, upper] = box.get_boundary_points();
  double square              = 0.;
  for (int d = 0; d < dim; ++d)
    square += dealii::Utilities::fixed_power<2>(std::max({0., lower[d] - x[d], x[d] - upper[d]}));
  return std::sqrt(square);
}
} // namespace

template <int dim>
std::vector<dealii::Tensor<1, dim>> face_nodes(const mesh::Surface<dim>                 &surface,
                                               unsigned int                              face,
                                               const typename mesh::Surface<dim>::Field &positions)
{
  std::vector<dealii::Tensor<1, dim>> result;
  for (const unsigned int node : surface.faces()[face].nodes)
    result.push_back(positions[node]);
  return result;
}

template <int dim>
FaceTree<dim>::FaceTree(const mesh::Surface<dim>                 &surface,
                        const std::vector<unsigned int>          &faces,
                        const faces::FaceShape<dim>              &shape,
                        const typename mesh::Surface<dim>::Field &positions)
  : shape(shape)
  , face_points(nodes_of(surface, faces, positions))
  , boxes(boxes_of(shape, face_points))
  , tree(dealii::pack_rtree_of_indices(boxes))
{}

template <int dim>
double FaceTree<dim>::extent(const std::size_t i) const
{
  return diameter(boxes[i]);
}

template <int dim>
double FaceTree<dim>::bound(const dealii::Tensor<1, dim> &x) const
{
  namespace bgi = boost::geometry::index;
  double square = std::numeric_limits<double>::infinity();
  // Check the faces of four boxes, because the face of the nearest box need not be the nearest
  // face. Any number of boxes gives an upper bound.
  for (const auto i : tree | bgi::adaptors::queried(bgi::nearest(dealii::Point<dim>(x), 4)))
    square = std::min(square, faces::closest_point(shape, face_points[i], x).squared_distance);
  return std::sqrt(square);
}

/// Take the face of the nearest box first, so that few other faces are projected on.
template <int dim>
std::vector<typename FaceTree<dim>::Nearby>
FaceTree<dim>::nearest(const dealii::Tensor<1, dim> &x) const
{
  namespace bgi = boost::geometry::index;
  const dealii::Point<dim> p(x);
  std::vector<Nearby>      result;
  double                   reach = std::numeric_limits<double>::infinity();
  const auto               add   = [&](const std::size_t i) {
    result.emplace_back(i, faces::closest_point(shape, face_points[i], x));
    reach = std::min(reach, std::sqrt(result.back().second.squared_distance) * (1. + 1e-6) +
                                              1e-6 * extent(i));
  };
  for (const auto i : tree | bgi::adaptors::queried(bgi::nearest(p, 1)))
    add(i);
  Box cube({p, p});
  cube.extend(reach);
  for (const auto i : tree | bgi::adaptors::queried(bgi::intersects(cube)))
    if (i != result.front().first && distance(boxes[i], x) <= reach)
      add(i);
  std::sort(result.begin(), result.end(),
            [](const Nearby &a, const Nearby &b) { return a.first < b.first; });
  return result;
}

template <int dim>
std::vector<std::size_t> FaceTree<dim>::meeting(const Box &box) const
{
  namespace bgi = boost::geometry::index;
  std::vector<std::size_t> result;
  for (const auto i : tree | bgi::adaptors::queried(bgi::intersects(box)))
    result.push_back(i);
  // Sort the faces, because rows must not depend on the order in which the tree returns them.
  std::sort(result.begin(), result.end());
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                         \
  template class FaceTree<dim>;                                                       \
  template std::vector<dealii::Tensor<1, dim>> face_nodes(const mesh::Surface<dim> &, \
                                                          unsigned int,               \
                                                          const mesh::Surface<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
