#include <gradient/sensitivity/curved_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

TEST(Gradient, Curved2D)
{
  GradientScene<2> scene(curved_scene<2>(8, 4, 0.04), 0.05);
  check_derivatives(scene);
}

TEST(Gradient, LoadsOnTheMovingBody2D)
{
  auto given = curved_scene<2>(6, 5, 0.04);
  narrow_punch(given);
  given.bodies[1].refined_below                       = 0.45;
  given.bodies[1].body_force[1]                       = -2.;
  given.bodies[1].loads[face_index(1, 1)].pressure    = 0.7;
  given.bodies[1].loads[face_index(0, 1)].pressure    = 1.5;
  given.bodies[1].loads[face_index(0, 0)].traction[1] = 0.5;
  GradientScene<2> scene(given, 0.05);
  check_derivatives(scene);
  check_shape_gradients(scene);
}

/// Two materials in both bodies, in one a nearly incompressible one; they
/// meet on the shaped face.
TEST(Gradient, TwoMaterialsInEachBody)
{
  auto given                    = curved_scene<2>(6, 4, 0.04);
  given.bodies[0].core_from     = 0.5;
  given.bodies[1].core_from     = 0.3;
  given.bodies[1].core          = {300., 0.48, 5.};
  given.bodies[1].formulation   = elasticity::Formulation::B_bar;
  given.bodies[1].refined_below = 0.45;
  GradientScene<2> scene(given, 0.05);
  check_derivatives(scene);
  check_shape_gradients(scene);
}

TEST(Gradient, Quadratic2D)
{
  auto given                    = curved_scene<2>(3, 4, 0.04);
  given.degree                  = 2;
  given.bodies[0].refined_below = 0.4;
  GradientScene<2> scene(given, 0.05);
  check_derivatives(scene);
}

/// Loads of all kinds, and two formulations, in a section.
TestScene<2> curved_section(const mesh::Idealization &idealization)
{
  auto scene          = curved_scene<2>(5, 4, 0.04);
  scene.idealization  = idealization;
  auto &foundation    = scene.bodies[1];
  foundation.material = {800., 0.45};
  if (idealization.kind != mesh::Idealization::Kind::plane_stress)
    foundation.formulation = elasticity::Formulation::B_bar;
  foundation.body_force[1]                       = -2.;
  foundation.loads[face_index(0, 1)].pressure    = 1.5;
  foundation.loads[face_index(0, 1)].traction[1] = 0.5;
  return scene;
}

TEST(Gradient, PlaneStressOfAThinSheet)
{
  GradientScene<2> scene(curved_section({mesh::Idealization::Kind::plane_stress, 0.1}), 0.05);
  check_derivatives(scene);
}

TEST(Gradient, BBarInPlaneStrain)
{
  GradientScene<2> scene(curved_section({mesh::Idealization::Kind::plane_strain, 3.}), 0.05);
  check_derivatives(scene);
}

TEST(Gradient, BodiesOfRevolution)
{
  for (const unsigned int degree : {1, 2})
    {
      auto given   = curved_section({mesh::Idealization::Kind::axisymmetric});
      given.degree = degree;
      if (degree == 2)
        for (auto &body : given.bodies)
          body.cells.assign(2, 3);
      GradientScene<2> scene(given, 0.05);
      check_derivatives(scene);
    }
}

TEST(Gradient, BBar3D)
{
  auto given = curved_scene<3>(3, 3, 0.04);
  for (auto &body : given.bodies)
    {
      body.formulation = elasticity::Formulation::B_bar;
      body.material    = {1000., 0.49};
    }
  GradientScene<3> scene(given, 0.05);
  check_derivatives(scene);
}

/// The punch in the middle, over a gap by formula; an obstacle comes down on
/// what is left of the shaped face.
template <int dim>
TestScene<dim> obstacle_scene(const std::string &shape)
{
  auto scene = curved_scene<dim>(dim == 2 ? 8 : 5, dim == 2 ? 4 : 3, 0.04);
  narrow_punch(scene);
  contact::Pair punch{{0, face_index(dim - 1, 0)}, {1, face_index(dim - 1, 1)}};
  punch.parameters.slave = contact::Slave::first;
  punch.parameters.gap   = "0.01 + 0.1 * x^2 * sin(y)";
  contact::Pair                pressed{{1, face_index(dim - 1, 1)}, {}};
  contact::ObstacleParameters &obstacle = pressed.obstacle.emplace();
  obstacle.shape                        = shape;
  obstacle.point.assign(dim, 0.95);
  obstacle.point[dim - 1] = 1.55;
  obstacle.normal.assign(dim, 1.);
  obstacle.axis.assign(dim, 0.05);
  obstacle.axis[1] = 1.;
  obstacle.displacement.assign(dim, 0.02);
  obstacle.displacement[dim - 1] = -0.1;
  obstacle.radius                = 0.5;
  obstacle.formula               = "x^2 + 2 * y^2 + 0.1 * sin(3 * x) - 0.5";
  scene.pairs                    = {punch, pressed};
  return scene;
}

TEST(Gradient, ObstaclesAndGapFormulas2D)
{
  for (const std::string shape : {"sphere", "formula"})
    {
      SCOPED_TRACE(shape);
      GradientScene<2> scene(obstacle_scene<2>(shape), 0.05);
      check_derivatives(scene);
    }
}

