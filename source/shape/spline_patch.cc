#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/make_modes.h>

#include <algorithm>
#include <cmath>

namespace snug::shape {
namespace {
/// A face whose normals turn further from their mean than this cosine
/// has no sensible shadow on a plane.
const double least_cosine = 0.1;

/// The mean of unit vectors over a face, a unit vector.
template <int dim>
dealii::Tensor<1, dim> mean_direction(const ShapedFace<dim>                 &face,
                                      const typename ShapedFace<dim>::Field &directions)
{
  dealii::Tensor<1, dim> mean;
  for (unsigned int node = 0; node < directions.size(); ++node)
    // By area, so that it does not depend on where the mesh is fine.
    mean += face.areas()[node] * directions[node];
  mean /= mean.norm();
  return mean;
}

/// The axes of s and t: those that the mean normal of the face leaves.
template <int dim>
std::vector<unsigned int> patch_axes(const ShapedFace<dim> &face, const ShapeParameters &parameters)
{
  const auto mean_normal = mean_direction(face, face.normals());
  for (const auto &normal : face.normals())
    // Replicated: all ranks throw, or none.
    if (!(normal * mean_normal > least_cosine))
      throw bad_entry(parameters.path("Face"), parameters.face,
                      "must not turn by more than a quarter for a patch; "
                      "use a box, node-wise or formula modes");
  unsigned int across = 0;
  // The axis next to the mean normal is left out: the face is a graph over the other two.
  for (unsigned int d = 1; d < dim; ++d)
    // of equal ones the last, whatever round-off says
    if (std::abs(mean_normal[d]) > std::abs(mean_normal[across]) - 1e-9)
      across = d;
  std::vector<unsigned int> axes;
  for (unsigned int d = 0; d < dim; ++d)
    if (d != across)
      axes.push_back(d);
  return axes;
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
    std::vector<double> place; // s, t
    for (const unsigned int d : axes)
      // Samples of a face with curved edges may lie outside of the nodes' rectangle.
      place.push_back(std::clamp((positions[node][d] - lower[d]) / (upper[d] - lower[d]), 0., 1.));
    typename Modes<dim>::Row row;
    for (const auto &value : net.values(place))
      row.emplace_back(value.first, value.second * directions[node]);
    return row;
  };
  // Nodes move along their own normals; a control point, which is none of them, along their mean.
  const auto mean = mean_direction(face, directions);
  for (unsigned int i = 0; i < net.n_points(); ++i)
    {
      // Across the face at the mean of the nodes; moves are relative to the face itself.
      dealii::Point<dim> position(middle);
      const auto         fractions = net.greville(i);
      for (unsigned int t = 0; t < axes.size(); ++t)
        position[axes[t]] = lower[axes[t]] + fractions[t] * (upper[axes[t]] - lower[axes[t]]);
      modes.controls.push_back({i, position, mean, net.on_border(i), false});
    }
  return modes;
}

template Modes<2> spline_patch(const ShapedFace<2> &, const ShapeParameters &, unsigned int);
template Modes<3> spline_patch(const ShapedFace<3> &, const ShapeParameters &, unsigned int);
} // namespace snug::shape
