#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/limits.h>
#include <snug/shape/links.h>
#include <snug/shape/make_modes.h>
#include <snug/shape/near_points.h>

#include <cmath>

namespace snug::shape {
namespace {
/// Variables of one node and their factors.
using Weights = std::vector<std::pair<unsigned int, double>>;

/// Return the rows w_ij / sum_j w_ij.
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
        // The factor A_j keeps the weight of a part of the face independent of the element size: a
        // finer mesh has more nodes within the radius, each with a smaller area.
        const double weight = areas[j] * (1. - r / radius);
        rows[i].emplace_back(j, weight);
        sum += weight;
      });
      for (auto &weight : rows[i])
        // The normalization keeps constants, so that equal alpha give equal heights.
        weight.second /= sum;
    }
  return rows;
}

/// Multiply the rows by c_i. Without c_i the variables of neighbours would move a fixed node. If
/// only the row of the fixed node was zero, the moves would jump across one cell.
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
      // Without fixed nodes near.distance() returns the radius, and the factor is 1.
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
  auto         d      = face_directions(face, parameters);
  d.resize(face.surface().n_nodes());
  // A positive radius below the distance of the nodes is valid and means no filter: the row of
  // each node contains only the variable of the node.
  if (!(radius > 0.) || !std::isfinite(radius))
    throw bad_entry(parameters.path("Filter radius"), std::to_string(radius),
                    "must be positive for a node-wise shape");
  Modes<dim>                          modes;
  std::vector<unsigned int>           nodes; // surface node of each variable
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
  modes.n_nodes = face.surface().n_nodes();
  // Both functions share the weights, which take less memory than rows.
  const auto kept = std::make_shared<std::vector<Weights>>(modes.n_nodes);
  for (unsigned int i = 0; i < nodes.size(); ++i)
    (*kept)[nodes[i]] = weights[i];
  modes.row = [kept, d](unsigned int node) {
    typename Modes<dim>::Row row;
    row.reserve((*kept)[node].size());
    for (const auto &weight : (*kept)[node])
      row.emplace_back(weight.first, weight.second * d[node]);
    return row;
  };
  modes.limits       = removal_limits(face, modes.n_variables, d, parameters);
  modes.row_at_point = [row = modes.row, nodes](unsigned int i) { return row(nodes[i]); };
  return modes;
}

template Modes<2> node_wise(const ShapedFace<2> &, const ShapeParameters &);
template Modes<3> node_wise(const ShapedFace<3> &, const ShapeParameters &);
} // namespace snug::shape
