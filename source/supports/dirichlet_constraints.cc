#include <snug/base/errors.h>
#include <snug/supports/dirichlet_constraints.h>
#include <snug/supports/smooth_sides.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace snug::supports {
namespace {
/// A direction is held already if the sine of its angle to the held directions is below this value.
const double dependent_sine = 1e-6;

/// Distance from an axis, relative to the surface, that is zero but for round-off.
const double round_off = 1e-10;

/// Prescribed values agree if they differ by less than this fraction of the maximum value.
const double same_value = 1e-10;

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
  std::vector<Found> found;
  Displacements      displacements;
  collect_holds(supports, displacements, found);
  collect_points(points, displacements, found);
  store(std::move(found), displacements);
  leave_out_dependent(x);
}

// Two supports may hold a node along one direction, such as faces that meet at an edge. With both
// rows B would be rank deficient, so the later row is left out, if it prescribes the same value.
template <int dim>
void DirichletConstraints<dim>::leave_out_dependent(const SurfaceField &positions)
{
  const auto n       = normals(positions);
  double     largest = 0., size = 0.;
  for (const double value : values)
    largest = std::max(largest, std::abs(value));
  const double tolerance = same_value * largest;
  for (const auto &x : positions)
    size = std::max(size, (x - positions[0]).norm());
  std::size_t end = 0; // of the constraints that stay
  for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      const unsigned int node  = surface_nodes[i];
      const auto        &x     = positions[node];
      const std::size_t  first = end;
      for (std::size_t j = std::exchange(first_hold[i], end); j < first_hold[i + 1]; ++j)
        {
          const Holder &holder = holders[holds[j].holder];
          if (holder.component.turns() && holder.component.lever(x).norm() <= round_off * size)
            throw InputError(holder.name + ": " + node_at(x) +
                             " on the axis has no radial and tangential components");
          holds[end] = holds[j];
          std::copy_n(values.data() + j * n_load_cases, n_load_cases,
                      values.data() + end * n_load_cases);
          const auto                 all = given_frame(node, first, end + 1, positions, n);
          const Orthonormalised<dim> with(all);
          if (with.independence() > dependent_sine)
            {
              ++end;
              continue;
            }
          // displacement that the other constraints imply in the same direction
          const Orthonormalised<dim> before(given_frame(node, first, end, positions, n));
          const auto                &frame   = before.frame();
          unsigned                   nearest = 0;
          auto                       implied = std::vector<double>(n_load_cases, 0.);
          for (unsigned int k = 0; k < frame.directions.size(); ++k)
            {
              const double share = all.directions.back() * frame.directions[k];
              for (unsigned int c = 0; c < n_load_cases; ++c)
                implied[c] += share * frame.values[k][c];
              if (std::abs(share) > std::abs(all.directions.back() * frame.directions[nearest]))
                nearest = k;
            }
          for (unsigned int c = 0; c < n_load_cases; ++c)
            if (const double value = all.values.back()[c]; std::abs(implied[c] - value) > tolerance)
              throw conflict(x, {holders[holds[first + nearest].holder].name, implied[c]},
                             {holder.name, value});
        }
    }
  first_hold.back() = static_cast<unsigned int>(end);
  holds.resize(end);
  values.resize(end * n_load_cases);
  for (auto *numbers : {&surface_nodes, &first_hold})
    numbers->shrink_to_fit();
  holds.shrink_to_fit();
  values.shrink_to_fit();
  for (unsigned int i = 0; i < n_nodes(); ++i)
    any_follows = any_follows || follows_positions(i);
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
unsigned int DirichletConstraints<dim>::n_constant(const unsigned int held_node) const
{
  unsigned int end = first_hold[held_node];
  while (end < first_hold[held_node + 1] && !component(end).follows_positions())
    ++end;
  return end - first_hold[held_node];
}

template <int dim>
ConstraintFrame<dim> DirichletConstraints<dim>::given_frame(const unsigned int  surface_node,
                                                            const std::size_t   first,
                                                            const std::size_t   end,
                                                            const SurfaceField &positions,
                                                            const Normals      &n) const
{
  ConstraintFrame<dim> frame;
  for (std::size_t j = first; j < end; ++j)
    {
      dealii::Tensor<1, dim> normal;
      if (component(j).is_normal())
        normal = n[holds[j].side].normals()[surface_node];
      frame.directions.push_back(component(j).direction(positions[surface_node], normal));
      const auto value = values.begin() + j * n_load_cases;
      frame.values.emplace_back(value, value + n_load_cases);
    }
  return frame;
}

template <int dim>
unsigned int DirichletConstraints<dim>::find(unsigned int global_node) const
{
  const auto found = std::lower_bound(surface_nodes.begin(), surface_nodes.end(), global_node,
                                      [this](const unsigned int node, const unsigned int global) {
                                        return surface.global_node(node) < global;
                                      });
  return found != surface_nodes.end() && surface.global_node(*found) == global_node
           ? found - surface_nodes.begin()
           : n_nodes();
}

template <int dim>
typename DirichletConstraints<dim>::Frames
DirichletConstraints<dim>::frames(const Field &positions) const
{
  // Constant directions are the same at all positions.
  const auto x = any_follows ? surface.gather(positions) : surface.reference_positions();
  const auto n = any_follows ? normals(x) : Normals();
  Frames     result(n_load_cases);
  result.reserve(n_nodes(), holds.size());
  for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      const Orthonormalised<dim> constraints(given_frame(i, x, n));
      // The condition is written so that it also catches NaN.
      if (follows_positions(i) && !(constraints.independence() > dependent_sine))
        throw dependent_error(x[surface_nodes[i]]);
      result.push_back(constraints.frame());
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
        {
          const auto held = at_nodes.directions(held_node);
          result[node].assign(held.begin(), held.end());
        }
    }
  return result;
}

template <int dim>
typename DirichletConstraints<dim>::Frames
DirichletConstraints<dim>::frame_derivatives(const Field &positions, const Field &velocity) const
{
  const bool                follow = follow_positions();
  const auto                x      = follow ? surface.gather(positions) : SurfaceField();
  const auto                V      = follow ? surface.gather(velocity) : SurfaceField();
  const auto                n      = follow ? normals(x) : Normals();
  std::vector<SurfaceField> dn;
  for (const auto &side : n)
    dn.push_back(side.derivative(V));
  Frames result(n_load_cases);
  for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      ConstraintFrame<dim> derivative;
      if (follows_positions(i))
        {
          const unsigned int node = surface_nodes[i];
          for (unsigned int j = first_hold[i]; j < first_hold[i + 1]; ++j)
            {
              derivative.directions.push_back(component(j).is_normal()
                                                ? dn[holds[j].side][node]
                                                : component(j).derivative(x[node]) * V[node]);
              // Prescribed displacements are functions of the reference position, so their
              // derivatives are 0.
              derivative.values.emplace_back(n_load_cases, 0.);
            }
          derivative = Orthonormalised<dim>(given_frame(i, x, n)).derivative(derivative);
        }
      result.push_back(derivative);
    }
  return result;
}

template class DirichletConstraints<2>;
template class DirichletConstraints<3>;
} // namespace snug::supports
