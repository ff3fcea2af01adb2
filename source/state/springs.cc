#include <snug/base/errors.h>
#include <snug/state/boundary_point.h>
#include <snug/state/springs.h>
#include <snug/supports/smooth_sides.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace snug::state {
namespace {
/// Nodes with less than this part of the maximum stiffness of a side have no spring. Their area is
/// zero except for rounding.
const double least_stiffness = 1e-10;

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
spring_boundaries(const std::vector<supports::Spring<dim>> &springs)
{
  std::set<std::pair<unsigned int, unsigned int>> boundaries;
  for (const auto &spring : springs)
    boundaries.insert({spring.body, spring.boundary});
  return {boundaries.begin(), boundaries.end()};
}
} // namespace

template <int dim>
Springs<dim>::Springs(const mesh::BodyMesh<dim>       &mesh,
                      const Model<dim>                &model,
                      const elasticity::FaceLoad<dim> &face_load,
                      const Field                     &positions)
  : mesh(mesh)
  , model(model)
  , face_load(face_load)
  , shape(mesh.degree())
  , surface(mesh, spring_boundaries(model.springs))
{
  if (model.springs.empty())
    return;
  const auto x = surface.gather(positions);
  for (const auto &spring : model.springs)
    if (spring.place)
      add_point(spring);
    else
      add_sides(spring, x);
  std::vector<double> size(surface.n_nodes(), 0.);
  for (const auto &face : surface.faces())
    for (const unsigned int node : face.nodes)
      size[node] = std::max(size[node], (x[face.nodes.back()] - x[face.nodes.front()]).norm());
  for (unsigned int g = 0; g < groups.size(); ++g)
    {
      const auto &group    = groups[g];
      double      softness = 0.; // of the body
      for (const auto &material : model.bodies[group.spring->body].materials)
        softness = std::max(softness, material.youngs_modulus);
      const auto scale = [&](const unsigned int node, const double stiffness) {
        const double of_body =
          softness * mesh.idealization().weight(x[node]) * std::pow(size[node], dim - 2);
        return std::sqrt(1. + of_body / stiffness);
      };
      if (group.spring->place)
        {
          const double stiffness = group.spring->stiffness(*group.spring->place);
          if (stiffness > 0.)
            places.push_back({g, without_hanging(group.at), scale(group.at[0].first, stiffness)});
          continue;
        }
      const auto   kappa   = stiffnesses(group, x);
      const double largest = *std::max_element(kappa.begin(), kappa.end());
      for (unsigned int node = 0; node < kappa.size(); ++node)
        if (kappa[node] > least_stiffness * largest)
          places.push_back({g, {{node, 1.}}, scale(node, kappa[node])});
    }
}

/// Add a group for each smooth side of the boundary, because a node at a sharp edge has a normal on
/// each side.
template <int dim>
void Springs<dim>::add_sides(const supports::Spring<dim> &spring, const SurfaceField &x)
{
  std::vector<std::vector<unsigned int>> sides(1);
  if (spring.component == supports::Support<dim>::normal)
    sides = supports::smooth_sides(surface, {{spring.body, spring.boundary}}, shape, x);
  else
    for (unsigned int f = 0; f < surface.faces().size(); ++f)
      if (surface.faces()[f].body == spring.body && surface.faces()[f].boundary == spring.boundary)
        sides[0].push_back(f);
  for (const auto &side : sides)
    {
      groups.push_back({&spring, side, {}});
      for (const unsigned int face : side)
        for (const auto &traction : load_of(groups.back(), face).traction)
          if (traction[0] < 0.)
            throw InputError(spring.name + ": the stiffness must not be negative");
    }
}

template <int dim>
void Springs<dim>::add_point(const supports::Spring<dim> &spring)
{
  std::vector<unsigned int> of_boundary;
  for (unsigned int f = 0; f < surface.faces().size(); ++f)
    if (surface.faces()[f].body == spring.body && surface.faces()[f].boundary == spring.boundary)
      of_boundary.push_back(f);
  const contact::NearestFace<dim> search(surface, of_boundary, shape,
                                         surface.reference_positions());
  const auto                      found = face_at(surface, search, *spring.place, spring.name);
  Group                           group{&spring, {}, {}};
  const auto                      values = shape.at(found.point.xi).value;
  for (unsigned int a = 0; a < values.size(); ++a)
    group.at.emplace_back(surface.faces()[found.face].nodes[a], values[a]);
  groups.push_back(group);
}

