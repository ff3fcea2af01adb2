#include <snug/accuracy/demand.h>
#include <snug/accuracy/targets.h>
#include <snug/accuracy/transfer.h>
#include <snug/accuracy/underresolved_contact.h>
#include <snug/mesh/refined_cells.h>
#include <snug/state/contact_patches.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

#include <numeric>

namespace snug::test {
namespace {
using accuracy::mark;

std::vector<unsigned int> numbers(const std::vector<bool> &flags)
{
  std::vector<unsigned int> result;
  for (unsigned int i = 0; i < flags.size(); ++i)
    if (flags[i])
      result.push_back(i);
  return result;
}
} // namespace

TEST(Marking, TakesTheFewestCellsThatReachTheAim)
{
  const std::vector<double> indicators = {1., 8., 2., 4., 1.};
  // 16 - 3/4 sum <= 0.8 allowed
  EXPECT_EQ(numbers(mark(indicators, 16., 12.5, {1, 0.9})), std::vector<unsigned int>({1}));
  EXPECT_EQ(numbers(mark(indicators, 16., 10., {1, 0.9})), std::vector<unsigned int>({1, 3}));
  // degree 2 takes away 15/16
  EXPECT_EQ(numbers(mark(indicators, 16., 10.625, {2, 0.9})), std::vector<unsigned int>({1}));
  // no more than the share of the error, here half of it
  EXPECT_EQ(numbers(mark(indicators, 16., 1., {1, 0.5})), std::vector<unsigned int>({1}));
  EXPECT_TRUE(numbers(mark(indicators, 16., 20., {1, 0.7})).empty());
  EXPECT_TRUE(numbers(mark({0., 0.}, 1., 0.1, {1, 0.7})).empty());
}

TEST(Marking, ScalesIndicatorsToTheError)
{
  EXPECT_EQ(mark({1., 3., 2., 6.}, 12., 6., {1, 0.7}),
            mark({10., 30., 20., 60.}, 12., 6., {1, 0.7}));
}

TEST(Marking, TakesEqualCellsTogether)
{
  EXPECT_EQ(numbers(mark({1., 5., 5. * (1. - 1e-4), 5., 1.}, 17., 14., {1, 0.7})),
            std::vector<unsigned int>({1, 2, 3}));
}

TEST(Target, ReadsPartsAndNumbers)
{
  EXPECT_DOUBLE_EQ(accuracy::read_target("1 %").allowed(-50.), 0.5);
  EXPECT_DOUBLE_EQ(accuracy::read_target("0.2%").allowed(50.), 0.1);
  EXPECT_DOUBLE_EQ(accuracy::read_target("0.02").allowed(50.), 0.02);
  EXPECT_DOUBLE_EQ(accuracy::read_target("1e-8 %").allowed(1.), 1e-10);
  EXPECT_DOUBLE_EQ(accuracy::read_target("1e-12").allowed(1e-6), 1e-12); // in units
  for (const char *wrong : {"", "%", "-1 %", "0", "1 N", "inf", "1e-300 %", "9e-9 %"})
    EXPECT_THROW(accuracy::read_target(wrong), std::exception) << wrong;
}

TEST(Demand, NamesATargetBelowTheRoundingOfItsResponse)
{
  const auto why = [](const std::string &target, const double value) {
    return accuracy::Demand{"tip", 0, 0, accuracy::read_target(target), false, false}.note({value,
                                                                                            1.},
                                                                                           false);
  };
  EXPECT_EQ(why("1e-8 %", -3.), "");
  EXPECT_EQ(why("1e-12", 1e-6), "");
  EXPECT_EQ(why("1e-12", 0.), "");
  EXPECT_EQ(why("1e-12", -2.), "the target 1e-12 of tip must be at least 2e-10, 1e-8 % of its "
                               "value -2");
}

TEST(StepTolerance, FollowsTheError)
{
  EXPECT_DOUBLE_EQ(accuracy::step_tolerance(0.5, false, 1e-6), 1e-2);
  EXPECT_DOUBLE_EQ(accuracy::step_tolerance(0.02, false, 1e-6), 2e-3);
  EXPECT_DOUBLE_EQ(accuracy::step_tolerance(1e-4, true, 1e-6), std::sqrt(1e-5));
  EXPECT_DOUBLE_EQ(accuracy::step_tolerance(1e-9, false, 1e-6), 1e-6);
  EXPECT_DOUBLE_EQ(accuracy::step_tolerance(1e-9, false, 0.05), 0.05);
}

TEST(Unbounded, IsWhatDoesNotFallByAThirdInThreeMeshes)
{
  EXPECT_FALSE(accuracy::is_unbounded({1., 0.9, 0.8}));
  EXPECT_TRUE(accuracy::is_unbounded({1., 0.9, 0.8, 0.7}));
  EXPECT_FALSE(accuracy::is_unbounded({9., 1., 0.9, 0.7, 0.4}));
  EXPECT_FALSE(accuracy::is_unbounded({0.03, 0.26, 0.21, 0.17})); // the first did not know
}

TEST(Unbounded, IsNotWhatGrowsLessThanItsResponse)
{
  const auto last = [](const std::vector<accuracy::Measured> &meshes) {
    accuracy::Demand demand{"tip", 0, 0, accuracy::read_target("1 %"), false, false};
    std::string      text;
    for (const auto &measured : meshes)
      text = demand.note(measured, false);
    return text;
  };
  // a plate that locks, and a stress at an edge
  EXPECT_EQ(last({{-0.6, 0.4}, {-1.2, 0.5}, {-1.5, 0.5}, {-1.8, 0.4}}), "");
  EXPECT_NE(last({{10., 4.}, {14., 5.6}, {20., 8.}, {28., 11.}}).find("unbounded"),
            std::string::npos);
}

TEST(Zero, ChangesItsSignWithTheMesh)
{
  EXPECT_FALSE(accuracy::changes_sign({}));
  EXPECT_FALSE(accuracy::changes_sign({-1., -2., -1.}));
  EXPECT_TRUE(accuracy::changes_sign({1., -1e-3, 1., 1.}));
  EXPECT_FALSE(accuracy::changes_sign({-1., 1., 2., 3., 4.}));
}

namespace {
/// A contact of some faces, to the tolerance between meshes.
template <int dim>
TestScene<dim> ball(unsigned int n)
{
  auto scene                      = two_blocks<dim>(n, n, 4.);
  scene.solver.relative_tolerance = accuracy::maximum_tolerance;
  return scene;
}

/// The finer one solved from nothing and from the coarser: both give the same.
template <int dim>
void expect_shorter(const TestScene<dim> &coarse, const TestScene<dim> &fine)
{
  Problem<dim> from(coarse), to(fine);
  const auto   state = from.solve();
  const auto  &x     = to.mesh.reference_positions();
  const auto   cold  = to.solver.solve(x, qp::WarmStart());
  const auto   warm  = to.solver.solve(x, accuracy::transferred(from.solver, state, to.solver, x));
  EXPECT_NEAR(warm.energy / cold.energy, 1., 1e-3);
  EXPECT_LE(warm.f_mults, cold.f_mults);
  EXPECT_LT(warm.dual.outer_iterations, cold.dual.outer_iterations);
}
} // namespace

TEST(Transfer, SavesStepsOfTheActiveSet)
{
  expect_shorter<2>(ball<2>(16), ball<2>(32));
  expect_shorter<3>(ball<3>(5), ball<3>(10));
}

TEST(Transfer, KeepsTheForce)
{
  Problem<2> from(ball<2>(16)), to(ball<2>(48));
  const auto state = from.solve();
  const auto start =
    accuracy::transferred(from.solver, state, to.solver, to.mesh.reference_positions());
  const auto forces = to.solver.gluing(0).contact_forces(start.lambda).front();
  double     sum    = 0.;
  for (const double force : forces)
    sum += force;
  // Linear between nodes: the same integral, but for the end of contact.
  EXPECT_NEAR(sum / state.contact_force.norm(), 1., 0.02);
}

TEST(Transfer, OfAnOpenContactIsAColdStart)
{
  Problem<2> from(ball<2>(8)), to(ball<2>(16));
  auto       state = from.solve();
  for (auto &point : state.contact)
    point.pressure = 0.;
  const auto start =
    accuracy::transferred(from.solver, state, to.solver, to.mesh.reference_positions());
  EXPECT_EQ(start.lambda.n_rows(), 0u);
}

TEST(Trust, AsksForFacesAcrossEachPatch)
{
  Problem<2> problem(ball<2>(32));
  const auto state   = problem.solve();
  const auto patches = state::contact_patches(problem.solver, state);
  ASSERT_EQ(patches.size(), 1u);
  const double width = patches[0].width;
  EXPECT_DOUBLE_EQ(width, state.validity.width);
  EXPECT_TRUE(accuracy::underresolved_contact(problem.solver, state, width).empty());
  const auto faces = accuracy::underresolved_contact(problem.solver, state, width + 1.);
  // Faces between the active nodes, those at both ends and one more beyond each of these.
  EXPECT_EQ(faces.size(), state.active_contacts + 3u);
  for (const unsigned int face : faces)
    EXPECT_EQ(problem.solver.surface().faces()[face].body,
              problem.solver.contact(0).pairs()[0].slave.body());
}

TEST(Trust, SeesTwoPatches)
{
  auto scene = ball<2>(32);
  // a foundation that is low in the middle, under a flat punch
  scene.bodies[0].radius                           = 0.;
  scene.control_points                             = {5, 1};
  scene.design                                     = {0., 0., -0.2, 0., 0.};
  scene.bodies[0].loads[face_index(1, 1)].pressure = 1.;
  Problem<2> problem(scene);
  const auto state   = problem.solve();
  const auto patches = state::contact_patches(problem.solver, state);
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_EQ(patches[0].rows.size(), patches[1].rows.size());
  EXPECT_NEAR(state.validity.width, std::min(patches[0].width, patches[1].width), 1e-12);
}
} // namespace snug::test
