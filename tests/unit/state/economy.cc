#include "test_scene.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <iostream>

namespace snug
{
  namespace
  {
    /// The 3D Hertz problem of prm/ with H/h = 6, 16 subdomains, 3 x 3 heights.
    test::TestScene<3>
    hertz(const std::string &method)
    {
      auto scene = test::two_blocks<3>(12, 12, 4.);
      for (auto &body : scene.bodies)
        body.material = {210000., 0.3};
      scene.bodies[0].loads[test::face_index(2, 1)].pressure = 100.;
      scene.control_points                                   = {3, 3};
      scene.design                    = std::vector<double>(9, 0.);
      scene.subdomains                = 16;
      scene.solver.method             = method;
      scene.solver.relative_tolerance = 1e-6;
      return scene;
    }
  } // namespace

  // The contact must cost no more than 2.5 linear solves cold, and 1.3 from
  // the state of a design that differs by 1 % of the width of its bounds
  // (0.5). Where the ranks' shares of a body are ragged, as on three ranks,
  // so are subdomains, and both sides of the comparison take more.
  TEST(Economy, ContactCostsFewLinearSolves)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 2)
      GTEST_SKIP() << "the ranks cut the bodies into ragged shares";
    const auto          scene = hertz("active set");
    test::Problem<3>    problem(scene);
    const auto          state  = problem.solve();
    const unsigned long linear = problem.solver.linear_f_mults(state);
    auto                design = test::random_heights(9, 0.005);
    const auto          moved =
      problem.solver.solve(problem.positions(design),
                           {state.dual.lambda, state.dual.active});
    RecordProperty("linear", int(linear));
    RecordProperty("cold", int(state.f_mults));
    RecordProperty("warm", int(moved.f_mults));
    if (problem.context.rank() == 0)
      std::cout << "F-mults: linear " << linear << ", cold " << state.f_mults
                << ", warm " << moved.f_mults << std::endl;
    EXPECT_LE(linear, 25u);
    EXPECT_LE(state.f_mults, 2.5 * linear);
    EXPECT_LE(moved.f_mults, 1.3 * linear);
  }

  TEST(Economy, BothSolversFindTheSameState)
  {
    test::Problem<3> one(hertz("active set")), other(hertz("SMALSE-M"));
    const auto       a = one.solve(), b = other.solve();
    EXPECT_EQ(b.dual.method, "SMALSE-M");
    EXPECT_NEAR(a.energy, b.energy, 1e-9 * std::abs(a.energy));
    for (unsigned int i = 0; i < a.contact.size(); ++i)
      EXPECT_NEAR(a.contact[i].pressure,
                  b.contact[i].pressure,
                  1e-4 * a.max_pressure);
  }
} // namespace snug
