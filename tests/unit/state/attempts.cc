#include "test_scene.h"

#include <snug/qp/active_set.h>
#include <snug/state/certificate.h>

#include <gtest/gtest.h>

namespace snug {
namespace {
/// Blocks that touch in the middle and gape widely beside it, hardly pressed.
test::TestScene<2> wide_gaps(const double pressure)
{
  auto scene                                             = test::two_blocks<2>(24, 24, 3.);
  scene.bodies[0].loads[test::face_index(1, 1)].pressure = pressure;
  scene.subdomains                                       = 12;
  return scene;
}

// Gaps of 0.04 far from a contact that is deformed by a millionth of that say nothing of it.
TEST(Attempts, WideGapsDoNotMakeALoadedContactUnloaded)
{
  for (const double pressure : {1e-4, 1e-2, 1.})
    {
      test::Problem<2> problem(wide_gaps(pressure));
      const auto       state = problem.solve();
      EXPECT_GT(state.active_contacts, 0u);
      EXPECT_FALSE(state::is_nearly_unloaded(problem.solver.feti(state), state.dual.lambda));
    }
}

// A punch whose top moves down, a hundredth above the foundation.
test::TestScene<2> lowered(const double motion)
{
  auto scene                = wide_gaps(0.);
  scene.bodies[0].corner[1] = 1.01;
  scene.bodies[0].prescribed.push_back({0,
                                        test::face_index(1, 1),
                                        1,
                                        {[=](const dealii::Point<2> &) { return -motion; }},
                                        "top",
                                        "punch.top"});
  return scene;
}

// It does not reach the foundation; the force there is what an iteration left.
TEST(Attempts, RemainsOfForcesCountAsUnloaded)
{
  test::Problem<2> problem(lowered(0.001));
  const auto       state = problem.solve();
  EXPECT_EQ(state.active_contacts, 0u);
  const auto     &feti   = problem.solver.feti(state);
  qp::MultiVector lambda = state.dual.lambda;
  for (unsigned int i = 0; i < lambda.n_rows(); ++i)
    if (feti.bounded()[i])
      lambda(i) = 1e-6 / feti.diagonal()[i];
  EXPECT_TRUE(state::is_nearly_unloaded(feti, lambda));
}

// Where the certificate is missed, the next attempt goes on with forces, contacts and directions:
// together they take hardly more than one solve to the last tolerance. Here residuals are measured
// by a motion, the certificate by deformations that are much smaller.
TEST(Attempts, ASecondOneTakesUpTheDirectionsOfTheFirst)
{
  auto scene                      = lowered(0.0102);
  scene.solver.relative_tolerance = 1e-4;
  test::Problem<2>     problem(scene);
  const auto           state      = problem.solve();
  qp::SolverParameters parameters = scene.solver;
  ASSERT_LT(state.solved_to, 0.2 * parameters.relative_tolerance) << "one attempt was enough";
  parameters.relative_tolerance = state.solved_to;
  const auto at_once = qp::ActiveSet(parameters).solve(problem.solver.feti(state), qp::WarmStart());
  // a start takes two: its residual and that of lambda_Im
  EXPECT_LE(state.f_mults, at_once.f_mults + 2);
}
} // namespace
} // namespace snug
