#include <snug/base/errors.h>
#include <snug/shape/links.h>
#include <snug/shape/near_points.h>
#include <snug/shape/node_wise.h>
#include <snug/shape/spline_patch.h>

#include <cmath>

namespace snug::shape {
template <int dim>
NodeWise<dim>::NodeWise(const ShapedFace<dim> &face, const ShapeParameters &parameters)
  : face(face), directions(face_directions(face, parameters))
{
  const double radius = parameters.filter_radius;
  // A radius below the distance of the nodes leaves each node its own weight: no filter.
  if (!(radius > 0.) || !std::isfinite(radius))
    throw bad_entry(parameters.path("Filter radius"), std::to_string(radius),
                    "must be positive for a node-wise shape");
  for (unsigned int node = 0; node < face.surface().n_nodes(); ++node)
    // Hanging nodes follow their masters and have no variable.
    if (!face.is_hanging(node))
      nodes.push_back(node);
  set_weights(radius);
  lead_to_fixed(parameters);
}

template <int dim>
void NodeWise<dim>::set_weights(const double radius)
{
  FaceField places;
  for (const unsigned int node : nodes)
    places.push_back(face.positions()[node]);
  const NearPoints<dim> near(places);
  rows.resize(nodes.size());
  for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      double sum = 0.;
      near.for_each(places[i], radius, [&](unsigned int j, double r) {
        // By area: a finer mesh has more nodes in the radius, not a stronger pull.
        const double weight = face.areas()[nodes[j]] * (1. - r / radius);
        rows[i].emplace_back(j, weight);
        sum += weight;
      });
      for (auto &weight : rows[i])
        // Equal alpha give equal heights: the filter keeps constants.
        weight.second /= sum;
    }
}

/// Without c_i the filter would move a fixed node by its neighbours, or, if only its own row was
/// zero, leave a step of one cell beside it.
template <int dim>
void NodeWise<dim>::lead_to_fixed(const ShapeParameters &parameters)
{
  const auto fixed = fixed_points(controls(), parameters);
  FaceField  places;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (fixed[i])
      places.push_back(face.positions()[nodes[i]]);
  const NearPoints<dim> near(places);
  // Without fixed nodes near.distance() gives the radius, and the factor is 1.
  const double radius = parameters.filter_radius;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      const double factor = near.distance(face.positions()[nodes[i]], radius) / radius;
      for (auto &weight : rows[i])
        weight.second *= factor;
    }
}

template <int dim>
unsigned int NodeWise<dim>::n_variables() const
{
  return nodes.size();
}

template <int dim>
typename NodeWise<dim>::FaceField NodeWise<dim>::apply(const std::vector<double> &alpha) const
{
  AssertDimension(alpha.size(), n_variables());
  FaceField moves(face.surface().n_nodes());
  for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      double height = 0.;
      for (const auto &weight : rows[i])
        height += weight.second * alpha[weight.first];
      moves[nodes[i]] = height * directions[nodes[i]];
    }
  return moves;
}

/// The weights are not symmetric, w_ij / sum_j w_ij: the transpose is no filter of the gradient.
template <int dim>
std::vector<double> NodeWise<dim>::transpose(const FaceField &gradient) const
{
  std::vector<double> result(n_variables(), 0.);
  for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      const double along = gradient[nodes[i]] * directions[nodes[i]];
      for (const auto &weight : rows[i])
        result[weight.first] += weight.second * along;
    }
  return result;
}

/// A control point is a node; its variable moves the neighbours as well.
template <int dim>
std::vector<Control<dim>> NodeWise<dim>::controls() const
{
  std::vector<Control<dim>> result;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    result.push_back({i, dealii::Point<dim>(face.positions()[nodes[i]]), directions[nodes[i]],
                      face.border()[nodes[i]], false});
  return result;
}

template class NodeWise<2>;
template class NodeWise<3>;
} // namespace snug::shape
