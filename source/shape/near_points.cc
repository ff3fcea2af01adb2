#include <snug/shape/near_points.h>

#include <algorithm>
#include <numeric>

namespace snug::shape {
template <int dim>
NearPoints<dim>::NearPoints(const std::vector<Point> &points) : points(points), order(points.size())
{
  // Below zero, so that an axis is chosen also where all points coincide.
  double widest = -1.;
  for (unsigned int d = 0; d < dim && !points.empty(); ++d)
    {
      const auto ends =
        std::minmax_element(points.begin(), points.end(),
                            [d](const Point &a, const Point &b) { return a[d] < b[d]; });
      const double width = (*ends.second)[d] - (*ends.first)[d];
      if (width > widest)
        {
          widest = width;
          axis   = d;
        }
    }
  std::iota(order.begin(), order.end(), 0u);
  // Stable: points at the same coordinate are visited in the order given, so that sums over them
  // are reproducible.
  std::stable_sort(order.begin(), order.end(), [this](unsigned int a, unsigned int b) {
    return this->points[a][axis] < this->points[b][axis];
  });
}

template <int dim>
void NearPoints<dim>::for_each(const Point                                     &centre,
                               const double                                     radius,
                               const std::function<void(unsigned int, double)> &visit) const
{
  // Points within the radius along the axis, of which the distance then decides.
  auto next = std::lower_bound(order.begin(), order.end(), centre[axis] - radius,
                               [this](unsigned int i, double x) { return points[i][axis] < x; });
  for (; next != order.end() && points[*next][axis] <= centre[axis] + radius; ++next)
    {
      const double distance = (points[*next] - centre).norm();
      if (distance <= radius)
        visit(*next, distance);
    }
}

/// Bounded by the radius: callers only ask how far a node is within it.
template <int dim>
double NearPoints<dim>::distance(const Point &centre, const double radius) const
{
  double least = radius;
  for_each(centre, radius,
           [&least](unsigned int, double distance) { least = std::min(least, distance); });
  return least;
}

template class NearPoints<2>;
template class NearPoints<3>;
} // namespace snug::shape
