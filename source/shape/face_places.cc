#include <snug/faces/closest_point.h>
#include <snug/shape/face_places.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::shape {
template <int dim>
FacePlaces<dim>::FacePlaces(const ShapedFace<dim>     &face,
                            const std::vector<Vector> &values,
                            const Vector              &periods)
  : periods(periods), of_nodes(face.mesh().degree()), of_samples(mesh::surface_degree)
{
  for (const auto &one : face.surface().faces())
    {
      const bool has_samples = !one.samples.empty();
      Patch      patch{{has_samples ? &one.samples : &one.nodes,
                   has_samples ? of_samples.degree() : of_nodes.degree(),
                        {}},
                       {}};
      for (const unsigned int point : *patch.middle.points)
        {
          patch.values.push_back(values[point]);
          // A face of the mesh is whole, also where a coordinate begins again.
          for (unsigned int d = 0; d < dim; ++d)
            if (periods[d] > 0.)
              patch.values.back()[d] -=
                periods[d] *
                std::round((patch.values.back()[d] - patch.values.front()[d]) / periods[d]);
          patch.radius =
            std::max(patch.radius, (patch.values.back() - patch.values.front()).norm());
        }
      own_patches.push_back(patch);
    }
}

template <int dim>
std::optional<typename FacePlaces<dim>::Place> FacePlaces<dim>::closest(const Vector &target,
                                                                        const double  part) const
{
  double               nearest = std::numeric_limits<double>::max();
  std::optional<Place> result;
  for (const auto &patch : own_patches)
    {
      auto near = target;
      for (unsigned int d = 0; d < dim; ++d)
        if (periods[d] > 0.)
          near[d] -= periods[d] * std::round((near[d] - patch.values.front()[d]) / periods[d]);
      // Faces farther from the target than the nearest point so far are skipped. The factor 1.5
      // allows for edges that bulge between points.
      const double clear = (patch.values.front() - near).norm() - 1.5 * patch.radius;
      if (clear > std::min(std::sqrt(nearest), part * patch.radius))
        continue;
      const auto found =
        faces::closest_point(patch.middle.degree == mesh::surface_degree ? of_samples : of_nodes,
                             patch.values, near);
      if (found.squared_distance >= nearest ||
          std::sqrt(found.squared_distance) > part * patch.radius)
        continue;
      nearest    = found.squared_distance;
      result     = patch.middle;
      result->xi = found.xi;
    }
  return result;
}

template class FacePlaces<2>;
template class FacePlaces<3>;
} // namespace snug::shape
