#include <snug/accuracy/gap_residual.h>
#include <snug/accuracy/underresolved_contact.h>
#include <snug/contact/pair_geometry.h>
#include <snug/state/contact_patches.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace snug::accuracy {
namespace {
/// A gap without a force is closed if it is below this share of the face size.
const double closed_gap = 1e-9;

/// Return slave nodes of pairs without a force at which the pair is nearly closed: the nodal gap
/// is positive and small, or the true surfaces between nodes overlap or have a small gap, relative
/// to the face size.
template <int dim>
std::vector<unsigned int> nearly_closed(const state::StateSolver<dim>  &solver,
                                        const state::ContactState<dim> &state)
{
  const auto       &places = solver.contact(state.load_case).places();
  const auto        sizes  = contact::node_face_sizes(solver.surface(), state.surface_positions);
  std::vector<bool> has_force(solver.contact(state.load_case).pairs().size(), false);
  // For each pair, find the row with the minimum gap.
  std::vector<unsigned int> nearest(has_force.size(), places.size());
  for (unsigned int i = 0; i < places.size(); ++i)
    {
      const unsigned int pair = places[i].pair;
      has_force[pair]         = has_force[pair] || state.contact[i].strong;
      if (nearest[pair] == places.size() || state.contact[i].gap < state.contact[nearest[pair]].gap)
        nearest[pair] = i;
    }
  std::vector<unsigned int> nodes;
  if (std::find(has_force.begin(), has_force.end(), false) == has_force.end())
    return nodes;
  const GapResidual<dim> true_gaps(solver, state);
  for (unsigned int pair = 0; pair < nearest.size(); ++pair)
    if (!has_force[pair])
      {
        if (nearest[pair] < places.size())
          {
            const unsigned int node = places[nearest[pair]].slave;
            const double       gap  = state.contact[nearest[pair]].gap / sizes[node];
            if (gap > closed_gap && gap < small_gap)
              nodes.push_back(node);
          }
        const auto         least = true_gaps.least(pair);
        const unsigned int node  = std::min_element(least.begin(), least.end()) - least.begin();
        if (std::abs(least[node]) > closed_gap * sizes[node] &&
            least[node] < small_gap * sizes[node])
          nodes.push_back(node);
      }
  return nodes;
}

/// Return the faces of the slave side of @p pair that have one of @p nodes.
template <int dim>
std::vector<unsigned int> faces_at(const mesh::Surface<dim> &surface,
                                   const contact::Pair      &pair,
                                   const std::vector<bool>  &nodes)
{
  std::vector<unsigned int> result;
  for (const unsigned int face : contact::faces_of(surface, pair.slave))
    {
      const auto &of = surface.faces()[face].nodes;
      if (std::any_of(of.begin(), of.end(), [&](const unsigned int node) { return nodes[node]; }))
        result.push_back(face);
    }
  return result;
}
} // namespace

template <int dim>
std::vector<unsigned int> underresolved_contact(const state::StateSolver<dim>  &solver,
                                                const state::ContactState<dim> &state,
                                                const double                    across)
{
  const auto       &surface = solver.surface();
  std::vector<bool> at_nodes(surface.n_nodes(), false);
  for (const auto &patch : state::contact_patches(solver, state))
    if (!patch.is_light && patch.width < across)
      for (const unsigned int row : patch.rows)
        at_nodes[solver.contact(state.load_case).places()[row].slave] = true;
  for (const unsigned int node : nearly_closed(solver, state))
    at_nodes[node] = true;
  std::set<unsigned int> result;
  for (const auto &pair : solver.contact(state.load_case).pairs())
    {
      auto beside = at_nodes;
      for (const unsigned int face : faces_at(surface, pair, at_nodes))
        for (const unsigned int node : surface.faces()[face].nodes)
          beside[node] = true;
      const auto faces = faces_at(surface, pair, beside);
      result.insert(faces.begin(), faces.end());
    }
  return {result.begin(), result.end()};
}

template std::vector<unsigned int>
underresolved_contact(const state::StateSolver<2> &, const state::ContactState<2> &, double);
template std::vector<unsigned int>
underresolved_contact(const state::StateSolver<3> &, const state::ContactState<3> &, double);
} // namespace snug::accuracy
