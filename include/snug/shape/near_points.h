#ifndef snug_shape_near_points_h
#define snug_shape_near_points_h

#include <deal.II/base/tensor.h>

#include <functional>
#include <vector>

namespace snug::shape {
/**
 * This class finds points by distance. The points are sorted along the axis in which their extent
 * is maximum, so that a query of radius r visits only the points in an interval of length 2r.
 */
template <int dim>
class NearPoints
{
public:
  using Point = dealii::Tensor<1, dim>;

  explicit NearPoints(const std::vector<Point> &points);

  /// Call @p visit with index and distance of every point at most
  /// @p radius from @p centre, in an order that does not depend on ranks.
  void for_each(const Point                                     &centre,
                double                                           radius,
                const std::function<void(unsigned int, double)> &visit) const;

  /// Return the distance of @p centre from the nearest point, or @p radius if no point is
  /// closer.
  double distance(const Point &centre, double radius) const;

private:
  unsigned int              axis = 0;
  std::vector<Point>        points;
  std::vector<unsigned int> order; ///< ascending along axis
};
} // namespace snug::shape

#endif
