#include <snug/contact/nearest_face.h>

namespace snug::contact {
namespace {
/// Return whether @p a and @p best are equally close. They are if they are the same point, which
/// faces share, or distant points at the same distance up to round-off. Of points in between, the
/// closer point is right. @p extent is the size of a face, with which round-off of positions is
/// compared.
template <int dim>
bool ties(const faces::ClosestPoint<dim> &a,
          const faces::ClosestPoint<dim> &best,
          const double                    extent)
{
  const double apart = (a.position - best.position).norm();
  return apart <= 1e-11 * extent ||
         (apart > 1e-3 * extent && a.squared_distance <= best.squared_distance * (1. + 1e-12));
}
} // namespace

template <int dim>
typename NearestFace<dim>::Found NearestFace<dim>::closest(const dealii::Tensor<1, dim> &p) const
{
  // Extend the box a little beyond the bound, so that equally close faces are candidates, too, and
  // also where the distance is zero.
  dealii::BoundingBox<dim> cube({dealii::Point<dim>(p), dealii::Point<dim>(p)});
  cube.extend(tree.bound(p) * (1. + 1e-6) + 1e-6 * tree.extent(tree.nearest_box(p)));
  // Candidates are ordered by index, and the first of the equally close ones is taken. On matching
  // meshes the closest point is often a corner of four faces, and round-off must not choose between
  // these faces.
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
  // The loop ends at `best` at the latest, because `best` ties with itself.
  while (!ties<dim>(points[first], points[best], tree.extent(candidates[best])))
    ++first;
  return {faces[candidates[first]], points[first]};
}

template class NearestFace<2>;
template class NearestFace<3>;
} // namespace snug::contact
