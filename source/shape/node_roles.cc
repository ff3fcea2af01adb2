#include <snug/faces/face_shape.h>
#include <snug/shape/near_points.h>
#include <snug/shape/node_roles.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace snug::shape {
namespace {
/// Sine of the minimum angle between two faces that are different planes. Faces at a smaller
/// angle are one curved surface.
const double least_edge_sine = 0.5;

/// Remove the direction of n from P, unless the length of P n is below the threshold.
template <int dim>
void remove_direction(const dealii::Tensor<1, dim> &n, dealii::Tensor<2, dim> &P)
{
  // P is a projector, so left is the part of n normal to all directions removed before. If the
  // angle between n and the span of the removed directions is less than 30 degrees, n belongs to
  // the same curved surface as the removed directions.
  const auto   left   = P * n;
  const double length = left.norm();
  if (length >= least_edge_sine)
    P -= outer_product(left, left) / (length * length);
}

/// Return the unit normals at the nodes of a surface, one or several per node. Normals of faces
/// at an angle below 30 degrees are averaged.
template <int dim>
std::vector<std::vector<dealii::Tensor<1, dim>>>
plane_normals(const mesh::Surface<dim>                 &surface,
              const typename mesh::Surface<dim>::Field &positions,
              const unsigned int                        degree)
{
  const faces::FaceShape<dim>                      shape(degree);
  std::vector<std::vector<dealii::Tensor<1, dim>>> sums(surface.n_nodes());
  for (const auto &face : surface.faces())
    for (unsigned int k = 0; k < face.nodes.size(); ++k)
      {
        const auto area =
          faces::area_vector(faces::tangents<dim>(shape.at_node(k), face.nodes, positions));
        // The normal is evaluated at this node, because the normal of a curved face varies.
        auto      &planes = sums[face.nodes[k]];
        const auto same   = std::find_if(planes.begin(), planes.end(), [&area](const auto &plane) {
          const double cosine = plane * area / (plane.norm() * area.norm());
          return cosine * cosine > 1. - least_edge_sine * least_edge_sine && cosine > 0.;
        });
        if (same == planes.end())
          planes.push_back(area);
        else
          *same += area;
      }
  for (auto &planes : sums)
    for (auto &plane : planes)
      plane /= plane.norm();
  return sums;
}
} // namespace

template <int dim>
NodeRoles<dim>::NodeRoles(const ShapedFace<dim> &face, const double reach)
  : face_nodes(face.mesh().n_local_nodes(), none), projectors(face.mesh().n_local_nodes())
{
  find_face_nodes(face);
  free_near_nodes(face, reach);
  constrain_boundary_nodes(face);
  for (unsigned int node = 0; node < face_nodes.size(); ++node)
    if (face_nodes[node] != none)
      projectors[node] = 0.;
}

/// Nodes are found by their global numbers, because the face is gathered from all ranks.
template <int dim>
void NodeRoles<dim>::find_face_nodes(const ShapedFace<dim> &face)
{
  const auto &surface = face.surface();
  for (unsigned int node = 0; node < face_nodes.size(); ++node)
    {
      const unsigned int found = surface.find(face.mesh().global_node(node));
      if (found < surface.n_nodes())
        face_nodes[node] = found;
    }
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
NodeRoles<dim>::other_boundaries(const ShapedFace<dim> &face, const bool touching) const
{
  const auto               &mesh = face.mesh();
  const unsigned int        n    = mesh.geometry(face.body()).boundary_names().size();
  std::vector<unsigned int> touches(n, 0);
  // A boundary touches the face if they share a node.
  for (const auto &other : mesh.boundary_faces())
    if (other.body == face.body())
      for (const unsigned int node : other.nodes)
        if (face_nodes[node] != none)
          touches[other.boundary] = 1;
  // The faces that touch the shaped face may be on other ranks only.
  dealii::Utilities::MPI::max(touches, mesh.communicator(), touches);
  std::vector<std::pair<unsigned int, unsigned int>> result;
  for (unsigned int boundary = 0; boundary < n; ++boundary)
    if (!face.has(boundary) && (touches[boundary] == 1) == touching)
      result.emplace_back(face.body(), boundary);
  return result;
}

/// Nodes of other bodies stay, because bodies have no nodes in common.
template <int dim>
void NodeRoles<dim>::free_near_nodes(const ShapedFace<dim> &face, const double reach)
{
  const auto           &mesh = face.mesh();
  const NearPoints<dim> near(face.positions());
  for (unsigned int node = 0; node < projectors.size(); ++node)
    if (mesh.body_of_node(node) == face.body() && !mesh.is_hanging(node) &&
        (reach == 0. || near.distance(mesh.reference_positions()[node], reach) < reach))
      projectors[node] = dealii::unit_symmetric_tensor<dim>();
}

/// A node of both a held and a sliding boundary is held.
template <int dim>
void NodeRoles<dim>::constrain_boundary_nodes(const ShapedFace<dim> &face)
{
  const auto              &mesh = face.mesh();
  const mesh::Surface<dim> held(mesh, other_boundaries(face, false));
  const mesh::Surface<dim> sliding(mesh, other_boundaries(face, true));
  const auto               normals =
    plane_normals(sliding, sliding.gather(mesh.reference_positions()), mesh.degree());
  std::map<unsigned int, unsigned int> slides, holds;
  for (unsigned int node = 0; node < held.n_nodes(); ++node)
    holds[held.global_node(node)] = node;
  for (unsigned int node = 0; node < sliding.n_nodes(); ++node)
    slides[sliding.global_node(node)] = node;
  for (unsigned int node = 0; node < projectors.size(); ++node)
    {
      const unsigned int global = mesh.global_node(node);
      // The zero projector of a held node stays zero when sliding planes are removed below.
      if (holds.count(global) != 0)
        projectors[node] = 0.;
      const auto found = slides.find(global);
      if (found != slides.end())
        for (const auto &normal : normals[found->second])
          // Removing one normal leaves the tangents of the plane, removing two normals leaves the
          // edge between two planes, and removing three normals leaves no direction.
          remove_direction(normal, projectors[node]);
    }
}

template class NodeRoles<2>;
template class NodeRoles<3>;
} // namespace snug::shape
