#include <snug/app/objective.h>
#include <snug/scene/read_scene.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>

using namespace snug;
using Design = std::vector<double>;

namespace {
/// A curved punch pressed down, straight and by a pressure that grows to the right; variables are
/// heights of the block below.
const std::string two_loads = R"(
set Task = optimize
set Dimension = 2
set Bodies = punch, block
set Load cases = straight, tilted
subsection Body punch
  set Box corner = 0, 1
  set Box size = 2, 1
  set Box cells = 12, 4
  set Curved faces = bottom: cylinder z 6
  set Young's modulus = 2000
  set Poisson's ratio = 0.3
  set Supports = left: normal
end
subsection Body block
  set Box size = 2, 1
  set Box cells = 12, 4
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
  set Supports = bottom: normal, left: x
end
subsection Load case straight
  set Pressure = punch.top: 30
end
subsection Load case tilted
  set Weight = 0.8
  set Pressure = punch.top: 25*(1+x/4)
end
subsection Contact
  set Pairs = punch.bottom: block.top
end
subsection Shape
  set Basis = Bezier patch
  set Face = block.top
  set Control points = 4
  set Direction = 0, 1
  set Bounds = -0.1, 0.1
end
subsection Optimization
  set Objective = peak pressure
  set Combine = worst
  set Constraints = volume: initial, straight.contact area: >= 0.5 initial
end
subsection Solver
  set Relative tolerance = 1e-10
end
)";

/// The design problem of a scene, as an optimizer sees it.
struct Told
{
  explicit Told(const std::vector<std::string> &sets)
    : scene(scene::read_scene({"scene.prm", two_loads, sets, "",
                               [](const std::string &file) { return scene::read_text(file); }}))
    , context(MPI_COMM_WORLD, log)
    , shape_problem(context,
                    scene,
                    std::make_unique<mesh::BodyMesh<2>>(MPI_COMM_WORLD,
                                                        app::mesh_parameters(scene),
                                                        scene.degree,
                                                        scene::idealization(scene),
                                                        scene.tearing))
    , analyses(shape_problem)
    , objective(shape_problem, analyses, shape_problem.shapes->start())
    , problem(objective.design_problem(shape_problem.shapes->start()))
  {}

  optimization::Evaluation at(const Design &x)
  {
    auto evaluation = problem.evaluate(x);
    problem.differentiate(x, evaluation);
    return evaluation;
  }

  std::ostringstream          log;
  const scene::Scene          scene;
  RunContext                  context;
  app::ShapeProblem<2>        shape_problem;
  app::Analyses<2>            analyses;
  app::Objective<2>           objective;
  optimization::DesignProblem problem;
};

const Design start = {0.01, -0.01, 0.005, -0.02}, direction = {0.7, -1., 0.4, 0.9};

Design along(const double h)
{
  Design result = start;
  for (unsigned int j = 0; j < result.size(); ++j)
    result[j] += h * direction[j];
  return result;
}

Design times(const double h, Design d)
{
  for (double &entry : d)
    entry *= h;
  return d;
}
} // namespace

// By the adjoint method, which knows nothing of a linearization.
TEST(Prediction, HasTheValuesAndGradientsOfItsDesign)
{
  Told       direct({}), adjoint({"Gradient/Method=adjoint"});
  const auto known = direct.at(start), other = adjoint.at(start);
  ASSERT_TRUE(direct.problem.predict);
  EXPECT_TRUE(direct.problem.predicts_objective);
  EXPECT_FALSE(adjoint.problem.predict);
  EXPECT_TRUE(other.linearization.empty());
  const auto expected = direct.problem.predict(known, Design(4, 0.));
  EXPECT_NEAR(expected.objective, known.objective, 1e-12 * known.objective);
  for (unsigned int i = 0; i < 4; ++i)
    {
      EXPECT_NEAR(expected.gradient[i], other.gradient[i], 1e-5 * std::abs(known.objective)) << i;
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_NEAR(expected.jacobian[k][i], other.jacobian[k][i], 1e-5) << k << i;
    }
}

// The pressures themselves bend little: the error falls by the square of the step.
TEST(Prediction, IsOfSecondOrderAndBetterThanTheGradient)
{
  Told                  told({});
  const auto            known = told.at(start);
  std::array<double, 2> error{}, of_linear{};
  for (const unsigned int half : {0, 1})
    {
      const double h        = half == 0 ? 4e-3 : 2e-3;
      const auto   actual   = told.problem.evaluate(along(h));
      const auto   expected = told.problem.predict(known, times(h, direction));
      error[half]           = std::abs(expected.objective - actual.objective);
      double linear         = known.objective;
      for (unsigned int i = 0; i < 4; ++i)
        linear += h * direction[i] * known.gradient[i];
      of_linear[half] = std::abs(linear - actual.objective);
      EXPECT_LT(error[half], of_linear[half] / 2.);
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_NEAR(expected.constraints[k], actual.constraints[k], 1e-3) << k;
    }
  EXPECT_LT(error[1], error[0] / 3.);
}

TEST(Prediction, GradientsAreThoseOfItsValues)
{
  Told         told({});
  const auto   known = told.at(start);
  const auto   there = told.problem.predict(known, times(2e-3, direction));
  const double h     = 1e-7;
  for (unsigned int i = 0; i < 4; ++i)
    {
      auto forward = times(2e-3, direction), back = forward;
      forward[i] += h;
      back[i] -= h;
      const auto a = told.problem.predict(known, forward), b = told.problem.predict(known, back);
      EXPECT_NEAR((a.objective - b.objective) / (2. * h), there.gradient[i],
                  1e-5 * std::abs(known.objective));
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_NEAR((a.constraints[k] - b.constraints[k]) / (2. * h), there.jacobian[k][i], 1e-5);
    }
}

TEST(Prediction, OfResponsesThatDependOnMoreIsLinear)
{
  Told       told({"Optimization/Objective=compliance"});
  const auto known = told.at(start);
  EXPECT_FALSE(told.problem.predicts_objective);
  ASSERT_TRUE(told.problem.predict); // of the contact area
  const auto expected = told.problem.predict(known, direction);
  double     linear   = known.objective;
  for (unsigned int i = 0; i < 4; ++i)
    linear += direction[i] * known.gradient[i];
  EXPECT_NEAR(expected.objective, linear, 1e-12 * std::abs(linear));
  EXPECT_EQ(expected.gradient, known.gradient);
  EXPECT_EQ(expected.jacobian[0], known.jacobian[0]);

  Told neither({"Optimization/Objective=compliance", "Optimization/Constraints=volume: initial"});
  EXPECT_FALSE(neither.problem.predict);
}
