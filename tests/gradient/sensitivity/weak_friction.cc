#include <snug/sensitivity/data_derivatives.h>
#include <snug/sensitivity/one_sided.h>
#include <snug/sensitivity/tangent_system.h>
#include <snug/state/contact_results.h>

#include <gradient/sensitivity/check_derivatives.h>

#include <functional>

namespace {
using namespace snug;
using namespace snug::test;

/// A curved punch on a foundation with a shaped top, moved aside and down.
template <int dim>
TestScene<dim> moved_punch(const double aside, const double depth = 0.015)
{
  auto scene = two_blocks<dim>(dim == 2 ? 10 : 5, dim == 2 ? 10 : 5, 20.);
  set_design(scene, dim == 2 ? 4 : 2, 0.04);
  scene.bodies[0].supports.clear();
  scene.bodies[0].loads.clear();
  scene.bodies[0].material = {1000., 0.3, 0.};
  supports::Support<dim> down{0, face_index(dim - 1, 1), dim - 1, {}, "down"}, side = down,
                                                                               along = down;
  side.component                                                                     = 0;
  along.component                                                                    = 1;
  down.values  = {[depth](const auto &) { return -depth; }};
  side.values  = {[aside](const auto &) { return aside; }};
  along.values = {[aside](const auto &) { return 0.4 * aside; }};

  scene.bodies[0].prescribed = {down, side};
  if (dim == 3)
    scene.bodies[0].prescribed.push_back(along);
  scene.friction                  = contact::Friction::Coulomb;
  scene.friction_value            = "0.3";
  scene.solver.relative_tolerance = 1e-13;
  return scene;
}

/// Return 1 - |lambda_T| / b of the sticking contact that is next to slip.
template <int dim>
double margin(const double aside)
{
  double     least = 1.;
  const auto state = Problem<dim>(moved_punch<dim>(aside)).solve();
  for (const auto &point : state.contact)
    if (point.strong && point.friction == state::FrictionStatus::stick)
      least = std::min(least, 1. - point.shear.norm() / point.limit);
  return least;
}

/// Return a place near @p at where the @p margin vanishes, by secants through the place @p before,
/// farther from it, that end just before it.
double vanishing(const std::function<double(double)> &margin, double before, double at)
{
  double of_before = margin(before), least = margin(at);
  for (unsigned int i = 0; i < 8 && least > 1e-9; ++i)
    {
      const double next = at + 0.999 * least * (at - before) / (of_before - least);
      before            = at;
      of_before         = least;
      at                = next;
      least             = margin(at);
    }
  return at;
}

/// Return a motion aside, below @p aside, at which a sticking contact begins to slip: the motion
/// shrinks until a contact sticks that has slipped.
template <int dim>
double sliding_motion(double aside)
{
  double least = margin<dim>(aside);
  for (bool has_stuck = false; !has_stuck;)
    {
      const double next = 0.998 * aside, there = margin<dim>(next);
      has_stuck = there < 0.5 * least;
      aside     = next;
      least     = there;
    }
  return vanishing(margin<dim>, 0.9999 * aside, aside);
}

/// Return the least force of a closed contact over the largest one.
template <int dim>
double least_force(const double aside, const double depth)
{
  double     least = 1., largest = 0.;
  const auto state = Problem<dim>(moved_punch<dim>(aside, depth)).solve();
  for (const auto &point : state.contact)
    largest = std::max(largest, point.force);
  for (const auto &point : state.contact)
    if (point.force > 0.)
      least = std::min(least, point.force / largest);
  return least;
}

/// u'(a; b) of both signs of a direction b against one-sided differences of the second order.
template <int dim>
void expect_one_sided(const TestScene<dim> &given, const double t, const double tolerance)
{
  GradientScene<dim> scene(given, 0.05);
  const auto         state = scene.solve(scene.design);
  ASSERT_EQ(state.weak_contacts, 1u);
  EXPECT_LT(std::min(state.friction_distance, state.contact_change_margin), 1e-8);
  std::vector<std::vector<double>>      directions;
  std::vector<mesh::Field<dim>>         V;
  const sensitivity::GradientParameters parameters;
  for (const double sign : {1., -1.})
    for (auto direction : test_directions(scene.basis->n_variables()))
      {
        for (double &component : direction)
          component *= sign;
        directions.push_back(direction);
        V.push_back(scene.basis->apply(direction));
      }
  auto      &solver = scene.problem.solver;
  const auto data   = sensitivity::data_derivatives(solver, state, V, parameters);
  const auto sides  = sensitivity::directional_derivatives(solver, state, data);
  const auto at_sets =
    sensitivity::TangentSystem(solver.feti(state), sensitivity::strong_rows(solver, state),
                               solver.model().solver, sensitivity::Solves::block,
                               state.dual.directions)
      .solve(data);
  double worst = 0.;
  for (unsigned int j = 0; j < directions.size(); ++j)
    {
      const auto side  = state::nodal_values(solver, sides.primal, j),
                 fixed = state::nodal_values(solver, at_sets.primal, j);
      mesh::Field<dim> expected(state.displacement.size());
      const double     weight[] = {-1.5, 2., -0.5};
      for (unsigned int k = 0; k < 3; ++k)
        {
          auto design = scene.design;
          for (unsigned int i = 0; i < design.size(); ++i)
            design[i] += k * t * directions[j][i];
          const auto there = k == 0 ? state : scene.solve(design);
          for (unsigned int node = 0; node < expected.size(); ++node)
            expected[node] += weight[k] / t * there.displacement[node];
        }
      EXPECT_LT(field_error(scene.problem, side, expected), tolerance) << j;
      worst = std::max(worst, field_error(scene.problem, fixed, expected));
      solver.restore(state);
    }
  EXPECT_GT(worst, 100. * tolerance);
}

TEST(WeakFriction, BothSidesOfASlipThatBeginsInThePlane)
{
  expect_one_sided(moved_punch<2>(sliding_motion<2>(0.025)), 1e-5, 1e-5);
}

TEST(WeakFriction, BothSidesOfASlipThatBeginsInSpace)
{
  expect_one_sided(moved_punch<3>(sliding_motion<3>(0.014)), 1e-5, 1e-4);
}

TEST(WeakFriction, BothSidesOfAContactThatCloses)
{
  const double aside = 0.022;
  const auto   force = [&](const double depth) { return least_force<2>(aside, depth); };
  double       depth = 0.015;
  // The least force falls until its contact opens.
  while (force(0.99 * depth) < force(depth))
    depth *= 0.99;
  expect_one_sided(moved_punch<2>(aside, vanishing(force, 1.0001 * depth, depth)), 1e-5, 1e-5);
}
} // namespace
