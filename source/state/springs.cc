#include <snug/base/errors.h>
#include <snug/state/boundary_point.h>
#include <snug/state/springs.h>
#include <snug/supports/smooth_sides.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace snug::state {
namespace {
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
spring_boundaries(const std::vector<supports::Spring<dim>> &springs)
{
  std::set<std::pair<unsigned int, unsigned int>> boundaries;
  for (const auto &spring : springs)
    boundaries.insert({spring.body, spring.boundary});
  return {boundaries.begin(), boundaries.end()};
}

/// Return the faces of a surface on the boundary of a spring.
template <int dim>
std::vector<unsigned int> faces_of(const mesh::Surface<dim>    &surface,
                                   const supports::Spring<dim> &spring)
{
  std::vector<unsigned int> result;
  for (unsigned int f = 0; f < surface.faces().size(); ++f)
    if (surface.faces()[f].body == spring.body && surface.faces()[f].boundary == spring.boundary)
      result.push_back(f);
  return result;
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
  set_scales(x);
}

/// Add a group for each smooth side of the boundary, because the normals of a sharp edge are those
/// of both sides.
template <int dim>
void Springs<dim>::add_sides(const supports::Spring<dim> &spring, const SurfaceField &x)
{
  const auto gauss = mesh::lagrange_gauss_points<dim - 1>(mesh.degree());
  const auto sides = spring.component.is_normal()
                       ? supports::smooth_sides(surface, {{spring.body, spring.boundary}}, shape, x)
                       : std::vector<std::vector<unsigned int>>{faces_of(surface, spring)};
  for (const auto &side : sides)
    {
      groups.push_back({&spring, side});
      for (const unsigned int face : side)
        {
          const auto points =
            face_load.quadrature_points(at_face(face, surface.reference_positions()));
          for (unsigned int q = 0; q < points.size(); ++q)
            {
              const double k = spring.stiffness(dealii::Point<dim>(points[q]));
              if (k < 0.)
                throw bad_entry(spring.entry.first, spring.entry.second,
                                "the stiffness must not be negative");
              if (k > 0.)
                places.push_back(
                  {static_cast<unsigned int>(groups.size()) - 1, face, gauss[q].value, 1., q, k});
            }
        }
    }
}

template <int dim>
void Springs<dim>::add_point(const supports::Spring<dim> &spring)
{
  const double k = spring.stiffness(*spring.place);
  if (k == 0.)
    return;
  const contact::NearestFace<dim> search(surface, faces_of(surface, spring), shape,
                                         surface.reference_positions());
  const auto                      found = face_at(surface, search, *spring.place, spring.entry);
  groups.push_back({&spring, {}});
  places.push_back({static_cast<unsigned int>(groups.size()) - 1, found.face,
                    shape.at(found.point.xi).value, 1., 0, k});
}

/// Compare the stiffnesses with that of the body near the face, E h^(dim - 2) times the thickness
/// or the circumference.
template <int dim>
void Springs<dim>::set_scales(const SurfaceField &x)
{
  for (auto &place : places)
    {
      double modulus = 0.;
      for (const auto &material : model.bodies[groups[place.group].spring->body].materials)
        modulus = std::max(modulus, material.youngs_modulus);
      const auto  &nodes = surface.faces()[place.face].nodes;
      const double size  = (x[nodes.back()] - x[nodes.front()]).norm();
      const double of_body =
        modulus * mesh.idealization().weight(sum(place, x)) * (dim == 3 ? size : 1.);
      place.scale = std::sqrt(1. + of_body / stiffness(place, x));
    }
}

template <int dim>
typename Springs<dim>::Nodes Springs<dim>::at_face(const unsigned int  face,
                                                   const SurfaceField &x) const
{
  Nodes result;
  for (const unsigned int node : surface.faces()[face].nodes)
    result.push_back(x[node]);
  return result;
}

/// Return a traction of the stiffness along the first axis at the Gauss point of the place alone.
template <int dim>
elasticity::FaceLoadValues<dim> Springs<dim>::load_of(const Place &place) const
{
  elasticity::FaceLoadValues<dim> load;
  load.traction.resize(shape.n_nodes()); // as many as Gauss points
  load.traction[place.gauss_point][0] = place.stiffness;
  return load;
}

/// Return kappa, or its derivative along @p velocity: the total force of the traction k at the
/// Gauss point.
template <int dim>
double Springs<dim>::stiffness(const Place        &place,
                               const SurfaceField &x,
                               const SurfaceField *velocity) const
{
  if (groups[place.group].spring->place)
    return velocity ? 0. : place.stiffness;
  const auto load = load_of(place);
  Nodes      f;
  if (velocity)
    face_load.force_derivative(at_face(place.face, x), at_face(place.face, *velocity), load, {}, f);
  else
    face_load.force(at_face(place.face, x), load, f);
  double total = 0.;
  for (const auto &force : f)
    total += force[0];
  return total;
}

/// Return sum_a N_a field_a.
template <int dim>
dealii::Tensor<1, dim> Springs<dim>::sum(const Place &place, const SurfaceField &field) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int a = 0; a < place.weights.size(); ++a)
    result += place.weights[a] * field[surface.faces()[place.face].nodes[a]];
  return result;
}

