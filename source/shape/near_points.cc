#include <snug/shape/near_points.h>

#include <algorithm>
#include <numeric>

namespace snug::shape {
template <int dim>
NearPoints<dim>::NearPoints(const std::vector<Point> &points) : points(points), order(points.size())
{
  // The initial value is below zero, so that an axis is chosen even if all points coincide.
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
  // The stable sort keeps the given order of points with the same coordinate, so that sums over
  // points are reproducible.
  std::stable_sort(order.begin(), order.end(), [this](unsigned int a, unsigned int b) {
    return this->points[a][axis] < this->points[b][axis];
  });
}

template <int dim>
void NearPoints<dim>::for_each(const Point                                     &centre,
                               const double                                     radius,
                               const std::function<void(unsigned int, double)> &visit) const
{
  // The loop visits the points within the radius along the axis. The distance then selects the
  // points within the sphere.
  auto next = std::lower_bound(order.begin(), order.end(), centre[axis] - radius,
                               [this](unsigned int i, double x) { return points[i][axis] < x; });
  for (; next != order.end() && points[*next][axis] <= centre[axis] + radius; ++next)
    {
      const double distance = (points[*next] - centre).norm();
      if (distance <= radius)
        visit(*next, distance);
    }
}

/// The distance is bounded by the radius, because callers need only distances below the radius.
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
