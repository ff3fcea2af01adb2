#include <snug/base/errors.h>
#include <snug/supports/dirichlet_constraints.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace snug::supports {
namespace {
/// A node is at the place of a point support if its distance is below this fraction of the
/// boundary.
const double same_place = 1e-3;
} // namespace

template <int dim>
void DirichletConstraints<dim>::collect_holds(const std::vector<Support<dim>> &supports,
                                              Displacements                   &displacements,
                                              std::vector<Found>              &found)
{
  const auto &faces = surface.faces();
  if (mesh.idealization().is_axisymmetric())
    {
      for (const auto &face : faces)
        for (const unsigned int node : face.nodes)
          // The comparison with zero is exact: meshes of revolution have exact zeros, and any other
          // radius is off the axis.
          if (surface.reference_positions()[node][0] == 0.)
            found.push_back({node, {0, 0}});
      holders.push_back({"the axis of rotation", "", 0, {}});
      displacements.emplace_back();
    }
  for (const auto &support : supports)
    {
      const auto holder = static_cast<unsigned int>(holders.size());
      for (unsigned int f = 0; f < faces.size(); ++f)
        if (faces[f].body == support.body && faces[f].boundary == support.boundary)
          for (const unsigned int node : faces[f].nodes)
            found.push_back({node, {holder, support.component.is_normal() ? side_of_face[f] : 0}});
      holders.push_back({support.name, support.face, support.component,
                         std::make_pair(support.body, support.boundary)});
      displacements.push_back(support.values);
    }
}

/// Hold the node at each place.
template <int dim>
void DirichletConstraints<dim>::collect_points(const std::vector<PointSupport<dim>> &points,
                                               Displacements                        &displacements,
                                               std::vector<Found>                   &found)
{
  const auto &reference = surface.reference_positions();
  std::map<std::pair<unsigned int, unsigned int>, std::set<unsigned int>> nodes;
  for (const auto &face : surface.faces())
    nodes[{face.body, face.boundary}].insert(face.nodes.begin(), face.nodes.end());
  for (const auto &point : points)
    {
      const auto &candidates = nodes[{point.body, point.boundary}];
      const auto  distance   = [&](const unsigned int node) {
        return (reference[node] - point.place).norm();
      };
      const auto nearest =
        std::min_element(candidates.begin(), candidates.end(),
                         [&](const auto a, const auto b) { return distance(a) < distance(b); });
      double size = 0.;
      for (const unsigned int node : candidates)
        size = std::max(size, distance(node));
      if (nearest == candidates.end() || distance(*nearest) > same_place * size)
        {
          std::ostringstream text;
          text << point.name << ": there is no node of '" << point.face << "' at (" << point.place
               << ")";
          if (nearest != candidates.end())
            text << "; the nearest one is at (" << reference[*nearest] << ")";
          throw InputError(text.str());
        }
      found.push_back({*nearest, {static_cast<unsigned int>(holders.size()), 0}});
      holders.push_back(
        {point.name, point.face, point.component, std::make_pair(point.body, point.boundary)});
      displacements.emplace_back(n_load_cases,
                                 [u = point.value](const dealii::Point<dim> &) { return u; });
    }
}

template <int dim>
bool DirichletConstraints<dim>::is_equal(const Hold &a, const Hold &b) const
{
  const Holder &of_a = holders[a.holder], &of_b = holders[b.holder];
  return a.side == b.side && of_a.component.number == of_b.component.number &&
         of_a.name == of_b.name;
}

template <int dim>
void DirichletConstraints<dim>::store(std::vector<Found> found, const Displacements &displacements)
{
  std::stable_sort(found.begin(), found.end(),
                   [](const Found &a, const Found &b) { return a.surface_node < b.surface_node; });
  for (auto next = found.begin(); next != found.end();)
    {
      const unsigned int node = next->surface_node;
      std::vector<Hold>  of_node;
      for (; next != found.end() && next->surface_node == node; ++next)
        // A node is on several faces of a boundary and of a side, but has one constraint for all of
        // them.
        if (std::none_of(of_node.begin(), of_node.end(),
                         [&](const Hold &other) { return is_equal(next->hold, other); }))
          of_node.push_back(next->hold);
      // A hanging node is held as far as its masters are, so a row of its own would repeat their
      // rows.
      if (!surface.masters(node).empty())
        continue;
      // Sort constant directions first, because orthonormalization keeps the first directions as
      // they are. The rows of constant directions have no derivatives.
      std::stable_partition(of_node.begin(), of_node.end(), [&](const Hold &hold) {
        return !holders[hold.holder].component.follows_positions();
      });
      surface_nodes.push_back(node);
      first_hold.push_back(static_cast<unsigned int>(holds.size()));
      holds.insert(holds.end(), of_node.begin(), of_node.end());
      const dealii::Point<dim> reference(surface.reference_positions()[node]);
      for (const Hold &hold : of_node)
        for (unsigned int c = 0; c < n_load_cases; ++c)
          {
            const auto &of_holder = displacements[hold.holder];
            values.push_back(c < of_holder.size() && of_holder[c] ? of_holder[c](reference) : 0.);
          }
    }
  first_hold.push_back(static_cast<unsigned int>(holds.size()));
}

#define SNUG_INSTANTIATE(dim)                                                                     \
  template void DirichletConstraints<dim>::collect_holds(const std::vector<Support<dim>> &,       \
                                                         Displacements &, std::vector<Found> &);  \
  template void DirichletConstraints<dim>::collect_points(const std::vector<PointSupport<dim>> &, \
                                                          Displacements &, std::vector<Found> &); \
  template void DirichletConstraints<dim>::store(std::vector<Found>, const Displacements &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::supports
