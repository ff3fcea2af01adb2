#include <snug/mesh_file/face_gaps.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <limits>

namespace snug::mesh_file {
namespace {
using Point  = dealii::Point<3>;
using Vector = dealii::Tensor<1, 3>;
using Box    = dealii::BoundingBox<3>;

/// Return the point of the segment from @p a to @p b that is nearest to @p x.
Point nearest_on(const Point &x, const Point &a, const Point &b)
{
  const auto   along  = b - a;
  const double length = along.norm_square();
  return length == 0. ? a : a + std::clamp((x - a) * along / length, 0., 1.) * along;
}

/// Return the point of a triangle that is nearest to @p x: the foot of the perpendicular if it is
/// inside, otherwise a point of an edge.
Point nearest_on(const Point &x, const Point &a, const Point &b, const Point &c)
{
  const auto   normal = dealii::cross_product_3d(b - a, c - a);
  const double area   = normal.norm_square();
  if (area > 0.)
    {
      const Point foot = x - ((x - a) * normal / area) * normal;
      const auto  side = [&](const Point &p, const Point &q) {
        return dealii::cross_product_3d(q - p, foot - p) * normal >= 0.;
      };
      if (side(a, b) && side(b, c) && side(c, a))
        return foot;
    }
  Point best = nearest_on(x, a, b);
  for (const auto &other : {nearest_on(x, b, c), nearest_on(x, c, a)})
    if (x.distance_square(other) < x.distance_square(best))
      best = other;
  return best;
}

/// A triangle of a face, or an edge as a triangle with two equal corners, and its inward normal.
struct Triangle
{
  Point  a, b, c;
  Vector normal;
};

std::vector<Triangle> triangles(const std::vector<Point>        &points,
                                const std::vector<unsigned int> &face)
{
  const auto at   = [&](const std::size_t i) { return points[face[i]]; };
  const auto unit = [](const Vector &v) { return v.norm() > 0. ? v / v.norm() : v; };
  if (face.size() == 2)
    return {
      {at(0), at(1), at(1), unit(dealii::cross_product_3d(Vector({0., 0., 1.}), at(1) - at(0)))}};
  std::vector<Triangle> result;
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
    result.push_back(
      {at(0), at(i), at(i + 1), unit(dealii::cross_product_3d(at(i) - at(0), at(i + 1) - at(0)))});
  return result;
}

/// Return the distance of @p x from a triangle, negative inside of its body, or infinity if it is
/// out of reach.
double distance_within(const Point &x, const Triangle &triangle, const double reach)
{
  const double least_cosine = std::sqrt(.5);
  const auto   from         = x - nearest_on(x, triangle.a, triangle.b, triangle.c);
  const double length = from.norm(), along = from * triangle.normal;
  if (length > reach || std::abs(along) < least_cosine * length)
    return std::numeric_limits<double>::infinity();
  return along > 0. ? -length : length;
}
} // namespace

FaceGaps
face_gaps(const std::vector<Point> &points, const Faces &of, const Faces &from, const double reach)
{
  std::vector<std::pair<Box, unsigned int>> boxes;
  std::vector<Triangle>                     all;
  for (const auto &face : from)
    for (const auto &triangle : triangles(points, face))
      {
        boxes.emplace_back(Box(std::vector<Point>{triangle.a, triangle.b, triangle.c}), all.size());
        all.push_back(triangle);
      }
  const auto   tree            = dealii::pack_rtree(boxes);
  const double greatest_cosine = -.5;
  FaceGaps     result{{}, std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
  for (unsigned int face = 0; face < of.size(); ++face)
    {
      const auto normal = triangles(points, of[face])[0].normal;
      for (const unsigned int corner : of[face])
        {
          const auto &x = points[corner];
          Box         near(std::make_pair(x, x));
          near.extend(reach);
          double best = std::numeric_limits<double>::infinity();
          for (auto box = tree.qbegin(boost::geometry::index::intersects(near)); box != tree.qend();
               ++box)
            if (const auto &triangle = all[box->second]; triangle.normal * normal < greatest_cosine)
              if (const double distance = distance_within(x, triangle, reach);
                  std::abs(distance) < std::abs(best))
                best = distance;
          if (best == std::numeric_limits<double>::infinity())
            {
              result.is_whole = false;
              continue;
            }
          result.faces.insert(face);
          result.least   = std::min(result.least, best);
          result.largest = std::max(result.largest, best);
        }
    }
  return result;
}

double mean_size(const std::vector<Point> &points, const Faces &faces)
{
  double       sum = 0.;
  unsigned int n   = 0;
  for (const auto &face : faces)
    for (std::size_t i = 0; i < face.size(); ++i, ++n)
      sum += points[face[i]].distance(points[face[(i + 1) % face.size()]]);
  return n > 0 ? sum / n : 0.;
}
} // namespace snug::mesh_file
