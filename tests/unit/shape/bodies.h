#ifndef snug_tests_unit_shape_bodies_h
#define snug_tests_unit_shape_bodies_h

#include <snug/shape/shapes.h>

#include <gtest/gtest.h>

#include <random>

namespace snug::test {
inline shape::BodyNames body_names()
{
  return {{"punch", "foundation"}};
}

/// A plain box and a graded one with a curved bottom and hanging nodes.
template <int dim>
std::vector<geometry::BodyMeshParameters> shape_bodies()
{
  std::vector<geometry::BodyMeshParameters> bodies(2);
  bodies[0].corner            = std::vector<double>(dim, 5.);
  bodies[0].cells             = std::vector<unsigned int>(dim, 2);
  bodies[1].corner            = std::vector<double>(dim, -1.);
  bodies[1].size              = std::vector<double>(dim, 2.);
  bodies[1].cells             = std::vector<unsigned int>(dim, 3);
  bodies[1].grading           = std::vector<double>(dim, 2.);
  bodies[1].curved_faces      = {{"bottom", "sphere 5"}};
  bodies[1].refine_where      = "x+y";
  bodies[1].local_refinements = 1;
  return bodies;
}

/// The unit cube of n cells per edge.
template <int dim>
std::vector<geometry::BodyMeshParameters> plain_cube(unsigned int n)
{
  std::vector<geometry::BodyMeshParameters> bodies(1);
  bodies[0].cells = std::vector<unsigned int>(dim, n);
  return bodies;
}

/// A shape of the top of @p body.
template <int dim>
shape::ShapeParameters on_top(const std::string &basis, const std::string &body = "foundation")
{
  shape::ShapeParameters parameters;
  parameters.basis = basis;
  parameters.face  = body + ".top";
  parameters.control_points =
    dim == 2 ? std::vector<unsigned int>{5} : std::vector<unsigned int>{4, 5};
  parameters.degree        = 2;
  parameters.filter_radius = 0.7;
  parameters.bounds        = {-0.5, 1.};
  return parameters;
}

/// A box that cuts the foundation in two of its sides.
template <int dim>
shape::ShapeParameters box_in_foundation(const std::string &basis)
{
  shape::ShapeParameters parameters;
  parameters.basis             = basis;
  parameters.bodies            = {"foundation"};
  parameters.control_points    = std::vector<unsigned int>(dim, 4);
  parameters.control_points[0] = 3;
  parameters.degree            = 2;
  parameters.box_corner        = std::vector<double>(dim, -0.4);
  parameters.box_size          = std::vector<double>(dim, 2.);
  parameters.bounds            = {-0.5, 1.};
  return parameters;
}

/// Three vector fields.
template <int dim>
shape::ShapeParameters formulas()
{
  shape::ShapeParameters parameters;
  parameters.basis  = "formula modes";
  parameters.modes  = {{"x", "y"}, {"max(x,y)", "0"}, {"0", "x*y"}};
  parameters.bounds = {-0.5, 1.};
  for (auto &mode : parameters.modes)
    if (dim == 3)
      mode.push_back("z^2+x");
  return parameters;
}

/// One of each basis, and of each interior; interiors do not know the
/// basis.
template <int dim>
std::vector<shape::ShapeParameters> all_shapes()
{
  auto on_face     = formulas<dim>();
  on_face.face     = "foundation.top";
  auto laplace     = on_top<dim>("node-wise");
  laplace.interior = shape::InteriorKind::Laplace;
  auto elastic     = on_top<dim>("B-spline patch");
  elastic.interior = shape::InteriorKind::elasticity;
  return {on_top<dim>("Bezier patch"),
          on_top<dim>("B-spline patch"),
          on_top<dim>("node-wise"),
          on_face,
          laplace,
          elastic,
          box_in_foundation<dim>("Bezier box"),
          box_in_foundation<dim>("B-spline box"),
          formulas<dim>()};
}

inline std::vector<double> random_numbers(unsigned int n, unsigned int seed)
{
  std::mt19937                           random(seed);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  std::vector<double>                    numbers(n);
  for (double &number : numbers)
    number = uniform(random);
  return numbers;
}

/// The message of the InputError that making a shape of the bodies above
/// throws; "" if there is none.
template <int dim>
std::string failure_reason(const shape::ShapeParameters &parameters)
{
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, shape_bodies<dim>(), 1);
  try
    {
      shape::Shapes<dim>(mesh, body_names(), {parameters});
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}

/// The message names the entry and says what counts.
template <int dim>
void expect_complaint(const shape::ShapeParameters &parameters,
                      const std::string            &entry,
                      const std::string            &says)
{
  const auto message = failure_reason<dim>(parameters);
  EXPECT_NE(message.find("'Shape/" + entry + "'"), std::string::npos) << entry << ": " << message;
  EXPECT_NE(message.find(says), std::string::npos) << says << ": " << message;
}
} // namespace snug::test

#endif
