#include <gradient/sensitivity/differences.h>

namespace
{
  using namespace snug;
  using namespace snug::test;

  /// The 3D Hertz problem of prm/ with H/h = 6: small contact, as a state
  /// costs less where all of the face touches.
  TestScene<3>
  sixteen_heights(double tolerance)
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
    GradientScene<3> scene(sixteen_heights(1e-6), 0.05);
    const auto       state  = scene.solve(scene.problem.scene.design);
    const auto       before = scene.problem.context.total_work();
    sensitivity::GradientParameters parameters;
    parameters.method   = "direct";
    const auto gradient = scene.gradient(state, compliance, parameters);
    const auto after    = scene.problem.context.total_work();
    EXPECT_EQ(gradient.method, "direct");
    EXPECT_EQ(after.numeric_factorizations, before.numeric_factorizations);
    EXPECT_EQ(after.symbolic_factorizations, before.symbolic_factorizations);
    EXPECT_EQ(after.assembled_subdomains, before.assembled_subdomains);
    EXPECT_EQ(gradient.numeric_factorizations, 0u);
    EXPECT_EQ(gradient.f_mults, after.f_mults - before.f_mults);
    EXPECT_GE(gradient.f_mults, 16u);
    EXPECT_LE(gradient.f_mults, 8 * state.f_mults);
  }

  TEST(GradientCost, EnergyNeedsNoSolve)
  {
    GradientScene<3> scene(sixteen_heights(1e-6), 0.05);
    const auto       state  = scene.solve(scene.problem.scene.design);
    const auto       before = scene.problem.context.total_work();
    for (const auto response : {energy, volume})
      {
        const auto gradient = scene.gradient(state, response, {});
        const auto after    = scene.problem.context.total_work();
        EXPECT_EQ(gradient.method, "energy"); // what "auto" chooses
        EXPECT_EQ(gradient.f_mults, 0u);
        EXPECT_EQ(after.f_mults, before.f_mults);
        EXPECT_EQ(after.preconditioner_applications,
                  before.preconditioner_applications);
        EXPECT_EQ(after.numeric_factorizations, before.numeric_factorizations);
      }
  }

  TEST(GradientOptions, SemiAnalyticAgreesWithExact)
  {
    auto given = two_blocks<3>(4, 4, 3.);
    set_design(given, 3, 0.04);
    given.bodies[1].loads[face_index(2, 1)].pressure = 0.7;
    given.bodies[1].body_force[2]                    = -2.;
    GradientScene<3> scene(given, 0.05);
    const auto       state = scene.solve(scene.problem.scene.design);
    sensitivity::GradientParameters exact, differences;
    exact.method = differences.method = "direct";
    differences.derivatives           = "finite differences";
    for (const auto response : {compliance, strain_energy})
      {
        const auto a = scene.gradient(state, response, exact).values;
        const auto b = scene.gradient(state, response, differences).values;
        for (unsigned int i = 0; i < a.size(); ++i)
          EXPECT_NEAR(a[i], b[i], 1e-6 * norm(a));
      }
  }

  TEST(GradientOptions, OverallDifferencesAgreeWithDirect)
  {
    auto given = two_blocks<2>(8, 8, 3.);
    set_design(given, 4, 0.04);
    GradientScene<2> scene(given, 0.05);
    const auto       state = scene.solve(scene.problem.scene.design);
    sensitivity::GradientParameters direct, differences;
    direct.method      = "direct";
    differences.method = "finite differences";
    differences.step   = 1e-3; // of the bounds' width, 0.1
    const auto a       = scene.gradient(state, compliance, direct);
    const auto b       = scene.gradient(state, compliance, differences);
    for (unsigned int i = 0; i < a.values.size(); ++i)
      EXPECT_NEAR(a.values[i], b.values[i], 1e-5 * norm(a.values));
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
    const auto       state    = scene.solve(scene.problem.scene.design);
    const auto       gradient = scene.gradient(state, volume, {});
    const double     here =
      scene.responses[volume]->value(scene.problem.solver, state);
    for (unsigned int i = 0; i < gradient.values.size(); ++i)
      {
        auto moved = scene.problem.scene.design;
        moved[i] += 0.5;
        auto there      = state;
        there.positions = scene.problem.positions(moved);
        EXPECT_NEAR(scene.responses[volume]->value(scene.problem.solver,
                                                   there) -
                      here,
                    0.5 * gradient.values[i],
                    1e-13);
      }
  }
} // namespace
