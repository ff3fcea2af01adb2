#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/links.h>
#include <snug/shape/make_modes.h>
#include <snug/shape/near_points.h>

#include <cmath>

namespace snug::shape {
namespace {
/// Variables of one node and their factors.
using Weights = std::vector<std::pair<unsigned int, double>>;

/// w_ij / sum_j w_ij
template <int dim>
std::vector<Weights> filter_weights(const std::vector<dealii::Tensor<1, dim>> &places,
                                    const std::vector<double>                 &areas,
                                    const double                               radius)
{
  const NearPoints<dim> near(places);
  std::vector<Weights>  rows(places.size());
  for (unsigned int i = 0; i < places.size(); ++i)
    {
      double sum = 0.;
      near.for_each(places[i], radius, [&](unsigned int j, double r) {
        // By area: a finer mesh has more nodes in the radius, not a stronger pull.
        const double weight = areas[j] * (1. - r / radius);
        rows[i].emplace_back(j, weight);
        sum += weight;
      });
      for (auto &weight : rows[i])
        // Equal alpha give equal heights: the filter keeps constants.
        weight.second /= sum;
    }
  return rows;
}

/// Rows times c_i. Without c_i the filter would move a fixed node by its neighbours, or, if only
/// its own row was zero, leave a step of one cell beside it.
template <int dim>
void lead_to_fixed(const std::vector<dealii::Tensor<1, dim>> &places,
                   const std::vector<bool>                   &fixed,
                   const double                               radius,
                   std::vector<Weights>                      &rows)
{
  std::vector<dealii::Tensor<1, dim>> fixed_places;
  for (unsigned int i = 0; i < places.size(); ++i)
    if (fixed[i])
      fixed_places.push_back(places[i]);
  const NearPoints<dim> near(fixed_places);
  for (unsigned int i = 0; i < places.size(); ++i)
    {
      // Without fixed nodes near.distance() gives the radius, and the factor is 1.
      const double factor = near.distance(places[i], radius) / radius;
      for (auto &weight : rows[i])
        weight.second *= factor;
    }
}
} // namespace

template <int dim>
Modes<dim> node_wise(const ShapedFace<dim> &face, const ShapeParameters &parameters)
{
  const double radius = parameters.filter_radius;
  const auto   d      = face_directions(face, parameters);
  // A radius below the distance of the nodes leaves each node its own weight: no filter.
  if (!(radius > 0.) || !std::isfinite(radius))
    throw bad_entry(parameters.path("Filter radius"), std::to_string(radius),
                    "must be positive for a node-wise shape");
  Modes<dim>                          modes;
  std::vector<unsigned int>           nodes; // of the variables
  std::vector<dealii::Tensor<1, dim>> places;
  std::vector<double>                 areas;
  for (unsigned int node = 0; node < face.surface().n_nodes(); ++node)
    // Hanging nodes follow their masters and have no variable.
    if (!face.is_hanging(node))
      {
        const auto &place = face.positions()[node];
        modes.controls.push_back(
          {modes.n_variables++, dealii::Point<dim>(place), d[node], face.border()[node], false});
        nodes.push_back(node);
        places.push_back(place);
        areas.push_back(face.areas()[node]);
      }
  auto weights = filter_weights(places, areas, radius);
  lead_to_fixed(places, fixed_points(modes.controls, parameters), radius, weights);
  modes.n_nodes   = face.surface().n_nodes();
  using Rows      = std::vector<typename Modes<dim>::Row>;
  const auto kept = std::make_shared<Rows>(modes.n_nodes);
  auto      &rows = *kept;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    for (const auto &weight : weights[i])
      rows[nodes[i]].emplace_back(weight.first, weight.second * d[nodes[i]]);
  modes.row          = [kept](unsigned int node) { return (*kept)[node]; };
  modes.row_at_point = [kept, nodes](unsigned int i) { return (*kept)[nodes[i]]; };
  return modes;
}

template Modes<2> node_wise(const ShapedFace<2> &, const ShapeParameters &);
template Modes<3> node_wise(const ShapedFace<3> &, const ShapeParameters &);
} // namespace snug::shape