TEST(Gradient, ObstaclesAndGapFormulas3D)
{
  GradientScene<3> scene(obstacle_scene<3>("cylinder"), 0.05);
  check_derivatives(scene);
}

TEST(Gradient, NineHeights3D)
{
  GradientScene<3> scene(curved_scene<3>(4, 3, 0.04), 0.05);
  check_derivatives(scene);
}

TEST(Gradient, ClustersOfSubdomains3D)
{
  auto given         = curved_scene<3>(4, 4, 0.04);
  given.subdomains   = 16;
  given.cluster_edge = 2;
  GradientScene<3> scene(given, 0.05);
  check_derivatives(scene);
}

TEST(Gradient, SixteenHeightsAndLoads3D)
{
  auto given                                       = curved_scene<3>(3, 4, 0.04);
  given.bodies[1].refined_below                    = 0.45;
  given.bodies[1].loads[face_index(2, 1)].pressure = 0.7;
  given.bodies[1].body_force[2]                    = -2.;
  GradientScene<3> scene(given, 0.05);
  check_derivatives(scene);
  check_shape_gradients(scene);
}

/// The foundation on rollers below and at its right side, which the design
/// bends, and which is pushed in by a formula; the punch driven from above.
template <int dim>
TestScene<dim> bent_rollers(unsigned int n_cells, unsigned int n_heights)
{
  auto  scene      = curved_scene<dim>(n_cells, n_heights, 0.04);
  auto &punch      = scene.bodies[0];
  auto &foundation = scene.bodies[1];
  punch.loads.clear();
  foundation.body_force[dim - 1] = -2.;
  punch.prescribed.push_back({0,
                              face_index(dim - 1, 1),
                              dim - 1,
                              {[](const dealii::Point<dim> &x) { return -0.012 - 0.002 * x[0]; }},
                              "punch"});
  foundation.supports.clear();
  for (unsigned int d = 1; d < dim; ++d)
    foundation.supports[face_index(d, 0)] = {dim};
  foundation.prescribed.push_back(
    {1,
     face_index(0, 1),
     dim,
     {[](const dealii::Point<dim> &x) { return -0.003 * (1. + x[dim - 1]); }},
     "side"});
  return scene;
}

TEST(Gradient, RollersOnABentFace2D)
{
  for (const unsigned int degree : {1, 2})
    {
      auto given                    = bent_rollers<2>(degree == 1 ? 6 : 3, 4);
      given.degree                  = degree;
      given.bodies[1].refined_below = 0.45;
      GradientScene<2> scene(given, 0.05, "foundation.right", 0);
      check_derivatives(scene);
    }
}

TEST(Gradient, RollersOnABentFace3D)
{
  GradientScene<3> scene(bent_rollers<3>(3, 3), 0.05, "foundation.right", 0);
  check_derivatives(scene);
}

/// Meshes that do not match, hanging nodes on both sides.
template <int dim>
TestScene<dim> mortar_scene(unsigned int n_punch, unsigned int n_foundation)
{
  auto scene   = two_blocks<dim>(n_punch, n_foundation, 3.);
  scene.method = contact::Method::mortar;
  narrow_punch(scene);
  set_design(scene, dim == 2 ? 4 : 3, 0.04);
  scene.bodies[0].refined_below   = 0.4;
  scene.bodies[1].refined_below   = 0.45;
  scene.solver.relative_tolerance = 1e-12;
  return scene;
}

TEST(Gradient, Mortar2D)
{
  for (const unsigned int degree : {1, 2})
    {
      auto given   = mortar_scene<2>(6 / degree, 8 / degree - 1);
      given.degree = degree;
      GradientScene<2> scene(given, 0.05);
      check_derivatives(scene);
    }
}

TEST(Gradient, Mortar3D)
{
  GradientScene<3> scene(mortar_scene<3>(3, 4), 0.05);
  check_derivatives(scene);
}

/// Force, moment and varying tractions on the face that the design bends.
template <int dim>
TestScene<dim> resultants_on_the_bent_face(unsigned int n_cells, unsigned int n_heights)
{
  auto  scene                             = curved_scene<dim>(n_cells, n_heights, 0.04);
  auto &side                              = scene.bodies[1].loads[face_index(0, 1)];
  side.resultant.force[0]                 = -1.5;
  side.resultant.force[dim - 1]           = 0.5;
  side.resultant.moment[2]                = 0.4;
  side.resultant.moment[dim == 2 ? 2 : 1] = 0.3;
  side.pressure                           = 0.5;
  side.traction[dim - 1]                  = -0.4;
  side.factor = [](const dealii::Point<dim> &x) { return 1. + x[dim - 1]; };
  return scene;
}

TEST(Gradient, ResultantsOnABentFace2D)
{
  auto given                    = resultants_on_the_bent_face<2>(6, 4);
  given.bodies[1].refined_below = 0.45;
  GradientScene<2> scene(given, 0.05, "foundation.right", 0);
  check_derivatives(scene);
}

TEST(Gradient, ResultantsOnABentFace3D)
{
  GradientScene<3> scene(resultants_on_the_bent_face<3>(3, 3), 0.05, "foundation.right", 0);
  check_derivatives(scene);
}
} // namespace
