#include <snug/contact/nearest_face.h>

#include <algorithm>

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
  // Candidates are ordered by index, and the first of the equally close ones is taken. On matching
  // meshes the closest point is often a corner of four faces, and round-off must not choose between
  // these faces.
  const auto  candidates = tree.nearest(p);
  const auto &best =
    *std::min_element(candidates.begin(), candidates.end(), [](const auto &a, const auto &b) {
      return a.second.squared_distance < b.second.squared_distance;
    });
  const auto &[face, point] =
    *std::find_if(candidates.begin(), candidates.end(), [&](const auto &candidate) {
      return ties<dim>(candidate.second, best.second, tree.extent(best.first));
    });
  return {faces[face], point};
}

template class NearestFace<2>;
template class NearestFace<3>;
} // namespace snug::contact
