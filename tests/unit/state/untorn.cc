#include <gtest/gtest.h>
#include <unit/state/untorn_solver.h>

namespace
{
  using namespace snug;
  using namespace snug::test;

  /// States are solved to 1e-10; u follows the residual times the ratio of
  /// displacement to F_ii lambda, which is below 1e3 in these scenes.
  const double agreement = 1e-7;

  template <int dim>
  void
  expect_same_displacement(const Problem<dim>             &problem,
                           const state::ContactState<dim> &state,
                           const Untorn<dim>              &untorn)
  {
    double largest = 0., error = 0.;
    for (const auto &cell : problem.mesh.cells())
      for (const unsigned int node : cell.nodes)
        {
          const auto u = untorn.displacement(
            cell.body, problem.mesh.reference_positions()[node]);
          largest = std::max(largest, u.norm());
          error   = std::max(error, (u - state.displacement[node]).norm());
        }
    EXPECT_LT(error, agreement * largest);
    ::testing::Test::RecordProperty("displacement_error",
                                    std::to_string(error / largest));
    std::cout << "u " << error / largest << std::endl;
  }

  template <int dim>
  void
  expect_same_contact(const Problem<dim>             &problem,
                      const state::ContactState<dim> &state,
                      const Untorn<dim>              &untorn)
  {
    const auto &surface = problem.solver.surface();
    const auto  x = surface.gather(problem.mesh.reference_positions());
    ASSERT_EQ(state.contact.size(), untorn.contacts.size());
    double largest[2] = {0., 0.}, error[2] = {0., 0.};
    for (unsigned int i = 0; i < state.contact.size(); ++i)
      {
        const unsigned int slave =
          problem.solver.contact().projections()[i].slave;
        const auto &other =
          untorn.contacts.at(untorn.node_at[0].at(node_key<dim>(x[slave])));
        const double here[]  = {state.contact[i].force,
                                state.contact[i].pressure};
        const double there[] = {other.force, other.pressure};
        for (unsigned int k = 0; k < 2; ++k)
          {
            largest[k] = std::max(largest[k], std::abs(there[k]));
            error[k]   = std::max(error[k], std::abs(here[k] - there[k]));
          }
      }
    EXPECT_LT(error[0], agreement * largest[0]);
    EXPECT_LT(error[1], agreement * largest[1]);
    std::cout << "p " << error[1] / largest[1] << " n " << state.contact.size()
              << " active " << state.active_contacts << std::endl;
  }

  template <int dim>
  void
  expect_same(const TestScene<dim> &scene)
  {
    Untorn<dim> untorn(scene);
    untorn.solve();
    Problem<dim> problem(scene);
    const auto   state = problem.solve();
    expect_same_displacement(problem, state, untorn);
    expect_same_contact(problem, state, untorn);
    EXPECT_LT(relative_difference(state.energy, untorn.energy), agreement);
    EXPECT_LT(relative_difference(state.compliance, untorn.compliance),
              agreement);
    EXPECT_GT(state.active_contacts, 0u);
  }

  TEST(Untorn, MatchingMeshes2D)
  {
    auto scene = two_blocks<2>(6, 6, 3.);
    set_design(scene, 4, 0.03);
    expect_same(scene);
  }

  TEST(Untorn, OtherMeshes2D)
  {
    // hanging nodes inside both bodies, body force, side pressure
    auto scene = two_blocks<2>(5, 7, 2.);
    narrow_punch(scene);
    set_design(scene, 3, 0.03);
    for (auto &body : scene.bodies)
      body.refined_below = 0.45;
    scene.bodies[0].body_force[1]                = -3.;
    scene.bodies[1].body_force[0]                = 2.;
    scene.bodies[1].loads[face_index(0, 1)]      = {1.5, {}};
    scene.bodies[1].loads[face_index(0, 0)].traction[0] = 0.3;
    scene.bodies[1].material                     = {300., 0.2};
    expect_same(scene);
  }

  TEST(Untorn, Quadratic2D)
  {
    auto scene   = two_blocks<2>(3, 4, 2.);
    scene.degree = 2;
    set_design(scene, 4, 0.03);
    scene.bodies[1].refined_below = 0.45;
    scene.bodies[0].refined_below = 0.4;
    expect_same(scene);
  }

  TEST(Untorn, MatchingMeshes3D)
  {
    // hanging nodes on both contact faces, rollers at contact nodes of both
    auto scene = two_blocks<3>(4, 4, 3.);
    set_design(scene, 3, 0.02);
    for (auto &body : scene.bodies)
      body.refined_below = 0.45;
    scene.bodies[1].supports[face_index(0, 0)] = {0};
    expect_same(scene);
  }

  TEST(Untorn, OtherMeshes3D)
  {
    auto scene = two_blocks<3>(3, 4, 2.);
    narrow_punch(scene);
    set_design(scene, 3, 0.02);
    scene.bodies[1].refined_below               = 0.45;
    scene.bodies[1].loads[face_index(0, 1)]     = {1.5, {}};
    scene.bodies[0].body_force[2]               = -3.;
    scene.subdomains                            = 12;
    expect_same(scene);
  }
  TEST(Try, A)
  {
    auto scene = two_blocks<3>(2, 2, 0.);
    scene.bodies[0].refined_below = 0.45;
    expect_same(scene);
  }
  TEST(Try, B)
  {
    auto scene = two_blocks<3>(2, 2, 0.);
    scene.bodies[1].refined_below = 0.45;
    expect_same(scene);
  }
  TEST(Try, C)
  {
    auto scene = two_blocks<3>(2, 2, 0.);
    scene.bodies[0].refined_below = 0.45;
    scene.bodies[1].refined_below = 0.45;
    scene.subdomains=2;
    expect_same(scene);
  }
  TEST(Try, D)
  {
    auto scene = two_blocks<3>(2, 2, 3.);
    scene.bodies[0].refined_below = 0.45;
    scene.bodies[1].refined_below = 0.45;
    scene.subdomains=2;
    expect_same(scene);
  }
  TEST(Try, E)
  {
    auto scene = two_blocks<3>(2, 2, 0.);
    set_design(scene, 3, 0.02);
    scene.bodies[0].refined_below = 0.45;
    scene.bodies[1].refined_below = 0.45;
    scene.subdomains=2;
    expect_same(scene);
  }
} // namespace
