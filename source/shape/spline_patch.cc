#include <snug/base/errors.h>
#include <snug/faces/closest_point.h>
#include <snug/shape/entries.h>
#include <snug/shape/make_modes.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::shape {
namespace {
/// Minimum cosine of the angle between a normal of the face and the mean normal. A face with a
/// smaller cosine has no useful projection onto a plane.
const double least_cosine = 0.1;

/// Return the mean of unit vectors over a face as a unit vector.
template <int dim>
dealii::Tensor<1, dim> mean_direction(const ShapedFace<dim>                 &face,
                                      const typename ShapedFace<dim>::Field &directions)
{
  dealii::Tensor<1, dim> mean;
  for (unsigned int node = 0; node < directions.size(); ++node)
    // The weights are areas, so that the mean does not depend on local refinement.
    mean += face.areas()[node] * directions[node];
  mean /= mean.norm();
  return mean;
}

/// Return the axes of s and t, which are all axes except the axis closest to the mean normal.
template <int dim>
std::vector<unsigned int> patch_axes(const ShapedFace<dim> &face, const ShapeParameters &parameters)
{
  const auto   mean_normal = mean_direction(face, face.normals());
  unsigned int across      = 0;
  // The axis closest to the mean normal is left out, so that the face is a graph over the other
  // axes.
  for (unsigned int d = 1; d < dim; ++d)
    // The last of equal components is taken, so that round-off does not decide.
    if (std::abs(mean_normal[d]) > std::abs(mean_normal[across]) - 1e-9)
      across = d;
  for (const auto &normal : face.normals())
    // Normals are replicated, so that all ranks throw or none. At the end of a quarter of a ring
    // the normal lies in the plane of s and t. A face that turns further is no graph over the
    // plane.
    if (!(normal * mean_normal > least_cosine && normal[across] * mean_normal[across] > -1e-9))
      throw bad_entry(parameters.path("Face"), parameters.face,
                      "must have normals that differ by at most 90 degrees for a patch; "
                      "use a box, node-wise or formula modes");
  std::vector<unsigned int> axes;
  for (unsigned int d = 0; d < dim; ++d)
    if (d != across)
      axes.push_back(d);
  return axes;
}

/// Return the point of the face that is nearest to @p place after projection along the axis other
/// than @p axes, and the unit direction at this point.
template <int dim>
std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>
point_above(const ShapedFace<dim>                 &face,
            const typename ShapedFace<dim>::Field &directions,
            const std::vector<unsigned int>       &axes,
            const dealii::Point<dim>              &place)
{
  const auto flattened = [&axes](const dealii::Tensor<1, dim> &x) {
    dealii::Tensor<1, dim> result;
    for (const unsigned int d : axes)
      result[d] = x[d];
    return result;
  };
  const faces::FaceShape<dim> of_nodes(face.mesh().degree()), of_samples(mesh::surface_degree);
  const auto                  target  = flattened(place);
  double                      nearest = std::numeric_limits<double>::max();
  dealii::Tensor<1, dim>      position, direction;
  for (const auto &cell : face.surface().faces())
    {
      const auto                         &points = cell.samples.empty() ? cell.nodes : cell.samples;
      const auto                         &shape  = cell.samples.empty() ? of_nodes : of_samples;
      std::vector<dealii::Tensor<1, dim>> flat;
      double                              radius = 0.;
      for (const unsigned int point : points)
        {
          flat.push_back(flattened(face.positions()[point]));
          radius = std::max(radius, (flat.back() - flat.front()).norm());
        }
      // Faces farther from the target than the nearest point so far are skipped. The factor 1.5
      // allows for edges that bulge between points.
      if ((flat.front() - target).norm() - 1.5 * radius > std::sqrt(nearest))
        continue;
      const auto found = faces::closest_point(shape, flat, target);
      if (found.squared_distance >= nearest)
        continue;
      nearest           = found.squared_distance;
      position          = 0.;
      direction         = 0.;
      const auto values = shape.at(found.xi);
      for (unsigned int k = 0; k < points.size(); ++k)
        {
          position += values.value[k] * face.positions()[points[k]];
          direction += values.value[k] * directions[points[k]];
        }
    }
  return {dealii::Point<dim>(position), direction / direction.norm()};
}
} // namespace

template <int dim>
Modes<dim> spline_patch(const ShapedFace<dim> &face,
                        const ShapeParameters &parameters,
                        const unsigned int     degree)
{
  const SplineNet        net        = spline_net(parameters, dim - 1, degree);
  const auto             directions = face_directions(face, parameters);
  const auto             axes       = patch_axes(face, parameters);
  const auto            &positions  = face.positions();
  dealii::Tensor<1, dim> lower = positions[0], upper = positions[0], middle;
  const unsigned int     n_nodes = face.surface().n_nodes();
  for (unsigned int node = 0; node < n_nodes; ++node)
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], positions[node][d]);
        upper[d] = std::max(upper[d], positions[node][d]);
        middle[d] += positions[node][d] / n_nodes;
      }
  Modes<dim> modes;
  modes.n_variables = net.n_points();
  modes.n_nodes     = positions.size();
  modes.row         = [=, &positions](unsigned int node) {
    std::vector<double> place; // coordinates s, t
    for (const unsigned int d : axes)
      // Samples of a face with curved edges may lie outside of the rectangle of the nodes.
      place.push_back(std::clamp((positions[node][d] - lower[d]) / (upper[d] - lower[d]), 0., 1.));
    typename Modes<dim>::Row row;
    for (const auto &value : net.values(place))
      row.emplace_back(value.first, value.second * directions[node]);
    return row;
  };
  // Symmetry compares control points, which are no nodes. All control points have the same height
  // and the mean direction, so that images are found on any mesh.
  const auto                          mean = mean_direction(face, directions);
  std::vector<dealii::Tensor<1, dim>> shown_directions;
  for (unsigned int i = 0; i < net.n_points(); ++i)
    {
      // The height of the control point is the mean height of the nodes. Moves are relative to the
      // face itself.
      dealii::Point<dim> position(middle);
      const auto         fractions = net.greville(i);
      for (unsigned int t = 0; t < axes.size(); ++t)
        position[axes[t]] = lower[axes[t]] + fractions[t] * (upper[axes[t]] - lower[axes[t]]);
      modes.controls.push_back({i, position, mean, net.on_border(i), false,
                                point_above(face, directions, axes, position)});
      shown_directions.push_back(modes.controls.back().shown->second);
    }
  modes.row_at_point = [=](unsigned int i) {
    typename Modes<dim>::Row row;
    for (const auto &value : net.values(net.greville(i)))
      row.emplace_back(value.first, value.second * shown_directions[i]);
    return row;
  };
  return modes;
}

template Modes<2> spline_patch(const ShapedFace<2> &, const ShapeParameters &, unsigned int);
template Modes<3> spline_patch(const ShapedFace<3> &, const ShapeParameters &, unsigned int);
} // namespace snug::shape
