#include <snug/faces/face_shape.h>
#include <snug/mesh/surface.h>
#include <snug/state/symmetry_planes.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace snug::state {
namespace {
/// Cosines of the angle between a curved face and a plane. Round-off of mesh files is below the
/// first cosine. Above the second cosine, the face is a fillet that touches the plane.
constexpr double least_cosine = 1e-3, most_cosine = 0.99;

/// A boundary with the components that supports hold; is_at_rest if all displacements are zero.
template <int dim>
struct Boundary
{
  std::string                           name; ///< "body.boundary"
  std::vector<supports::Component<dim>> components;
  bool                                  is_at_rest = true;
};

/// A plane of symmetry of a body.
template <int dim>
struct Plane
{
  std::string            name;
  unsigned int           body;
  dealii::Tensor<1, dim> normal;
  std::set<unsigned int> nodes; ///< surface nodes
};

template <int dim>
using Boundaries = std::map<contact::Boundary, Boundary<dim>>;

template <int dim>
Boundaries<dim> held_boundaries(const std::vector<supports::Support<dim>> &supports)
{
  Boundaries<dim> result;
  for (const auto &support : supports)
    {
      auto &of = result[{support.body, support.boundary}];
      of.name  = support.face;
      of.components.push_back(support.component);
      // A formula counts as nonzero without evaluation, because it may be zero at some points only.
      for (const auto &value : support.values)
        of.is_at_rest = of.is_at_rest && !value;
    }
  return result;
}

/// Return the plane that a boundary lies on, if it is one and is held along its normal alone.
template <int dim>
std::optional<Plane<dim>> plane_of(const contact::Boundary  &side,
                                   const Boundary<dim>      &boundary,
                                   const mesh::Surface<dim> &surface,
                                   const unsigned int        degree)
{
  Plane<dim>                  plane{boundary.name, side.first, {}, {}};
  const faces::FaceShape<dim> shape(degree);
  for (const auto &face : surface.faces())
    if (contact::Boundary(face.body, face.boundary) == side)
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        {
          auto n = faces::area_vector(
            faces::tangents<dim>(shape.at_node(k), face.nodes, surface.reference_positions()));
          n /= n.norm();
          if (plane.nodes.empty())
            plane.normal = n;
          if ((n - plane.normal).norm() > least_cosine)
            return {};
          plane.nodes.insert(face.nodes[k]);
        }
  const bool is_along =
    std::all_of(plane.nodes.begin(), plane.nodes.end(), [&](const unsigned int node) {
      const auto direction =
        boundary.components.front().direction(surface.reference_positions()[node], plane.normal);
      return std::abs(plane.normal * direction) > 1. - least_cosine * least_cosine;
    });
  return is_along && !plane.nodes.empty() ? std::optional(plane) : std::nullopt;
}

/// Return the nodes of @p surface on the axis of the model.
template <int dim>
std::set<unsigned int> nodes_on_axis(const mesh::Surface<dim> &surface)
{
  std::set<unsigned int> nodes;
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    if (surface.reference_positions()[node][0] == 0.)
      nodes.insert(node);
  return nodes;
}

/// Return whether a plane of the same body is opposite. A body between two opposite planes is
/// confined, and its apex may well be in the middle.
template <int dim>
bool is_opposed(const Plane<dim> &plane, const std::vector<Plane<dim>> &planes)
{
  return std::any_of(planes.begin(), planes.end(), [&](const Plane<dim> &other) {
    return other.body == plane.body && other.normal * plane.normal < -most_cosine;
  });
}

std::string line(const std::string &side, const std::string &plane, const double cosine)
{
  std::ostringstream text;
  text.precision(3);
  text
    << "'" << side << "' meets " << plane << " at "
    << std::acos(cosine) * 180. / dealii::numbers::PI
    << " degrees instead of 90: if this is a plane of symmetry, the full body has an edge there; "
       "'at' in 'Curved faces' of a box sets the apex";
  return text.str();
}
} // namespace

template <int dim>
std::vector<SymmetryPlane<dim>> symmetry_planes(const mesh::BodyMesh<dim>                 &mesh,
                                                const std::vector<supports::Support<dim>> &supports)
{
  const auto                      held = held_boundaries(supports);
  std::vector<SymmetryPlane<dim>> planes;
  for (const auto &[side, boundary] : held)
    if (boundary.is_at_rest && boundary.components.size() == 1)
      {
        const mesh::Surface<dim> surface(mesh, {side});
        if (const auto plane = plane_of(side, boundary, surface, mesh.degree()))
          planes.push_back(
            {plane->body, plane->normal,
             dealii::Point<dim>(surface.reference_positions()[*plane->nodes.begin()])});
      }
  if (mesh.idealization().is_axisymmetric())
    for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
      {
        planes.push_back({body, {}, {}});
        planes.back().normal[0] = 1.;
      }
  return planes;
}

template <int dim>
std::vector<std::string> symmetry_warnings(const mesh::BodyMesh<dim>                 &mesh,
                                           const std::vector<supports::Support<dim>> &supports,
                                           const std::vector<contact::Pair>          &pairs)
{
  const auto                               held = held_boundaries(supports);
  std::map<contact::Boundary, std::string> sides;
  for (const auto &pair : pairs)
    {
      for (const auto &boundary : pair.slave.boundaries())
        sides[boundary] = pair.slave_name;
      for (const auto &boundary : pair.master.boundaries())
        sides[boundary] = pair.master_name;
    }
  std::set<contact::Boundary> boundaries;
  for (const auto &[side, name] : sides)
    boundaries.insert(side);
  std::vector<contact::Boundary> candidates;
  for (const auto &[side, boundary] : held)
    if (boundary.is_at_rest && boundary.components.size() == 1)
      {
        boundaries.insert(side);
        candidates.push_back(side);
      }
  const mesh::Surface<dim> surface(mesh, {boundaries.begin(), boundaries.end()});
  std::vector<Plane<dim>>  planes;
  for (const auto &side : candidates)
    if (const auto plane = plane_of(side, held.at(side), surface, mesh.degree()))
      planes.push_back(*plane);
  dealii::Tensor<1, dim> along_x;
  along_x[0] = -1.; // outwards
  if (mesh.idealization().is_axisymmetric())
    for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
      planes.push_back({"", body, along_x, nodes_on_axis(surface)});

  std::map<std::pair<std::string, std::string>, double> largest;
  for (const auto &face : surface.faces())
    if (const auto side = sides.find({face.body, face.boundary});
        side != sides.end() && face.known != nullptr)
      for (const auto &plane : planes)
        for (const unsigned int node : face.nodes)
          if (plane.body == face.body && plane.nodes.count(node) > 0 && !is_opposed(plane, planes))
            {
              double &cosine = largest[{side->second, plane.name}];
              cosine         = std::max(cosine, std::abs(face.known->normal(dealii::Point<dim>(
                                                   surface.reference_positions()[node])) *
                                                         plane.normal));
            }
  std::vector<std::string> lines;
  for (const auto &[names, cosine] : largest)
    if (cosine > least_cosine && cosine < most_cosine)
      lines.push_back(
        line(names.first,
             names.second.empty() ? "the axis" : "'" + names.second + "', held along its normal,",
             cosine));
  return lines;
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template std::vector<SymmetryPlane<dim>> symmetry_planes(                                        \
    const mesh::BodyMesh<dim> &, const std::vector<supports::Support<dim>> &);                     \
  template std::vector<std::string> symmetry_warnings(const mesh::BodyMesh<dim> &,                 \
                                                      const std::vector<supports::Support<dim>> &, \
                                                      const std::vector<contact::Pair> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
