#include <snug/faces/closest_point.h>
#include <snug/shape/face_places.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::shape {
namespace {
/// Distances below this part of a face are zero.
const double round_off = 1e-10;
} // namespace

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
          patch.values.back() = near(values[point], patch);
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
  std::vector<std::pair<double, unsigned int>> order; // distance from the middle, patch
  for (unsigned int p = 0; p < own_patches.size(); ++p)
    {
      const auto  &patch = own_patches[p];
      const double clear = (patch.values.front() - near(target, patch)).norm();
      // The factor 1.5 allows for edges that bulge between points.
      if (clear <= (1.5 + part) * patch.radius)
        order.emplace_back((patch.values[patch.values.size() / 2] - near(target, patch)).norm() -
                             patch.radius,
                           p);
    }
  std::sort(order.begin(), order.end());
  double               nearest = std::numeric_limits<double>::max();
  std::optional<Place> result;
  for (const auto &[clear, p] : order)
    {
      const auto &patch = own_patches[p];
      if (nearest < round_off * round_off * patch.radius * patch.radius)
        break;
      if (clear > patch.radius + std::sqrt(nearest))
        continue;
      const auto found =
        faces::closest_point(patch.middle.degree == mesh::surface_degree ? of_samples : of_nodes,
                             patch.values, near(target, patch));
      if (found.squared_distance >= nearest ||
          std::sqrt(found.squared_distance) > part * patch.radius)
        continue;
      nearest    = found.squared_distance;
      result     = patch.middle;
      result->xi = found.xi;
    }
  return result;
}

/// Return a vector moved by periods to the values of a face of the mesh.
template <int dim>
dealii::Tensor<1, dim> FacePlaces<dim>::near(Vector target, const Patch &patch) const
{
  for (unsigned int d = 0; d < dim; ++d)
    if (periods[d] > 0.)
      target[d] -= periods[d] * std::round((target[d] - patch.values.front()[d]) / periods[d]);
  return target;
}

template class FacePlaces<2>;
template class FacePlaces<3>;
} // namespace snug::shape
