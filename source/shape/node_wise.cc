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
  if (!(radius > 0.) || !std::isfinite(radius))
    throw bad_entry(parameters.path("Filter radius"), std::to_string(radius),
                    "must be positive for a node-wise shape");
  for (unsigned int node = 0; node < face.surface().n_nodes(); ++node)
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
        const double weight = face.areas()[nodes[j]] * (1. - r / radius);
        rows[i].emplace_back(j, weight);
        sum += weight;
      });
      for (auto &weight : rows[i])
        weight.second /= sum;
    }
}

template <int dim>
void NodeWise<dim>::lead_to_fixed(const ShapeParameters &parameters)
{
  const auto fixed = fixed_points(controls(), parameters);
  FaceField  places;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (fixed[i])
      places.push_back(face.positions()[nodes[i]]);
  const NearPoints<dim> near(places);
  const double          radius = parameters.filter_radius;
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
