#include <snug/base/errors.h>
#include <snug/sensitivity/gradient.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;
using sensitivity::Derivatives;
using sensitivity::Method;
using sensitivity::Solves;

/// Gradients of a small scene by response and method.
class Methods : public ::testing::Test
{
protected:
  static TestScene<2> scene()
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

  std::unique_ptr<shape::ShapeBasis<2>> make_basis()
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

  sensitivity::Gradients<2> gradients(const std::vector<std::string> &names,
                                      const std::optional<Method>     method)
  {
    std::vector<std::unique_ptr<response::Response<2>>> made;
    sensitivity::MeasuredResponses<2>                   responses;
    for (const auto &name : names)
      {
        response::ResponseParameters of_name;
        of_name.quantity = name;
        made.push_back(response::make_response<2>(of_name));
        responses.push_back({made.back().get(), 0});
      }
    parameters.method = method;
    return sensitivity::gradients<2>(
      {{problem.solver, *basis, state, problem.scene.design, widths, parameters}}, responses);
  }

  sensitivity::Gradient<2> gradient(const std::string &response, const std::optional<Method> method)
  {
    return gradients({response}, method).of_response.front();
  }
};

TEST_F(Methods, AutoTakesTheCheapest)
{
  EXPECT_EQ(gradient("potential energy", {}).method, Method::energy);
  EXPECT_EQ(gradient("volume", {}).method, Method::energy);
  EXPECT_EQ(gradient("compliance", {}).method, Method::adjoint);
  // 3 variables: two solves for two responses, or three for any number
  const auto two = gradients({"volume", "compliance", "strain energy"}, {});
  EXPECT_EQ(two.of_response[0].method, Method::energy);
  EXPECT_EQ(two.of_response[1].method, Method::adjoint);
  EXPECT_EQ(two.of_response[2].method, Method::adjoint);
  const auto three =
    gradients({"compliance", "strain energy", "potential energy", "compliance"}, {});
  EXPECT_EQ(three.of_response[0].method, Method::direct);
  EXPECT_EQ(three.of_response[2].method, Method::energy);
  for (const auto &gradient : three.of_response)
    EXPECT_FALSE(gradient.reason.empty());
  // the same response twice: kernels of BLAS may round the last columns of a block otherwise
  const auto &first = three.of_response[0].values, &last = three.of_response[3].values;
  for (unsigned int j = 0; j < 3; ++j)
    EXPECT_NEAR(first[j], last[j], 1e-13 * std::abs(first[j]));
}

TEST_F(Methods, CompanyDoesNotMatter)
{
  for (const auto method : {Method::adjoint, Method::direct})
    {
      const auto all = gradients({"compliance", "volume", "strain energy"}, method);
      EXPECT_EQ(all.of_response[0].method, method);
      EXPECT_EQ(all.of_response[1].method, Method::energy);
      const auto alone = gradient("strain energy", method).values;
      for (unsigned int i = 0; i < 3; ++i)
        EXPECT_NEAR(all.of_response[2].values[i], alone[i], 1e-8 * std::abs(alone[1]));
    }
  EXPECT_EQ(gradients({"volume"}, Method::direct).f_mults, 0u);
}

TEST_F(Methods, EnergyIsForResponsesThatHaveIt)
{
  EXPECT_THROW(gradient("compliance", Method::energy), InputError);
  EXPECT_THROW(gradient("strain energy", Method::energy), InputError);
}

TEST_F(Methods, AgreeWithEachOther)
{
  const auto energy = gradients({"potential energy"}, Method::energy);
  EXPECT_EQ(energy.f_mults, 0u);
  const auto expected = energy.of_response[0].values;
  ASSERT_EQ(expected.size(), 3u);
  for (const auto method : {Method::adjoint, Method::direct})
    for (const auto solves : {Solves::block, Solves::recycled})
      for (const auto derivatives : {Derivatives::exact, Derivatives::central})
        {
          parameters.solves      = solves;
          parameters.derivatives = derivatives;
          const auto other       = gradients({"potential energy"}, method);
          EXPECT_GT(other.f_mults, 0u);
          for (unsigned int i = 0; i < 3; ++i)
            EXPECT_NEAR(other.of_response[0].values[i], expected[i], 1e-8 * std::abs(expected[1]));
        }
}

TEST_F(Methods, ShapeGradientsHaveTheGradientAsProductsWithTheBasis)
{
  EXPECT_FALSE(gradient("compliance", Method::adjoint).shape);
  parameters.shape_gradient                            = true;
  const std::pair<const char *, Method> combinations[] = {{"potential energy", Method::energy},
                                                          {"volume", Method::direct},
                                                          {"compliance", Method::adjoint},
                                                          {"compliance", Method::direct},
                                                          {"strain energy",
                                                           Method::finite_differences}};
  for (const auto &[response, method] : combinations)
    {
      const auto found = gradient(response, method);
      ASSERT_TRUE(found.shape);
      const auto products = basis->transpose(*found.shape);
      for (unsigned int i = 0; i < 3; ++i)
        EXPECT_NEAR(products[i], found.values[i], 1e-12 * std::abs(found.values[1]))
          << response << " by " << to_text(method);
    }
}

TEST_F(Methods, PositionsOfADesignAreReferencePlusBasis)
{
  // the test's own Bernstein heights against the module's
  const auto x        = shape::positions(problem.mesh, *basis, problem.scene.design);
  const auto expected = problem.positions(problem.scene.design);
  for (unsigned int node = 0; node < x.size(); ++node)
    EXPECT_LT((x[node] - expected[node]).norm(), 1e-15);
}
} // namespace
