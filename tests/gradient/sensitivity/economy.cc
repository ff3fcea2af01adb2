#include <gradient/sensitivity/differences.h>

namespace {
using namespace snug;
using namespace snug::test;

/// The 3D Hertz problem of prm/ with H/h = 6: small contact, as a state
/// costs less where all of the face touches.
TestScene<3> sixteen_heights(double tolerance)
{
  auto scene = two_blocks<3>(12, 12, 4.);
  set_design(scene, 4, 0.005);
  for (auto &body : scene.bodies)
    body.material = {210000., 0.3};
  scene.bodies[0].loads[face_index(2, 1)].pressure = 100.;
  scene.subdomains                                 = 16;
  scene.solver.relative_tolerance                  = tolerance;
  return scene;
}

TEST(GradientCost, DirectSharesFactorizationsAndMults)
{
  GradientScene<3>                scene(sixteen_heights(1e-6), 0.05);
  const auto                      state  = scene.solve(scene.design);
  const auto                      before = scene.problem.context.total_work();
  sensitivity::GradientParameters parameters;
  parameters.method   = sensitivity::Method::direct;
  const auto gradient = scene.gradients(state, {"compliance"}, parameters);
  const auto after    = scene.problem.context.total_work();
  EXPECT_EQ(gradient.of_response[0].method, sensitivity::Method::direct);
  EXPECT_EQ(after.numeric_factorizations, before.numeric_factorizations);
  EXPECT_EQ(after.symbolic_factorizations, before.symbolic_factorizations);
  EXPECT_EQ(after.assembled_subdomains, before.assembled_subdomains);
  EXPECT_EQ(gradient.numeric_factorizations, 0u);
  EXPECT_EQ(gradient.f_mults, after.f_mults - before.f_mults);
  EXPECT_GE(gradient.f_mults, 16u);
  EXPECT_LE(gradient.f_mults, 10 * scene.problem.solver.linear_f_mults(state));
}

TEST(GradientCost, AdjointIsOneSolvePerResponse)
{
  GradientScene<3>                scene(sixteen_heights(1e-6), 0.05);
  const auto                      state  = scene.solve(scene.design);
  const auto                      before = scene.problem.context.total_work();
  sensitivity::GradientParameters parameters;
  parameters.method   = sensitivity::Method::adjoint;
  const auto gradient = scene.gradients(state, {"compliance"}, parameters);
  const auto after    = scene.problem.context.total_work();
  EXPECT_EQ(after.numeric_factorizations, before.numeric_factorizations);
  EXPECT_EQ(after.assembled_subdomains, before.assembled_subdomains);
  EXPECT_GE(gradient.f_mults, 1u);
  EXPECT_LE(gradient.f_mults, scene.problem.solver.linear_f_mults(state));
}

TEST(GradientCost, EnergyNeedsNoSolve)
{
  GradientScene<3> scene(sixteen_heights(1e-6), 0.05);
  const auto       state  = scene.solve(scene.design);
  const auto       before = scene.problem.context.total_work();
  for (const std::string response : {"potential energy", "volume"})
    {
      const auto gradient = scene.gradients(state, {response}, {});
      const auto after    = scene.problem.context.total_work();
      EXPECT_EQ(gradient.of_response[0].method,
                sensitivity::Method::energy); // what "auto" chooses
      EXPECT_EQ(gradient.f_mults, 0u);
      EXPECT_EQ(after.f_mults, before.f_mults);
      EXPECT_EQ(after.preconditioner_applications, before.preconditioner_applications);
      EXPECT_EQ(after.numeric_factorizations, before.numeric_factorizations);
    }
}

TEST(GradientOptions, SemiAnalyticAgreesWithExact)
{
  auto given = two_blocks<3>(4, 4, 3.);
  set_design(given, 3, 0.04);
  given.bodies[1].loads[face_index(2, 1)].pressure = 0.7;
  given.bodies[1].body_force[2]                    = -2.;
  GradientScene<3>                scene(given, 0.05);
  const auto                      state = scene.solve(scene.design);
  sensitivity::GradientParameters exact, differences;
  exact.method = differences.method = sensitivity::Method::direct;
  differences.derivatives           = sensitivity::Derivatives::central;
  const std::vector<std::string> responses{"compliance", "probe"};
  const auto                     a = scene.gradients(state, responses, exact);
  const auto                     b = scene.gradients(state, responses, differences);
  for (unsigned int i = 0; i < responses.size(); ++i)
    EXPECT_LT(relative_error(b.of_response[i].values, a.of_response[i].values), 1e-6);
}

TEST(GradientOptions, OverallDifferencesAgreeWithDirect)
{
  auto given = two_blocks<2>(8, 8, 3.);
  set_design(given, 4, 0.04);
  GradientScene<2>                scene(given, 0.05);
  const auto                      state = scene.solve(scene.design);
  sensitivity::GradientParameters direct, differences;
  direct.method      = sensitivity::Method::direct;
  differences.method = sensitivity::Method::finite_differences;
  differences.step   = 1e-3; // of the bounds' width, 0.1
  const auto a       = scene.gradients(state, {"compliance"}, direct);
  const auto b       = scene.gradients(state, {"compliance"}, differences);
  EXPECT_LT(relative_error(b.of_response[0].values, a.of_response[0].values), 1e-5);
  EXPECT_GT(b.numeric_factorizations, 0u);
  EXPECT_GT(b.f_mults, a.f_mults);
}

TEST(GradientOptions, VolumeGradientIsExact)
{
  // the volume is linear in the heights: no step is too large
  auto given = two_blocks<3>(3, 3, 3.);
  set_design(given, 3, 0.04);
  given.bodies[1].refined_below = 0.45;
  GradientScene<3> scene(given, 0.05);
  const auto       state    = scene.solve(scene.design);
  const auto       gradient = scene.gradients(state, {"volume"}, {}).of_response[0].values;
  const auto      &volume   = *scene.responses["volume"];
  const double     here     = volume.value(scene.problem.solver, state);
  for (unsigned int i = 0; i < gradient.size(); ++i)
    {
      auto moved = scene.design;
      moved[i] += 0.5;
      auto there      = state;
      there.positions = scene.problem.positions(moved);
      EXPECT_NEAR(volume.value(scene.problem.solver, there) - here, 0.5 * gradient[i], 1e-13);
    }
}
} // namespace
