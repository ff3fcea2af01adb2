#include <snug/state/contact_patches.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace snug::state {
namespace {
/// Return connected sets of rows with a force, pair by pair, keyed by the first row of each set.
template <int dim>
std::map<unsigned int, std::vector<unsigned int>> connected_rows(const StateSolver<dim>  &solver,
                                                                 const ContactState<dim> &state)
{
  const auto               &contact = solver.contact(state.load_case);
  const auto               &places  = contact.places();
  std::vector<unsigned int> first(places.size());
  std::iota(first.begin(), first.end(), 0u);
  const auto root = [&first](unsigned int row) {
    while (first[row] != row)
      row = first[row] = first[first[row]];
    return row;
  };
  // Use pair and node as the key, because several pairs may have rows at one node.
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> row_at;
  for (unsigned int i = 0; i < places.size(); ++i)
    if (state.contact[i].strong)
      row_at[{places[i].pair, places[i].slave}] = i;
  for (unsigned int pair = 0; pair < contact.pairs().size(); ++pair)
    for (const auto &face : solver.surface().faces())
      {
        std::vector<unsigned int> roots;
        for (const unsigned int node : face.nodes)
          if (const auto row = row_at.find({pair, node}); row != row_at.end())
            roots.push_back(root(row->second));
        for (const unsigned int other : roots)
          {
            const auto [low, high] = std::minmax({root(other), root(roots.front())});
            first[high]            = low;
          }
      }
  std::map<unsigned int, std::vector<unsigned int>> result;
  for (const auto &[place, row] : row_at)
    result[root(row)].push_back(row);
  return result;
}

/// Return ContactPatch::width.
template <int dim>
double width(const StateSolver<dim>                   &solver,
             const std::vector<contact::RowPlace>     &places,
             const std::vector<unsigned int>          &rows,
             const typename mesh::Surface<dim>::Field &x,
             const std::vector<double>                &sizes)
{
  dealii::Tensor<1, dim> mean;
  double                 size = 0., at_support = 1.;
  const auto             node = [&](unsigned int row) { return places[row].slave; };
  for (const unsigned int row : rows)
    {
      mean += x[node(row)] / double(rows.size());
      size += sizes[node(row)] / double(rows.size());
      if (solver.held().find(solver.surface().global_node(node(row))) < solver.held().n_nodes())
        at_support = 2.;
    }
  dealii::SymmetricTensor<2, dim> spread;
  for (const unsigned int row : rows)
    spread += symmetrize(outer_product(x[node(row)] - mean, x[node(row)] - mean));
  // Eigenvalues are in descending order. The axis is along the line in 2D, and the shorter axis in
  // the face in 3D.
  const auto axis  = eigenvectors(spread)[dim - 2].second;
  double     lower = 0., upper = 0.;
  for (const unsigned int row : rows)
    {
      lower = std::min(lower, (x[node(row)] - mean) * axis);
      upper = std::max(upper, (x[node(row)] - mean) * axis);
    }
  return at_support * (upper - lower) / size + 1.;
}
} // namespace

template <int dim>
std::vector<ContactPatch> contact_patches(const StateSolver<dim>  &solver,
                                          const ContactState<dim> &state)
{
  const auto               &contact = solver.contact(state.load_case);
  const auto               &places  = contact.places();
  const auto               &x       = state.surface_positions;
  const auto                sizes   = contact::node_face_sizes(solver.surface(), x);
  std::vector<ContactPatch> patches;
  std::vector<double>       forces, of_pair(contact.pairs().size(), 0.);
  std::vector<bool>         is_open(of_pair.size(), false);
  for (unsigned int i = 0; i < places.size(); ++i)
    if (!state.contact[i].strong)
      is_open[places[i].pair] = true;
  for (const auto &[first, rows] : connected_rows(solver, state))
    {
      const unsigned int pair = places[first].pair;
      patches.push_back({pair, rows});
      patches.back().width = is_open[pair] ? width(solver, places, rows, x, sizes)
                                           : std::numeric_limits<double>::infinity();
      forces.push_back(0.);
      for (const unsigned int row : rows)
        forces.back() += state.contact[row].force;
      of_pair[pair] += forces.back();
    }
  for (unsigned int p = 0; p < patches.size(); ++p)
    patches[p].is_light = forces[p] < light_patch * of_pair[patches[p].pair];
  return patches;
}

template std::vector<ContactPatch> contact_patches(const StateSolver<2> &, const ContactState<2> &);
template std::vector<ContactPatch> contact_patches(const StateSolver<3> &, const ContactState<3> &);
} // namespace snug::state
