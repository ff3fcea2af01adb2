#include <snug/base/errors.h>
#include <snug/supports/dirichlet_constraints.h>
#include <snug/supports/smooth_sides.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace snug::supports {
namespace {
/// A direction is held already if the sine of its angle to the held directions is below this value.
const double dependent_sine = 1e-6;

/// Distance from an axis, relative to the surface, that is zero but for round-off.
const double round_off = 1e-10;

/// Prescribed values agree if they differ by less than this fraction of the maximum value.
const double same_value = 1e-10;

/// A node is at the place of a point support if its distance is below this fraction of the
/// boundary.
const double same_place = 1e-3;

using Boundary = std::pair<unsigned int, unsigned int>;

/// Return the boundaries with supports; in axisymmetric models all boundaries, because each may
/// contain nodes on the axis.
template <int dim>
std::vector<Boundary> held_boundaries(const mesh::BodyMesh<dim>            &mesh,
                                      const std::vector<Support<dim>>      &supports,
                                      const std::vector<PointSupport<dim>> &points)
{
  std::vector<Boundary> boundaries;
  for (const auto &point : points)
    boundaries.emplace_back(point.body, point.boundary);
  for (const auto &support : supports)
    boundaries.emplace_back(support.body, support.boundary);
  if (mesh.idealization().is_axisymmetric())
    for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
      for (unsigned int b = 0; b < mesh.geometry(body).boundary_names().size(); ++b)
        boundaries.emplace_back(body, b);
  return boundaries;
}

/// Return "the node (x)".
template <int dim>
std::string node_at(const dealii::Tensor<1, dim> &x)
{
  std::ostringstream text;
  text << "the node (" << x << ")";
  return text.str();
}

/// Return the error of a design whose supports have become dependent: the optimizer steps back.
/// Supports that are dependent in the constructor are left out instead.
template <int dim>
TangledMesh dependent_error(const dealii::Tensor<1, dim> &x)
{
  return TangledMesh("the design makes the directions of the supports at " + node_at(x) +
                     " linearly dependent");
}

/// Return the error that names two conflicting supports and their values.
template <int dim>
InputError conflict(const dealii::Tensor<1, dim>         &x,
                    const std::pair<std::string, double> &a,
                    const std::pair<std::string, double> &b)
{
  std::ostringstream text;
  text << a.first << " and " << b.first << " prescribe different displacements, " << a.second
       << " and " << b.second << ", in the same direction at " << node_at(x);
  return InputError(text.str());
}
} // namespace

template <int dim>
DirichletConstraints<dim>::DirichletConstraints(const mesh::BodyMesh<dim>            &mesh,
                                                const std::vector<Support<dim>>      &supports,
                                                unsigned int                          n_load_cases,
                                                const Field                          &positions,
                                                const std::vector<PointSupport<dim>> &points)
  : mesh(mesh)
  , shape(mesh.degree())
  , n_load_cases(n_load_cases)
  , surface(mesh, held_boundaries(mesh, supports, points))
{
  const auto            x = surface.gather(positions);
  std::vector<Boundary> normal_boundaries;
  for (const auto &support : supports)
    if (support.component.is_normal())
      normal_boundaries.emplace_back(support.body, support.boundary);
  sides        = smooth_sides(surface, normal_boundaries, shape, x);
  side_of_face = std::vector<unsigned int>(surface.faces().size(), 0);
  for (unsigned int side = 0; side < sides.size(); ++side)
    for (const unsigned int face : sides[side])
      side_of_face[face] = side;
  const auto reference = surface.gather(mesh.reference_positions());
  Nodes      found;
  collect_holds(supports, reference, found);
  collect_points(points, reference, found);
  store(found);
  leave_out_dependent(x);
}

template <int dim>
void DirichletConstraints<dim>::add_hold(Nodes             &found,
                                         const unsigned int node,
                                         const Hold        &hold) const
{
  // A hanging node is held as far as its masters are, so a row of its own would repeat their rows.
  if (!surface.masters(node).empty())
    return;
  auto &holds = found[node].holds;
  // A node is on several faces of a boundary and of a side, but has one constraint for all of them.
  const bool known = std::any_of(holds.begin(), holds.end(), [&](const Hold &other) {
    return other.name == hold.name && other.component.number == hold.component.number &&
           other.side == hold.side;
  });
  if (!known)
    holds.push_back(hold);
}

