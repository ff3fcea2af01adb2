#include <snug/deck/face_gaps.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <limits>

namespace snug::deck {
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

/// Return the vector from the nearest point of a face to @p x, and the inward normal of the face.
std::pair<Vector, Vector>
offset(const DeckBodies &bodies, const DeckBodies::Corners &face, const Point &x)
{
  const auto at = [&](const std::size_t i) -> const Point & { return bodies.point(face[i]); };
  if (face.size() == 2)
    return {x - nearest_on(x, at(0), at(1)),
            dealii::cross_product_3d(Vector({0., 0., 1.}), at(1) - at(0))};
  std::pair<Vector, Vector> best;
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
    {
      const auto from = x - nearest_on(x, at(0), at(i), at(i + 1));
      if (i == 1 || from.norm() < best.first.norm())
        best = {from, dealii::cross_product_3d(at(i) - at(0), at(i + 1) - at(0))};
    }
  return best;
}
} // namespace

FaceGaps
face_gaps(const DeckBodies &bodies, const BodyFaces &of, const BodyFaces &from, const double reach)
{
  const auto                               &others = bodies.all()[from.body].outer;
  std::vector<std::pair<Box, unsigned int>> boxes;
  for (const unsigned int face : from.faces)
    {
      std::vector<Point> points;
      for (const unsigned int corner : others[face])
        points.push_back(bodies.point(corner));
      boxes.emplace_back(Box(points), face);
    }
  const auto                     tree = dealii::pack_rtree(boxes);
  std::map<unsigned int, double> distances; // infinite beyond the reach
  FaceGaps                       result{{}, std::numeric_limits<double>::max(), -reach};
  const double                   infinite = std::numeric_limits<double>::infinity();
  for (const unsigned int face : of.faces)
    for (const unsigned int node : bodies.all()[of.body].outer[face])
      {
        auto [distance, is_new] = distances.emplace(node, infinite);
        if (is_new)
          {
            const auto &x = bodies.point(node);
            Box         near(std::make_pair(x, x));
            near.extend(reach);
            for (auto box = tree.qbegin(boost::geometry::index::intersects(near));
                 box != tree.qend(); ++box)
              {
                const auto [vector, inward] = offset(bodies, others[box->second], x);
                if (vector.norm() <= std::min(reach, std::abs(distance->second)))
                  distance->second = (vector * inward > 0. ? -1. : 1.) * vector.norm();
              }
          }
        if (distance->second == infinite)
          result.is_whole = false;
        else
          {
            result.faces.insert(face);
            result.n_nodes += is_new;
            result.least   = std::min(result.least, distance->second);
            result.largest = std::max(result.largest, distance->second);
          }
      }
  return result;
}

double mean_size(const DeckBodies &bodies, const BodyFaces &of)
{
  double       sum = 0.;
  unsigned int n   = 0;
  for (const unsigned int face : of.faces)
    {
      const auto &corners = bodies.all()[of.body].outer[face];
      for (std::size_t i = 0; i < corners.size(); ++i, ++n)
        sum += bodies.point(corners[i]).distance(bodies.point(corners[(i + 1) % corners.size()]));
    }
  return n > 0 ? sum / n : 0.;
}
} // namespace snug::deck
