#include "test_scene.h"

#include <gtest/gtest.h>

#include <iostream>

namespace snug {
namespace {
/// The 3D Hertz problem of prm/ with H/h = 6, 16 subdomains, 3 x 3 heights.
test::TestScene<3> hertz(const std::string &method)
{
  auto scene = test::two_blocks<3>(12, 12, 4.);
  for (auto &body : scene.bodies)
    body.material = {210000., 0.3};
  scene.bodies[0].loads[test::face_index(2, 1)].pressure = 100.;
  scene.control_points                                   = {3, 3};
  scene.design                                           = std::vector<double>(9, 0.);
  scene.subdomains                                       = 16;
  scene.solver.method                                    = method;
  scene.solver.relative_tolerance                        = 1e-6;
  return scene;
}
} // namespace

// The contact must cost no more than 2.5 linear solves cold, and 1.3 from
// the state of a design that differs by 1 % of the width of its bounds
// (0.5).
TEST(Economy, ContactCostsFewLinearSolves)
{
  const auto          scene = hertz("active set");
  test::Problem<3>    problem(scene);
  const auto          state  = problem.solve();
  const unsigned long linear = problem.solver.linear_f_mults(state);
  auto                design = test::random_heights(9, 0.005);
  const auto          moved =
    problem.solver.solve(problem.positions(design), {state.dual.lambda, state.dual.active});
  RecordProperty("linear", int(linear));
  RecordProperty("cold", int(state.f_mults));
  RecordProperty("warm", int(moved.f_mults));
  if (problem.context.rank() == 0)
    std::cout << "F-mults: linear " << linear << ", cold " << state.f_mults << ", warm "
              << moved.f_mults << std::endl;
  EXPECT_LE(linear, 25u);
  EXPECT_LE(state.f_mults, 2.5 * linear);
  EXPECT_LE(moved.f_mults, 1.3 * linear);
}

// Subdomains are the same; ranks differ in the order of their sums.
TEST(Economy, RanksDoNotMultiplyFMults)
{
  const auto       scene = hertz("active set");
  test::Problem<3> ranks(scene), one(scene, MPI_COMM_SELF);
  const auto       state = ranks.solve(), alone = one.solve();
  EXPECT_EQ(ranks.tearing.n_global, one.tearing.n_global);
  EXPECT_NEAR(state.f_mults, alone.f_mults, 0.1 * alone.f_mults);
  EXPECT_NEAR(state.energy, alone.energy, 1e-9 * std::abs(alone.energy));
}

// One cell each: on two or three ranks some have no cells of a body.
TEST(Economy, MoreRanksThanCells)
{
  auto scene   = test::two_blocks<2>(1, 1, 0.);
  scene.degree = 2;
  test::Problem<2> ranks(scene), one(scene, MPI_COMM_SELF);
  EXPECT_NEAR(ranks.solve().energy, one.solve().energy, 1e-10);
}

TEST(Economy, BothSolversFindTheSameState)
{
  test::Problem<3> one(hertz("active set")), other(hertz("SMALSE-M"));
  const auto       a = one.solve(), b = other.solve();
  EXPECT_EQ(b.dual.method, "SMALSE-M");
  EXPECT_NEAR(a.energy, b.energy, 1e-9 * std::abs(a.energy));
  for (unsigned int i = 0; i < a.contact.size(); ++i)
    EXPECT_NEAR(a.contact[i].pressure, b.contact[i].pressure, 1e-4 * a.max_pressure);
}
} // namespace snug
