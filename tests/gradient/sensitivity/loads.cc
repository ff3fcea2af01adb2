#include <gradient/sensitivity/curved_scene.h>

/// Springs, temperatures and concentrated forces.
namespace {
using namespace snug;
using namespace snug::test;

/// The foundation on springs, also on the face that the design bends and along a direction that
/// supports hold.
template <int dim>
TestScene<dim> springs_on_the_bent_face(unsigned int n_cells, unsigned int n_heights)
{
  auto  scene      = curved_scene<dim>(n_cells, n_heights, 0.04);
  auto &foundation = scene.bodies[1];
  foundation.supports[face_index(dim - 1, 0)].pop_back();
  foundation.springs[face_index(dim - 1, 0)] = {{0, 40.}, {dim - 1, 2000.}};
  foundation.springs[face_index(0, 1)]       = {{dim, 300.}, {dim - 1, 90.}};
  foundation.body_force[0]                   = 1.;
  return scene;
}

TEST(Gradient, Springs2D)
{
  for (const unsigned int degree : {1, 2})
    {
      auto given                    = springs_on_the_bent_face<2>(degree == 1 ? 6 : 3, 4);
      given.degree                  = degree;
      given.bodies[1].refined_below = 0.45;
      GradientScene<2> scene(given, 0.05, "foundation.right", 0);
      check_derivatives(scene);
      check_shape_gradients(scene);
    }
}

TEST(Gradient, Springs3D)
{
  GradientScene<3> scene(springs_on_the_bent_face<3>(3, 3), 0.05, "foundation.right", 0);
  check_derivatives(scene);
}

/// A heated foundation.
template <int dim>
void heat(TestScene<dim> &scene)
{
  scene.bodies[1].material.expansion = 1e-4;
  scene.bodies[1].temperature        = [](const auto &x) {
    return 20. + 30. * x[0] * x[0] - 40. * x[dim - 1];
  };
}

TEST(Gradient, Temperature2D)
{
  using Kind = mesh::Idealization::Kind;
  for (const auto kind : {Kind::plane_strain, Kind::plane_stress, Kind::axisymmetric})
    {
      auto given         = curved_scene<2>(5, 4, 0.04);
      given.idealization = {kind, kind == Kind::axisymmetric ? 1. : 0.3};
      if (kind != Kind::plane_stress)
        given.bodies[1].formulation = elasticity::Formulation::B_bar;
      heat(given);
      GradientScene<2> scene(given, 0.05);
      check_derivatives(scene);
      // These velocities would move the nodes on the axis off the axis.
      if (kind != Kind::axisymmetric)
        check_shape_gradients(scene);
    }
}

TEST(Gradient, Temperature3D)
{
  auto given = curved_scene<3>(3, 3, 0.04);
  heat(given);
  given.bodies[1].refined_below = 0.45;
  GradientScene<3> scene(given, 0.05);
  check_derivatives(scene);
}

TEST(Gradient, ForcesAtPointsAndAlongLines3D)
{
  auto  given                                     = curved_scene<3>(3, 3, 0.04);
  auto &foundation                                = given.bodies[1];
  foundation.loads[face_index(0, 1)].concentrated = {
    {dealii::Point<3>(-0.4, 0.1, 0.2), dealii::Point<3>(1., 0.2, 0.4), {}, {}, {"", "point"}},
    {dealii::Point<3>(0.3, 0.1, -0.6),
     dealii::Point<3>(1., 0.1, 0.2),
     dealii::Point<3>(1., 0.9, 0.7),
     {},
     {"", "line"}},
    {dealii::Point<3>(0.1, 0., -0.5), {}, {}, face_index(2, 1), {"", "edge"}}};
  foundation.refined_below = 0.45;
  GradientScene<3> scene(given, 0.05, "foundation.right", 0);
  check_derivatives(scene);
  check_shape_gradients(scene);
}
} // namespace
