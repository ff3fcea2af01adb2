#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/faces/held_directions.h>
#include <snug/faces/nodal_normals.h>
#include <snug/geometry/face_list.h>
#include <snug/shape/entries.h>
#include <snug/shape/shaped_face.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

namespace snug::shape {
namespace {
/// Maximum distance of a point of a plane from the plane, relative to the extent of the plane.
const double in_plane = 1e-6;

/// Sine of 25 degrees. A normal that is inclined more to a plane keeps this inclination, because
/// the inclination is intended.
const double most_lean = 0.42;

/// A plane boundary.
template <int dim>
struct Plane
{
  dealii::Tensor<1, dim> normal, point;
  double                 tolerance; ///< maximum distance of points of the plane [length]
  std::set<unsigned int> nodes;     ///< global numbers

  bool holds(const dealii::Tensor<1, dim> &x) const
  {
    return std::abs(normal * (x - point)) <= tolerance;
  }
};

template <int dim>
bool touches(const mesh::Surface<dim>                &surface,
             const typename mesh::Surface<dim>::Face &face,
             const Plane<dim>                        &plane)
{
  return std::any_of(face.nodes.begin(), face.nodes.end(), [&](unsigned int node) {
    return plane.nodes.count(surface.global_node(node)) > 0;
  });
}

/// Return the plane of a boundary, or nothing if the boundary is curved or the mesh has no faces
/// of the boundary. Collective.
template <int dim>
std::optional<Plane<dim>> plane_of(const mesh::BodyMesh<dim>                   &mesh,
                                   const std::pair<unsigned int, unsigned int> &boundary)
{
  const mesh::Surface<dim>    surface(mesh, {boundary});
  const auto                 &x = surface.reference_positions();
  const faces::FaceShape<dim> shape(mesh.degree());
  Plane<dim>                  plane;
  double                      extent = 0.;
  for (const auto &face : surface.faces())
    plane.normal += faces::area_vector(faces::tangents<dim>(shape.at_node(0), face.nodes, x));
  if (plane.normal.norm() == 0.)
    return {};
  plane.normal /= plane.normal.norm();
  plane.point = x[0];
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    {
      plane.nodes.insert(surface.global_node(node));
      extent = std::max(extent, (x[node] - x[0]).norm());
    }
  plane.tolerance = in_plane * extent;
  for (const auto &position : x)
    if (!plane.holds(position))
      return {};
  return plane;
}
} // namespace

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>> find_faces(const mesh::BodyMesh<dim> &mesh,
                                                              const BodyNames           &bodies,
                                                              const ShapeParameters     &parameters)
{
  SNUG_ASSERT_EQUAL(bodies.names.size(), mesh.n_bodies());
  std::vector<std::pair<unsigned int, unsigned int>> result;
  const auto require = [&](const bool good, const std::string &allowed) {
    if (!good)
      throw bad_entry(parameters.path("Face"), parameters.face, allowed);
  };
  for (const auto &face : geometry::face_list(parameters.face))
    {
      const auto        dot   = face.rfind('.');
      const std::string name  = face.substr(0, dot);
      const auto        found = std::find(bodies.names.begin(), bodies.names.end(), name);
      require(dot != std::string::npos && found != bodies.names.end(),
              "must be body.face with one of the bodies " + to_text(bodies.names));
      const unsigned int body     = found - bodies.names.begin();
      const auto        &known    = mesh.geometry(body).boundary_names();
      const auto         boundary = std::find(known.begin(), known.end(), face.substr(dot + 1));
      require(boundary != known.end(), "the faces of " + name + " are " + to_text(known));
      result.emplace_back(body, boundary - known.begin());
      require(body == result.front().first, "must have boundaries of one body");
      require(std::count(result.begin(), result.end(), result.back()) == 1,
              "must name each boundary once");
    }
  return result;
}

template <int dim>
ShapedFace<dim>::ShapedFace(const mesh::BodyMesh<dim> &mesh,
                            const BodyNames           &bodies,
                            const ShapeParameters     &parameters)
  : body_mesh(mesh), places(find_faces(mesh, bodies, parameters)), nodes(mesh, places)
{
  for (const auto &place : places)
    own_boundaries.push_back(place.second);
  // All ranks throw or none, because surfaces are replicated.
  if (nodes.n_nodes() == 0)
    throw bad_entry(parameters.path("Face"), parameters.face, "the mesh has no such faces");
  measure();
  surface_normals = unit_normals;
  find_border();
  keep_to_planes();
}

template <int dim>
bool ShapedFace<dim>::has(const unsigned int boundary) const
{
  return std::find(own_boundaries.begin(), own_boundaries.end(), boundary) != own_boundaries.end();
}

/// Normals and areas are computed once in the reference geometry, because bases are linear in the
/// design and do not depend on the moved positions.
template <int dim>
void ShapedFace<dim>::measure()
{
  const faces::FaceShape<dim> shape(body_mesh.degree());
  std::vector<unsigned int>   all(nodes.faces().size());
  std::iota(all.begin(), all.end(), 0u);
  const auto &reference = positions();
  unit_normals          = faces::NodalNormals<dim>(nodes, all, shape, reference).normals();
  unit_normals.resize(nodes.n_points());
  const auto at_samples = mesh::lagrange_nodes<dim - 1>(mesh::surface_degree);
  for (const auto &face : nodes.faces())
    for (unsigned int k = 0; k < face.samples.size(); ++k)
      {
        const unsigned int sample = face.samples[k];
        const auto         area =
          faces::area_vector(faces::tangents<dim>(at_samples[k], face.samples, reference));
        unit_normals[sample] = face.known != nullptr
                                 ? face.known->normal(dealii::Point<dim>(reference[sample]))
                                 : area / area.norm();
      }
  Field weights(nodes.n_nodes());
  for (const auto &face : nodes.faces())
    for (unsigned int k = 0; k < face.nodes.size(); ++k)
      // The quadrature has the nodes as points and equal weights: the area element at node k is
      // divided by the number of nodes.
      weights[face.nodes[k]][0] +=
        faces::area_vector(faces::tangents<dim>(shape.at_node(k), face.nodes, reference)).norm() /
        face.nodes.size();
  // The areas are component 0 of a vector field, because distribute_hanging() takes vectors.
  distribute_hanging(weights);
  for (const auto &weight : weights)
    node_areas.push_back(weight[0]);
  node_areas.resize(nodes.n_points(), 0.);
}

/// Only other boundaries of the same body are searched, because bodies have no nodes in common.
template <int dim>
void ShapedFace<dim>::find_border()
{
  std::vector<unsigned int> elsewhere; // global nodes of other boundaries of the body
  for (const auto &face : body_mesh.boundary_faces())
    if (face.body == body() && !has(face.boundary))
      for (const unsigned int node : face.nodes)
        elsewhere.push_back(body_mesh.global_node(node));
  std::sort(elsewhere.begin(), elsewhere.end());
  std::vector<unsigned int> marks(nodes.n_nodes(), 0);
  for (unsigned int node = 0; node < marks.size(); ++node)
    marks[node] = std::binary_search(elsewhere.begin(), elsewhere.end(), nodes.global_node(node));
  // A face of the other boundary may be on another rank than this node.
  dealii::Utilities::MPI::max(marks, body_mesh.communicator(), marks);
  on_border.assign(marks.begin(), marks.end());
}

/// At the edge of a curved face the mean normal is one-sided. Without the projection the normal
/// would be inclined to a symmetry plane by half of the angle between two faces, and designs would
/// leave the symmetry plane.
template <int dim>
void ShapedFace<dim>::keep_to_planes()
{
  faces::HeldDirections<dim> held(nodes.n_points());
  for (unsigned int b = 0; b < body_mesh.geometry(body()).boundary_names().size(); ++b)
    {
      if (has(b))
        continue;
      const auto plane = plane_of<dim>(body_mesh, {body(), b});
      if (!plane)
        continue;
      std::set<unsigned int> points; // points of the faces that touch the plane
      for (const auto &face : nodes.faces())
        if (touches(nodes, face, *plane))
          for (const auto *of_face : {&face.nodes, &face.samples})
            points.insert(of_face->begin(), of_face->end());
      for (const unsigned int point : points)
        if (plane->holds(positions()[point]) &&
            std::abs(plane->normal * unit_normals[point]) < most_lean)
          {
            const auto q = faces::free_part(plane->normal, held[point]);
            if (q.norm() > most_lean) // otherwise a plane before has nearly the same normal
              held[point].push_back(q / q.norm());
          }
    }
  for (unsigned int point = 0; point < held.size(); ++point)
    if (!held[point].empty())
      {
        unit_normals[point] = faces::free_part(unit_normals[point], held[point]);
        unit_normals[point] /= unit_normals[point].norm();
      }
}

template <int dim>
std::vector<unsigned int> ShapedFace<dim>::needed_points() const
{
  std::vector<unsigned int> result(nodes.n_nodes());
  std::iota(result.begin(), result.end(), 0u);
  for (const auto &sample : nodes.samples())
    result.push_back(sample.first);
  return result;
}

/// One pass suffices, because masters are never hanging.
template <int dim>
void ShapedFace<dim>::distribute_hanging(Field &field) const
{
  for (unsigned int node = 0; node < nodes.n_nodes(); ++node)
    if (is_hanging(node))
      {
        for (const auto &master : nodes.masters(node))
          field[master.first] += master.second * field[node];
        field[node] = 0.;
      }
}

/// The directions have unit length, so that variables are heights.
template <int dim>
typename ShapedFace<dim>::Field face_directions(const ShapedFace<dim> &face,
                                                const ShapeParameters &parameters)
{
  if (parameters.direction.empty())
    return face.normals();
  return
    typename ShapedFace<dim>::Field(face.surface().n_points(), unit_direction<dim>(parameters));
}

#define SNUG_INSTANTIATE(dim)                                                        \
  template class ShapedFace<dim>;                                                    \
  template typename ShapedFace<dim>::Field face_directions(const ShapedFace<dim> &,  \
                                                           const ShapeParameters &); \
  template std::vector<std::pair<unsigned int, unsigned int>> find_faces<dim>(       \
    const mesh::BodyMesh<dim> &, const BodyNames &, const ShapeParameters &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::shape