/// Return the weights of masters for those of hanging nodes.
template <int dim>
typename Springs<dim>::Weights Springs<dim>::without_hanging(const Weights &weights) const
{
  std::map<unsigned int, double> sums;
  for (const auto &[node, weight] : weights)
    {
      if (surface.masters(node).empty())
        sums[node] += weight;
      for (const auto &[master, share] : surface.masters(node))
        sums[master] += share * weight;
    }
  return {sums.begin(), sums.end()};
}

template <int dim>
bool Springs<dim>::is_normal(const Group &group) const
{
  return group.spring->component == supports::Support<dim>::normal;
}

template <int dim>
std::vector<dealii::Tensor<1, dim>> Springs<dim>::at_face(const unsigned int  face,
                                                          const SurfaceField &x) const
{
  std::vector<dealii::Tensor<1, dim>> result;
  for (const unsigned int node : surface.faces()[face].nodes)
    result.push_back(x[node]);
  return result;
}

/// Return the stiffness per area as the first component of a traction, whose nodal forces are then
/// the stiffnesses of the nodes.
template <int dim>
elasticity::FaceLoadValues<dim> Springs<dim>::load_of(const Group       &group,
                                                      const unsigned int face) const
{
  elasticity::FaceLoadValues<dim> load;
  for (const auto &x : face_load.quadrature_points(at_face(face, surface.reference_positions())))
    {
      load.traction.emplace_back();
      load.traction.back()[0] = group.spring->stiffness(dealii::Point<dim>(x));
    }
  return load;
}

/// Return the stiffnesses of all surface nodes, or their derivatives along @p velocity. Hanging
/// nodes have none.
template <int dim>
std::vector<double> Springs<dim>::stiffnesses(const Group        &group,
                                              const SurfaceField &x,
                                              const SurfaceField *velocity) const
{
  std::vector<double>                 result(surface.n_nodes(), 0.);
  std::vector<dealii::Tensor<1, dim>> f;
  for (const unsigned int face : group.faces)
    {
      if (velocity)
        face_load.force_derivative(at_face(face, x), at_face(face, *velocity), load_of(group, face),
                                   {}, f);
      else
        face_load.force(at_face(face, x), load_of(group, face), f);
      Weights shares;
      for (unsigned int a = 0; a < f.size(); ++a)
        shares.emplace_back(surface.faces()[face].nodes[a], f[a][0]);
      for (const auto &[node, share] : without_hanging(shares))
        result[node] += share;
    }
  return result;
}

/// Add d/dX sum_a factors_a kappa_a to the gradient.
template <int dim>
void Springs<dim>::add_stiffness_gradient(const Group               &group,
                                          const SurfaceField        &x,
                                          const std::vector<double> &factors,
                                          SurfaceField              &gradient) const
{
  for (const unsigned int face : group.faces)
    {
      const auto                         &nodes = surface.faces()[face].nodes;
      std::vector<dealii::Tensor<1, dim>> of_nodes(nodes.size()), values(nodes.size());
      for (unsigned int a = 0; a < nodes.size(); ++a)
        for (const auto &[node, share] : without_hanging({{nodes[a], 1.}}))
          of_nodes[a][0] += share * factors[node];
      face_load.add_force_gradient(at_face(face, x), load_of(group, face), of_nodes, 1., values);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        gradient[nodes[a]] += values[a];
    }
}

template <int dim>
dealii::Tensor<1, dim> Springs<dim>::direction(const Group        &group,
                                               const SurfaceField &normals,
                                               const unsigned int  node) const
{
  if (is_normal(group))
    return normals[node];
  return dealii::Point<dim>::unit_vector(group.spring->component);
}

