#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/spline_patch.h>

#include <algorithm>
#include <cmath>

namespace snug::shape {
namespace {
/// A face whose normals turn further from their mean than this cosine
/// has no sensible shadow on a plane.
const double least_cosine = 0.1;
} // namespace

/// Of unit length: variables are heights.
template <int dim>
typename ShapedFace<dim>::Field face_directions(const ShapedFace<dim> &face,
                                                const ShapeParameters &parameters)
{
  if (parameters.direction.empty())
    return face.normals();
  return typename ShapedFace<dim>::Field(face.surface().n_nodes(), unit_direction<dim>(parameters));
}

template <int dim>
SplinePatch<dim>::SplinePatch(const ShapedFace<dim> &face,
                              const ShapeParameters &parameters,
                              const unsigned int     degree)
  : face(face)
  , net(spline_net(parameters, dim - 1, degree))
  , directions(face_directions(face, parameters))
  , lower(face.positions()[0])
  , upper(face.positions()[0])
{
  find_axes(parameters);
  const unsigned int n = face.surface().n_nodes();
  for (const auto &position : face.positions())
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], position[d]);
        upper[d] = std::max(upper[d], position[d]);
        middle[d] += position[d] / n;
      }
  for (const auto &position : face.positions())
    {
      places.emplace_back();
      for (const unsigned int d : axes)
        places.back().push_back((position[d] - lower[d]) / (upper[d] - lower[d]));
    }
}

template <int dim>
void SplinePatch<dim>::find_axes(const ShapeParameters &parameters)
{
  for (unsigned int node = 0; node < face.normals().size(); ++node)
    // By area, so that it does not depend on where the mesh is fine.
    mean_normal += face.areas()[node] * face.normals()[node];
  mean_normal /= mean_normal.norm();
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
  for (unsigned int d = 0; d < dim; ++d)
    if (d != across)
      axes.push_back(d);
}

template <int dim>
unsigned int SplinePatch<dim>::n_variables() const
{
  return net.n_points();
}

template <int dim>
typename SplinePatch<dim>::FaceField SplinePatch<dim>::apply(const std::vector<double> &alpha) const
{
  AssertDimension(alpha.size(), n_variables());
  FaceField moves(places.size());
  for (unsigned int node = 0; node < places.size(); ++node)
    {
      // u(x) = (sum_i B_i(s, t) alpha_i) d(x)
      double height = 0.;
      for (const auto &value : net.values(places[node]))
        height += value.second * alpha[value.first];
      moves[node] = height * directions[node];
    }
  return moves;
}

template <int dim>
std::vector<double> SplinePatch<dim>::transpose(const FaceField &gradient) const
{
  AssertDimension(gradient.size(), places.size());
  std::vector<double> result(n_variables(), 0.);
  for (unsigned int node = 0; node < places.size(); ++node)
    {
      // The part of the gradient in which the node can move.
      const double along = gradient[node] * directions[node];
      for (const auto &value : net.values(places[node]))
        result[value.first] += value.second * along;
    }
  return result;
}

template <int dim>
std::vector<Control<dim>> SplinePatch<dim>::controls() const
{
  // Nodes move along their own normals; a control point, which is none of them, along their mean.
  dealii::Tensor<1, dim> mean;
  for (unsigned int node = 0; node < directions.size(); ++node)
    mean += face.areas()[node] * directions[node];
  mean /= mean.norm();
  std::vector<Control<dim>> result;
  for (unsigned int i = 0; i < net.n_points(); ++i)
    {
      // Across the face at the mean of the nodes; moves are relative to the face itself.
      dealii::Point<dim> position(middle);
      const auto         fractions = net.greville(i);
      for (unsigned int t = 0; t < axes.size(); ++t)
        {
          const unsigned int d = axes[t];
          position[d]          = lower[d] + fractions[t] * (upper[d] - lower[d]);
        }
      result.push_back({i, position, mean, net.on_border(i), false});
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                       \
  template class SplinePatch<dim>;                                                  \
  template typename ShapedFace<dim>::Field face_directions(const ShapedFace<dim> &, \
                                                           const ShapeParameters &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::shape
