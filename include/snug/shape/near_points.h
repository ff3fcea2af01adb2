#ifndef snug_shape_near_points_h
#define snug_shape_near_points_h

#include <deal.II/base/tensor.h>

#include <functional>
#include <vector>

namespace snug::shape {
/**
 * Points found by distance: sorted along the axis in which they spread
 * most, so that a query of radius r looks at the part 2r of that length.
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

  /// Distance of @p centre from the nearest point, or @p radius if there
  /// is none closer.
  double distance(const Point &centre, double radius) const;

private:
  unsigned int              axis = 0;
  std::vector<Point>        points;
  std::vector<unsigned int> order; ///< ascending along axis
};
} // namespace snug::shape

#endif