template <int dim>
std::vector<SpringRow<dim>> Springs<dim>::rows(const Field &positions) const
{
  std::vector<SpringRow<dim>> result;
  if (empty())
    return result;
  const auto x     = surface.gather(positions);
  auto       place = places.begin();
  for (unsigned int g = 0; g < groups.size(); ++g)
    {
      const auto  &group = groups[g];
      SurfaceField normals;
      if (is_normal(group))
        normals = faces::NodalNormals<dim>(surface, group.faces, shape, x).normals();
      const auto kappa = stiffnesses(group, x);
      for (; place != places.end() && place->group == g; ++place)
        {
          SpringRow<dim> row;
          for (const auto &[node, weight] : place->weights)
            row.coefficients.emplace_back(surface.global_node(node),
                                          weight * direction(group, normals, node));
          row.stiffness = group.spring->place ? group.spring->stiffness(*group.spring->place)
                                              : kappa[place->weights[0].first];
          row.scale     = place->scale;
          // The condition is written so that it catches NaN.
          if (!(row.stiffness > 0.))
            throw TangledMesh("the design makes the area of a face with springs vanish");
          result.push_back(row);
        }
    }
  return result;
}

template <int dim>
std::vector<SpringRow<dim>> Springs<dim>::row_derivatives(const Field &positions,
                                                          const Field &velocity) const
{
  std::vector<SpringRow<dim>> result;
  if (empty())
    return result;
  const auto x = surface.gather(positions), V = surface.gather(velocity);
  auto       place = places.begin();
  for (unsigned int g = 0; g < groups.size(); ++g)
    {
      const auto  &group = groups[g];
      SurfaceField normals(surface.n_nodes());
      if (is_normal(group))
        normals = faces::NodalNormals<dim>(surface, group.faces, shape, x).derivative(V);
      const auto kappa = stiffnesses(group, x, &V);
      for (; place != places.end() && place->group == g; ++place)
        {
          SpringRow<dim> row;
          for (const auto &[node, weight] : place->weights)
            row.coefficients.emplace_back(surface.global_node(node), weight * normals[node]);
          if (!group.spring->place)
            row.stiffness = kappa[place->weights[0].first];
          result.push_back(row);
        }
    }
  return result;
}

template <int dim>
void Springs<dim>::add_energy_gradient(const Field               &positions,
                                       const std::vector<double> &forces_of_u,
                                       const Field               &u,
                                       const std::vector<double> &forces_of_w,
                                       const Field               &w,
                                       const double               factor,
                                       Field                     &gradient) const
{
  if (empty())
    return;
  const auto x = surface.gather(positions), u_here = surface.gather(u), w_here = surface.gather(w);
  SurfaceField at_surface(surface.n_points());
  unsigned int i = 0;
  for (unsigned int g = 0; g < groups.size(); ++g)
    {
      const auto         &group = groups[g];
      const auto          kappa = stiffnesses(group, x);
      SurfaceField        of_normals(surface.n_nodes());
      std::vector<double> of_stiffness(surface.n_nodes(), 0.);
      for (; i < places.size() && places[i].group == g; ++i)
        {
          const unsigned int node = places[i].weights[0].first;
          if (group.spring->place)
            continue; // neither c nor kappa depends on the positions
          of_normals[node] +=
            factor * (forces_of_w[i] * u_here[node] + forces_of_u[i] * w_here[node]);
          of_stiffness[node] +=
            factor * forces_of_u[i] * forces_of_w[i] / (kappa[node] * kappa[node]);
        }
      if (is_normal(group))
        faces::NodalNormals<dim>(surface, group.faces, shape, x)
          .add_transpose(of_normals, at_surface);
      add_stiffness_gradient(group, x, of_stiffness, at_surface);
    }
  surface.add_owned(at_surface, gradient);
}

template <int dim>
std::vector<typename Springs<dim>::Force>
Springs<dim>::forces(const Field &positions, const std::vector<double> &forces_of_u) const
{
  std::vector<Force> result;
  if (empty())
    return result;
  const auto x   = surface.gather(positions);
  const auto all = rows(positions);
  for (unsigned int i = 0; i < all.size(); ++i)
    {
      const auto &spring = *groups[places[i].group].spring;
      for (const auto &[node, c] : all[i].coefficients)
        result.push_back({spring.face, spring.body, x[surface.find(node)], -forces_of_u[i] * c});
    }
  return result;
}

template class Springs<2>;
template class Springs<3>;
} // namespace snug::state