template <int dim>
void DirichletConstraints<dim>::collect_holds(const std::vector<Support<dim>> &supports,
                                              const SurfaceField              &reference,
                                              Nodes                           &found) const
{
  const bool axis = mesh.idealization().is_axisymmetric();
  for (unsigned int f = 0; f < surface.faces().size(); ++f)
    {
      const auto &face = surface.faces()[f];
      for (const unsigned int node : face.nodes)
        // The comparison with zero is exact: meshes of revolution have exact zeros, and any other
        // radius is off the axis.
        if (axis && reference[node][0] == 0.)
          add_hold(found, node,
                   {"the axis of rotation", "", 0, 0, std::vector<double>(n_load_cases)});
    }
  for (const auto &support : supports)
    for (unsigned int f = 0; f < surface.faces().size(); ++f)
      {
        const auto &face = surface.faces()[f];
        if (face.body != support.body || face.boundary != support.boundary)
          continue;
        const bool normal = support.component.is_normal();
        for (const unsigned int node : face.nodes)
          {
            Hold hold{support.name,
                      support.face,
                      support.component,
                      normal ? side_of_face[f] : 0,
                      std::vector<double>(n_load_cases),
                      std::make_pair(support.body, support.boundary)};
            for (unsigned int c = 0; c < support.values.size(); ++c)
              if (support.values[c])
                hold.values[c] = support.values[c](dealii::Point<dim>(reference[node]));
            add_hold(found, node, hold);
          }
      }
}

/// Hold the node at each place.
template <int dim>
void DirichletConstraints<dim>::collect_points(const std::vector<PointSupport<dim>> &points,
                                               const SurfaceField                   &reference,
                                               Nodes                                &found) const
{
  std::map<Boundary, std::set<unsigned int>> nodes;
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
      add_hold(found, *nearest,
               {point.name, point.face, point.component, 0,
                std::vector<double>(n_load_cases, point.value),
                std::make_pair(point.body, point.boundary)});
    }
}

template <int dim>
void DirichletConstraints<dim>::store(const Nodes &found)
{
  for (const auto &entry : found)
    {
      nodes.push_back(entry.second);
      nodes.back().surface_node = entry.first;
      // Sort constant directions first, because orthonormalization keeps the first directions as
      // they are. The rows of constant directions have no derivatives.
      std::stable_sort(nodes.back().holds.begin(), nodes.back().holds.end(),
                       [](const Hold &a, const Hold &b) {
                         return !a.component.follows_positions() && b.component.follows_positions();
                       });
    }
}

template <int dim>
double DirichletConstraints<dim>::largest_value() const
{
  double largest = 0.;
  for (const Node &node : nodes)
    for (const Hold &hold : node.holds)
      for (const double value : hold.values)
        largest = std::max(largest, std::abs(value));
  return largest;
}

// Two supports may hold a node along one direction, such as faces that meet at an edge. With both
// rows B would be rank deficient, so the later row is left out, if it prescribes the same value.
template <int dim>
void DirichletConstraints<dim>::leave_out_dependent(const SurfaceField &positions)
{
  const auto   n         = normals(positions);
  const double tolerance = same_value * largest_value();
  double       size      = 0.;
  for (const auto &x : positions)
    size = std::max(size, (x - positions[0]).norm());
  for (Node &node : nodes)
    {
      std::vector<Hold> given;
      given.swap(node.holds);
      for (const Hold &hold : given)
        {
          const auto &x = positions[node.surface_node];
          if (hold.component.turns() && hold.component.lever(x).norm() <= round_off * size)
            throw InputError(hold.name + ": " + node_at(x) +
                             " on the axis has no radial and tangential components");
          const Orthonormalised<dim> before(given_frame(node, positions, n));
          node.holds.push_back(hold);
          const auto                 all = given_frame(node, positions, n);
          const Orthonormalised<dim> with(all);
          if (with.independence() > dependent_sine)
            continue;
          node.holds.pop_back();
          // displacement that the other constraints imply in the same direction
          const auto &frame   = before.frame();
          unsigned    nearest = 0;
          auto        implied = std::vector<double>(n_load_cases, 0.);
          for (unsigned int k = 0; k < frame.directions.size(); ++k)
            {
              const double share = all.directions.back() * frame.directions[k];
              for (unsigned int c = 0; c < n_load_cases; ++c)
                implied[c] += share * frame.values[k][c];
              if (std::abs(share) > std::abs(all.directions.back() * frame.directions[nearest]))
                nearest = k;
            }
          for (unsigned int c = 0; c < n_load_cases; ++c)
            if (std::abs(implied[c] - hold.values[c]) > tolerance)
              throw conflict(x, {node.holds[nearest].name, implied[c]},
                             {hold.name, hold.values[c]});
        }
      for (const Hold &hold : node.holds)
        node.follows = node.follows || hold.component.follows_positions();
      any_follows = any_follows || node.follows;
      constant_frames.push_back(Orthonormalised<dim>(given_frame(node, positions, n)).frame());
    }
}

