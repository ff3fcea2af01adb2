#ifndef snug_tests_unit_contact_two_boxes_h
#define snug_tests_unit_contact_two_boxes_h

#include <unit/random_field.h>

#include <snug/contact/contact.h>
#include <snug/contact/projection.h>
#include <snug/faces/nodal_normals.h>

#include <algorithm>
#include <cmath>

/// A slave box (body 0) whose lower face meets the upper face of a master box
/// (body 1) at height 1.
template <int dim>
struct TwoBoxes
{
  using Field  = typename snug::mesh::Surface<dim>::Field;
  using Bodies = std::vector<snug::geometry::BodyMeshParameters>;

  TwoBoxes(const Bodies                   &bodies,
           unsigned int                    degree,
           MPI_Comm                        communicator,
           const std::set<dealii::CellId> &refined = {})
    : mesh(make_mesh(bodies, degree, communicator, refined))
    , surface(mesh, snug::contact::boundaries_of({pair()}))
    , positions(surface.gather(mesh.reference_positions()))
    , held(surface.n_nodes())
  {}

  TwoBoxes(const Bodies &bodies, unsigned int degree) : TwoBoxes(bodies, degree, MPI_COMM_WORLD) {}

  /// Return the mesh of the boxes with further cells refined.
  static snug::mesh::BodyMesh<dim> make_mesh(const Bodies                   &bodies,
                                             unsigned int                    degree,
                                             MPI_Comm                        communicator,
                                             const std::set<dealii::CellId> &refined)
  {
    snug::mesh::Forest<dim> forest(communicator, bodies);
    forest.refine(refined);
    return {forest, degree, snug::mesh::Idealization::natural(dim),
            snug::mesh::TearingParameters()};
  }

  /// n_slave and n_master cells per tangent direction.
  static Bodies boxes(unsigned int n_slave, unsigned int n_master)
  {
    Bodies bodies(2);
    for (unsigned int b = 0; b < 2; ++b)
      {
        bodies[b].corner         = std::vector<double>(dim, 0.);
        bodies[b].size           = std::vector<double>(dim, 1.);
        bodies[b].cells          = std::vector<unsigned int>(dim, b == 0 ? n_slave : n_master);
        bodies[b].cells[dim - 1] = 1;
      }
    bodies[0].corner[dim - 1] = 1.;
    return bodies;
  }

  /// Hanging nodes on both sides, not opposite to each other.
  static Bodies hanging_boxes()
  {
    Bodies bodies               = boxes(3, 4);
    bodies[0].refine_where      = "0.5-x";
    bodies[0].local_refinements = 1;
    bodies[1].refine_where      = dim == 3 ? "x+y-1" : "x-0.5";
    bodies[1].local_refinements = 1;
    return bodies;
  }

  /// A ball pressed into a socket, in 2D a roller into a trough, both sides
  /// sampled: the lower box's top is convex about (0.5, .., 1 - @p radius),
  /// the upper box's bottom, which is smaller, concave.
  static Bodies ball_and_socket(unsigned int n_slave, unsigned int n_master, double radius)
  {
    Bodies            bodies         = boxes(n_slave, n_master);
    const std::string shape          = dim == 2 ? "cylinder z " : "sphere ";
    bodies[0].curved_faces["bottom"] = shape + std::to_string(-radius - 0.1);
    bodies[1].curved_faces["top"]    = shape + std::to_string(radius);
    for (unsigned int d = 0; d < dim - 1; ++d)
      {
        bodies[0].corner[d] = 0.1;
        bodies[0].size[d]   = 0.75;
      }
    bodies[0].sampled_boundaries = {"bottom"};
    bodies[1].sampled_boundaries = {"top"};
    return bodies;
  }

  static snug::contact::Pair pair()
  {
    snug::contact::Pair pair{{0, 2 * dim - 2}, {1, 2 * dim - 1}, "slave", "master"};
    pair.parameters.slave  = snug::contact::Slave::first;
    pair.parameters.method = snug::contact::Method::nodal;
    return pair;
  }

  snug::contact::Contact<dim> contact() const
  {
    auto used              = pair();
    used.parameters.method = method;
    return {surface, {used}, mesh.degree(), positions, held};
  }

  std::vector<snug::contact::Projection<dim>> projections() const
  {
    snug::contact::PairFaces sides;
    for (unsigned int f = 0; f < surface.faces().size(); ++f)
      (surface.faces()[f].body == 0 ? sides.slave : sides.master).push_back(f);
    const snug::faces::FaceShape<dim>    shape(mesh.degree());
    const snug::faces::NodalNormals<dim> normals(surface, sides.master, shape, positions);
    return snug::contact::project<dim>(surface, sides, shape, positions,
                                       {normals.normals(), Field(surface.n_nodes())});
  }

  /// Bend both sides, without penetration at first sight; hanging nodes follow
  /// their masters.
  void bend()
  {
    for (auto &x : positions)
      {
        const double y = dim == 3 ? x[1] : 0.3;
        x[dim - 1] += 0.08 * std::sin(2. * x[0] + y) + 0.05 * y * x[0];
        x[0] += 0.03 * std::cos(3. * y + x[0]);
      }
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      if (!surface.masters(node).empty())
        {
          positions[node] = 0.;
          for (const auto &master : surface.masters(node))
            positions[node] += master.second * positions[master.first];
        }
  }

  /// Rollers at x = 0.
  void hold_left()
  {
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      if (positions[node][0] == 0.)
        {
          held[node].emplace_back();
          held[node].back()[0] = 1.;
        }
  }

  /// Return a random field of displacements.
  Field random_field(unsigned int seed) const { return random_field(seed, surface.n_nodes()); }

  /// Return a random field of velocities of positions.
  Field random_velocity(unsigned int seed) const { return random_field(seed, surface.n_points()); }

  static Field random_field(unsigned int seed, unsigned int size)
  {
    return snug::test::random_field<dim>(size, seed);
  }

  bool is_master(unsigned int node) const
  {
    for (const auto &face : surface.faces())
      if (face.body == pair().master.body() &&
          std::find(face.nodes.begin(), face.nodes.end(), node) != face.nodes.end())
        return true;
    return false;
  }

  snug::mesh::BodyMesh<dim> mesh;
  snug::mesh::Surface<dim>  surface;
  Field                     positions;

  snug::faces::HeldDirections<dim> held;
  snug::contact::Method            method = snug::contact::Method::nodal;
};

/// a + factor * b
template <typename Field>
Field sum(const Field &a, double factor, const Field &b)
{
  Field result = a;
  for (std::size_t i = 0; i < a.size(); ++i)
    result[i] += factor * b[i];
  return result;
}

#endif
