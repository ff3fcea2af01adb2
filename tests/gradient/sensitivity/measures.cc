#include <gradient/sensitivity/check_responses.h>

/// Responses of contact, mass and area where they do depend on the design: a
/// punch that is driven down presses as hard as the shape makes it.
namespace {
using namespace snug;
using namespace snug::test;

const std::set<std::string> of_contact = {"contact force", "force",         "contact area",
                                          "pressure norm", "peak pressure", "pressure variance"};

/// The top of the punch goes down by @p depths, one per load case, and a
/// little more at its right.
template <int dim>
TestScene<dim> driven(unsigned int n_cells, const std::vector<double> &depths)
{
  auto scene                      = two_blocks<dim>(n_cells, n_cells, 3.);
  scene.solver.relative_tolerance = 1e-12;
  set_design(scene, dim == 2 ? 4 : 3, 0.03);
  for (auto &body : scene.bodies)
    body.material.density = 0.7;
  scene.bodies[0].loads.clear();
  scene.bodies[1].loads[face_index(0, 1)].pressure = 0.5;
  supports::Support<dim> top{0, face_index(dim - 1, 1), dim - 1, {}, "punch"};
  for (const double depth : depths)
    top.values.push_back(
      [depth](const dealii::Point<dim> &x) { return -depth * (1. + 0.2 * x[0]); });
  scene.bodies[0].prescribed.push_back(top);
  if (depths.size() > 1)
    for (const double depth : depths)
      {
        scene.cases.emplace_back(2);
        scene.cases.back()[1][face_index(0, 1)].pressure = 50. * depth;
      }
  return scene;
}

TEST(Gradient, MeasuresWithHangingNodes)
{
  auto flat = driven<2>(6, {0.02});
  for (auto &body : flat.bodies)
    body.refined_below = 0.45;
  GradientScene<2> flat_scene(flat, 0.05);
  check_responses(flat_scene, of_contact);

  auto solid = driven<3>(3, {0.05});
  for (auto &body : solid.bodies)
    body.refined_below = 0.45;
  GradientScene<3> solid_scene(solid, 0.05);
  check_responses(solid_scene, of_contact);
}

/// Return a scene of degree 2, which represents the three quadratic heights exactly.
TestScene<2> driven_section(const mesh::Idealization &idealization)
{
  auto scene         = driven<2>(4, {0.03});
  scene.degree       = 2;
  scene.idealization = idealization;
  set_design(scene, 3, 0.03);
  return scene;
}

/// Gradients of volume and mass against @p slope of each height.
void check_integrals(GradientScene<2> &scene, const std::function<double(unsigned int j)> &slope)
{
  const auto                      state = scene.solve(scene.design);
  sensitivity::GradientParameters parameters;
  parameters.method = sensitivity::Method::adjoint;
  const auto found  = scene.gradients(state, {"volume of a body", "mass"}, parameters).of_response;
  for (unsigned int j = 0; j < 3; ++j)
    {
      EXPECT_NEAR(found[0].values[j], slope(j), 1e-12 * slope(2));
      EXPECT_NEAR(found[1].values[j], 0.7 * slope(j), 1e-12 * slope(2));
    }
}

TEST(Gradient, MeasuresOfBodiesOfRevolution)
{
  GradientScene<2> scene(driven_section({mesh::Idealization::Kind::axisymmetric}), 0.05);
  check_responses(scene, of_contact);
  // per full revolution: the integral of 2 pi x and a Bernstein function
  check_integrals(scene, [](unsigned int j) { return 2. * dealii::numbers::PI * (j + 1.) / 12.; });
}

TEST(Gradient, MeasuresOfAThinSheet)
{
  const double     thickness = 0.1;
  GradientScene<2> scene(driven_section({mesh::Idealization::Kind::plane_stress, thickness}), 0.05);
  check_responses(scene, of_contact);
  check_integrals(scene, [&](unsigned int) { return thickness / 3.; });
}

TEST(Gradient, MeasuresOfEachLoadCase)
{
  GradientScene<2> scene(driven<2>(6, {0.015, 0.04}), 0.05);
  for (const unsigned int load_case : {0, 1})
    {
      scene.load_case = load_case;
      check_responses(scene, of_contact);
    }
}
} // namespace
