#include <snug/base/errors.h>
#include <snug/sensitivity/gradient.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace
{
  using namespace snug;
  using namespace snug::test;

  /// Gradients of a small scene by response and method.
  class Methods : public ::testing::Test
  {
  protected:
    static TestScene<2>
    scene()
    {
      auto scene = two_blocks<2>(4, 4, 3.);
      set_design(scene, 3, 0.03);
      return scene;
    }

    Problem<2>                            problem{scene()};
    std::unique_ptr<shape::ShapeBasis<2>> basis  = make_basis();
    state::ContactState<2>                state  = problem.solve();
    std::vector<double>                   widths = {0.1, 0.1, 0.1};
    sensitivity::GradientParameters       parameters;

    std::unique_ptr<shape::ShapeBasis<2>>
    make_basis()
    {
      shape::ShapeParameters given;
      given.basis          = "Bezier patch";
      given.face           = "foundation.top";
      given.control_points = {3};
      given.direction      = {0., 1.};
      given.bounds         = {-0.05, 0.05};
      return choose(shape::shape_basis_table<2>(), given.basis)
        .make(problem.mesh, {problem.model.body_names}, given);
    }

    sensitivity::Gradient
    gradient(const std::string &response, const std::string &method)
    {
      const auto made = choose(response::response_table<2>(), response).make();
      return sensitivity::gradient<2>({problem.solver,
                                       *basis,
                                       *made,
                                       state,
                                       problem.scene.design,
                                       widths,
                                       parameters},
                                      method);
    }
  };

  TEST_F(Methods, AutoTakesTheCheapest)
  {
    EXPECT_EQ(gradient("potential energy", "auto").method, "energy");
    EXPECT_EQ(gradient("volume", "auto").method, "energy");
    EXPECT_EQ(gradient("compliance", "auto").method, "direct");
    EXPECT_EQ(gradient("strain energy", "auto").method, "direct");
  }

  TEST_F(Methods, EnergyIsForResponsesThatHaveIt)
  {
    EXPECT_THROW(gradient("compliance", "energy"), InputError);
    EXPECT_THROW(gradient("strain energy", "energy"), InputError);
    EXPECT_THROW(gradient("compliance", "adjoint's cousin"), InputError);
  }

  TEST_F(Methods, AgreeWithEachOther)
  {
    const auto energy = gradient("potential energy", "energy");
    const auto direct = gradient("potential energy", "direct");
    EXPECT_EQ(energy.f_mults, 0u);
    EXPECT_GT(direct.f_mults, 0u);
    ASSERT_EQ(energy.values.size(), 3u);
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(energy.values[i],
                  direct.values[i],
                  1e-8 * std::abs(energy.values[1]));
  }

  TEST_F(Methods, PositionsOfADesignAreReferencePlusBasis)
  {
    // the test's own Bernstein heights against the module's
    const auto x =
      sensitivity::positions(problem.mesh, *basis, problem.scene.design);
    const auto expected = problem.positions(problem.scene.design);
    for (unsigned int node = 0; node < x.size(); ++node)
      EXPECT_LT((x[node] - expected[node]).norm(), 1e-15);
  }
} // namespace