template <int dim>
typename DirichletConstraints<dim>::Normals
DirichletConstraints<dim>::normals(const SurfaceField &positions) const
{
  Normals result;
  for (const auto &side : sides)
    result.emplace_back(surface, side, shape, positions);
  return result;
}

template <int dim>
ConstraintFrame<dim> DirichletConstraints<dim>::given_frame(const Node         &node,
                                                            const SurfaceField &positions,
                                                            const Normals      &n) const
{
  ConstraintFrame<dim> frame;
  for (const Hold &hold : node.holds)
    {
      dealii::Tensor<1, dim> normal;
      if (hold.component.is_normal())
        normal = n[hold.side].normals()[node.surface_node];
      frame.directions.push_back(hold.component.direction(positions[node.surface_node], normal));
      frame.values.push_back(hold.values);
    }
  return frame;
}

template <int dim>
unsigned int DirichletConstraints<dim>::find(unsigned int global_node) const
{
  const auto found = std::lower_bound(nodes.begin(), nodes.end(), global_node,
                                      [this](const Node &node, unsigned int global) {
                                        return surface.global_node(node.surface_node) < global;
                                      });
  return found != nodes.end() && surface.global_node(found->surface_node) == global_node
           ? found - nodes.begin()
           : nodes.size();
}

template <int dim>
typename DirichletConstraints<dim>::Frames
DirichletConstraints<dim>::frames(const Field &positions) const
{
  if (!follow_positions())
    return constant_frames;
  Frames     result = constant_frames;
  const auto x      = surface.gather(positions);
  const auto n      = normals(x);
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (nodes[i].follows)
      {
        const Orthonormalised<dim> constraints(given_frame(nodes[i], x, n));
        // The condition is written so that it also catches NaN.
        if (!(constraints.independence() > dependent_sine))
          throw dependent_error(x[nodes[i].surface_node]);
        result[i] = constraints.frame();
      }
  return result;
}

template <int dim>
faces::HeldDirections<dim> DirichletConstraints<dim>::directions(const mesh::Surface<dim> &surface,
                                                                 const Field &positions) const
{
  const Frames               at_nodes = frames(positions);
  faces::HeldDirections<dim> result(surface.n_nodes());
  for (unsigned int node = 0; node < result.size(); ++node)
    {
      const unsigned int held_node = find(surface.global_node(node));
      if (held_node < n_nodes())
        result[node] = at_nodes[held_node].directions;
    }
  return result;
}

template <int dim>
typename DirichletConstraints<dim>::Frames
DirichletConstraints<dim>::frame_derivatives(const Field &positions, const Field &velocity) const
{
  Frames result(nodes.size());
  if (!follow_positions())
    return result;
  const auto                x = surface.gather(positions);
  const auto                V = surface.gather(velocity);
  const auto                n = normals(x);
  std::vector<SurfaceField> dn;
  for (const auto &side : n)
    dn.push_back(side.derivative(V));
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (nodes[i].follows)
      {
        ConstraintFrame<dim> derivative;
        for (const Hold &hold : nodes[i].holds)
          {
            const unsigned int node = nodes[i].surface_node;
            derivative.directions.push_back(hold.component.is_normal()
                                              ? dn[hold.side][node]
                                              : hold.component.derivative(x[node]) * V[node]);
            // Prescribed displacements are functions of the reference position, so their
            // derivatives are 0.
            derivative.values.emplace_back(n_load_cases, 0.);
          }
        result[i] = Orthonormalised<dim>(given_frame(nodes[i], x, n)).derivative(derivative);
      }
  return result;
}

template class DirichletConstraints<2>;
template class DirichletConstraints<3>;
} // namespace snug::supports
