#ifndef snug_tests_unit_faces_one_box_h
#define snug_tests_unit_faces_one_box_h

#include <unit/random_field.h>

#include <snug/faces/face_shape.h>
#include <snug/mesh/body_mesh.h>

#include <cmath>
#include <numeric>

/// The top of a unit box, with hanging nodes where x > 0.5 if @p refined; @p shape is that of
/// `Curved faces`, with samples of the true surface, or empty for a plane.
template <int dim>
struct BoxTop
{
  using Field = typename snug::mesh::Surface<dim>::Field;

  BoxTop(unsigned int degree, bool refined, const std::string &shape = "")
    : shape(degree)
    , mesh(MPI_COMM_WORLD, bodies(refined, shape), degree)
    , surface(mesh, {{0, 2 * dim - 1}})
    , positions(surface.gather(mesh.reference_positions()))
    , faces(surface.faces().size())
  {
    std::iota(faces.begin(), faces.end(), 0u);
  }

  static std::vector<snug::geometry::BodyMeshParameters> bodies(bool               refined,
                                                                const std::string &shape)
  {
    std::vector<snug::geometry::BodyMeshParameters> bodies(1);
    bodies[0].size           = std::vector<double>(dim, 1.);
    bodies[0].cells          = std::vector<unsigned int>(dim, 4);
    bodies[0].cells[dim - 1] = 1;
    if (refined)
      {
        bodies[0].refine_where      = "x-0.5";
        bodies[0].local_refinements = 1;
      }
    if (!shape.empty())
      {
        bodies[0].curved_faces["top"] = shape;
        bodies[0].sampled_boundaries  = {"top"};
      }
    return bodies;
  }

  Field random_field(unsigned int seed, unsigned int size) const
  {
    return snug::test::random_field<dim>(size, seed);
  }

  Field random_velocity(unsigned int seed) const { return random_field(seed, surface.n_points()); }

  Field moved(double factor, const Field &velocity) const
  {
    Field result = positions;
    for (unsigned int i = 0; i < result.size(); ++i)
      result[i] += factor * velocity[i];
    return result;
  }

  /// Move all points at random by up to 5e-4, some percent of the distances of samples.
  void shake() { positions = moved(5e-4, random_velocity(3)); }

  snug::faces::FaceShape<dim> shape;
  snug::mesh::BodyMesh<dim>   mesh;
  snug::mesh::Surface<dim>    surface;
  Field                       positions;
  std::vector<unsigned int>   faces;
};

template <typename Field>
double inner_product(const Field &a, const Field &b)
{
  double sum = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

#endif