/// Return the row with c_a = N_a q. Masters have the shares of hanging nodes.
template <int dim>
SpringRow<dim> Springs<dim>::row(const Place &place, const dealii::Tensor<1, dim> &q) const
{
  std::map<unsigned int, double> weights;
  for (unsigned int a = 0; a < place.weights.size(); ++a)
    {
      const unsigned int node = surface.faces()[place.face].nodes[a];
      if (surface.masters(node).empty())
        weights[node] += place.weights[a];
      for (const auto &[master, share] : surface.masters(node))
        weights[master] += share * place.weights[a];
    }
  SpringRow<dim> result;
  result.scale = place.scale;
  for (const auto &[node, weight] : weights)
    // A point at a node has zeros at the other nodes.
    if (std::abs(weight) > 1e-12)
      result.coefficients.emplace_back(surface.global_node(node), weight * q);
  return result;
}

/// Return the nodal normals of a group; empty if its direction is not the normal.
template <int dim>
typename Springs<dim>::SurfaceField Springs<dim>::normals(const Group        &group,
                                                          const SurfaceField &x) const
{
  if (!group.spring->component.is_normal())
    return {};
  return faces::NodalNormals<dim>(surface, group.faces, shape, x).normals();
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
      const auto &component = groups[g].spring->component;
      const auto  n         = normals(groups[g], x);
      for (; place != places.end() && place->group == g; ++place)
        {
          dealii::Tensor<1, dim> normal;
          if (component.is_normal())
            normal = sum(*place, n) / sum(*place, n).norm();
          result.push_back(row(*place, component.direction(sum(*place, x), normal)));
          result.back().stiffness = stiffness(*place, x);
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
      const auto  &component = groups[g].spring->component;
      const auto   n         = normals(groups[g], x);
      SurfaceField dn;
      if (component.is_normal())
        dn = faces::NodalNormals<dim>(surface, groups[g].faces, shape, x).derivative(V);
      for (; place != places.end() && place->group == g; ++place)
        {
          auto dq = component.derivative(sum(*place, x)) * sum(*place, V);
          if (component.is_normal())
            {
              const auto   v = sum(*place, n), dv = sum(*place, dn);
              const double length = v.norm();
              dq                  = dv / length - (v * dv) / std::pow(length, 3) * v;
            }
          result.push_back(row(*place, dq));
          result.back().stiffness = stiffness(*place, x, &V);
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
      const auto  &component = groups[g].spring->component;
      const auto   n         = normals(groups[g], x);
      SurfaceField of_normals(surface.n_nodes());
      for (; i < places.size() && places[i].group == g; ++i)
        {
          const auto &place = places[i];
          const auto &nodes = surface.faces()[place.face].nodes;
          // neither c nor kappa of a spring at a point depends on the positions
          if (groups[g].spring->place)
            continue;
          const auto of_q =
            factor * (forces_of_w[i] * sum(place, u_here) + forces_of_u[i] * sum(place, w_here));
          const auto of_x = transpose(component.derivative(sum(place, x))) * of_q;
          for (unsigned int a = 0; a < nodes.size(); ++a)
            at_surface[nodes[a]] += place.weights[a] * of_x;
          if (component.is_normal())
            {
              const auto   v      = sum(place, n);
              const double length = v.norm();
              const auto   of_v   = of_q / length - (v * of_q) / std::pow(length, 3) * v;
              for (unsigned int a = 0; a < nodes.size(); ++a)
                of_normals[nodes[a]] += place.weights[a] * of_v;
            }
          // kappa' / kappa^2 f_u f_w, with kappa = k dA
          const double kappa = stiffness(place, x);
          Nodes        along(nodes.size()), values(nodes.size());
          for (auto &vector : along)
            vector[0] = 1.;
          face_load.add_force_gradient(at_face(place.face, x), load_of(place), along,
                                       factor * forces_of_u[i] * forces_of_w[i] / (kappa * kappa),
                                       values);
          for (unsigned int a = 0; a < nodes.size(); ++a)
            at_surface[nodes[a]] += values[a];
        }
      if (component.is_normal())
        faces::NodalNormals<dim>(surface, groups[g].faces, shape, x)
          .add_transpose(of_normals, at_surface);
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
