#include <snug/base/errors.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

#include <algorithm>

namespace {
using namespace snug;
using namespace snug::test;

/// Pressures at x > 0 of blocks that are pressed together about x = 0, or of their halves.
std::vector<double>
pressures_of(contact::Method method, std::array<unsigned int, 2> cells, bool half)
{
  auto scene = two_blocks<2>(2, 2, 0.);
  scene.bodies[0].supports.clear();
  scene.bodies[0].loads.clear();
  supports::Support<2> down{0, face_index(1, 1), 1, {}, "down"};
  down.values                = {[](const auto &) { return -0.05; }};
  scene.bodies[0].prescribed = {down};
  scene.bodies[0].material   = {300., 0.1};
  for (unsigned int b = 0; b < 2; ++b)
    {
      auto &body     = scene.bodies[b];
      body.corner[0] = half ? 0. : -1.;
      body.size[0]   = half ? 1. : 2.;
      body.cells     = {(half ? 1 : 2) * cells[b], cells[b]};
      if (half)
        body.supports[face_index(0, 0)] = {0};
    }
  scene.pairs                     = {{{0, face_index(1, 0)}, {1, face_index(1, 1)}}};
  auto &parameters                = scene.pairs[0].parameters;
  parameters.slave                = contact::Slave::first;
  parameters.method               = method;
  parameters.gap                  = "x^2/20";
  parameters.friction             = contact::Friction::Coulomb;
  parameters.friction_coefficient = "0.15";
  scene.solver.relative_tolerance = 1e-11;
  Problem<2>               problem(scene);
  const auto               state = problem.solve();
  const auto               x = problem.solver.surface().gather(problem.mesh.reference_positions());
  std::map<double, double> sorted;
  for (unsigned int i = 0; i < state.contact.size(); ++i)
    sorted[x[problem.solver.contact(0).places()[i].slave][0]] = state.contact[i].pressure;
  EXPECT_GT(state.slipping_contacts, 0u);
  EXPECT_LT(state.slipping_contacts, state.active_contacts);
  std::vector<double> result;
  for (const auto &[place, pressure] : sorted)
    if (place > -1e-9)
      result.push_back(pressure);
  return result;
}

} // namespace

TEST(FrictionSupports, HalfTheModelIsTheWholeModel)
{
  using contact::Method;
  for (const auto method : {Method::nodal, Method::mortar})
    for (const std::array<unsigned int, 2> cells :
         {std::array<unsigned int, 2>{{10, 8}}, {{8, 10}}, {{10, 10}}})
      {
        const auto half  = pressures_of(method, cells, true),
                   whole = pressures_of(method, cells, false);
        ASSERT_EQ(half.size(), whole.size());
        const double largest = *std::max_element(half.begin(), half.end());
        for (unsigned int i = 0; i < half.size(); ++i)
          EXPECT_NEAR(half[i], whole[i], 1e-8 * largest) << i;
      }
}

/// A block in the edge of two obstacles: both hold the nodes on the edge, and the friction of both
/// adds up along it.
TEST(FrictionSupports, TwoObstaclesHoldANode)
{
  TestScene<3> scene;
  scene.bodies.resize(1);
  auto &block = scene.bodies[0];
  for (unsigned int d = 0; d < 3; ++d)
    block.size[d] = 1.;
  block.cells                            = {4, 4, 4};
  block.loads[face_index(2, 1)].pressure = 3.;
  block.loads[face_index(0, 1)].pressure = 2.;
  for (const unsigned int axis : {2u, 0u})
    {
      contact::Pair pair;
      pair.slave      = {0, face_index(axis, 0)};
      pair.slave_name = axis == 2 ? "block.bottom" : "block.left";
      pair.obstacle.emplace();
      pair.obstacle->name                  = axis == 2 ? "floor" : "wall";
      pair.obstacle->point                 = {0., 0., 0.};
      pair.obstacle->normal                = {axis == 0 ? 1. : 0., 0., axis == 2 ? 1. : 0.};
      pair.obstacle->displacement          = {0., 0., 0.};
      pair.parameters.friction             = contact::Friction::Coulomb;
      pair.parameters.friction_coefficient = axis == 2 ? "0.3" : "0.2";
      scene.pairs.push_back(pair);
    }
  const auto push = [&](const double part) {
    block.loads[face_index(2, 1)].traction[1] = part * 0.3 * 3.;
    block.loads[face_index(0, 1)].traction[1] = part * 0.2 * 2.;
    return Problem<3>(scene).solve();
  };
  for (const double part : {0.3, 0.9, 0.999})
    {
      const auto state = push(part);
      EXPECT_LE(state.certificate.worst(), 1e-10) << part;
      double along = 0.;
      for (const auto &point : state.contact)
        along += point.shear[1];
      EXPECT_NEAR(std::abs(along), part * 1.3, 1e-8);
    }
  EXPECT_THROW(push(1.001), SolveError);
}

/// The supports hold the nodes at the sides of the punch, and there are fewer nodes of the
/// foundation opposite to them.
TEST(FrictionSupports, SupportsHoldMoreSlavesThanMastersAreOpposite)
{
  for (const auto method : {contact::Method::nodal, contact::Method::mortar})
    {
      auto scene           = two_blocks<3>(6, 2, 0.);
      scene.method         = method;
      scene.friction       = contact::Friction::Coulomb;
      scene.friction_value = "0.3";
      const auto state     = Problem<3>(scene).solve();
      EXPECT_LE(state.certificate.worst(), 1e-10);
    }
}
