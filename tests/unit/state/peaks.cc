#include <snug/state/peaks.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

/// A bar of length 2 along x, on rollers at x = 0 and at the sides y = 0 and z = 0.
template <int dim>
TestScene<dim> bar(unsigned int degree)
{
  TestScene<dim> scene;
  scene.degree = degree;
  scene.bodies.resize(1);
  auto &body = scene.bodies[0];
  for (unsigned int d = 0; d < dim; ++d)
    {
      body.size[d]                    = d == 0 ? 2. : 1.;
      body.supports[face_index(d, 0)] = {d};
    }
  body.cells.assign(dim, 2);
  body.cells[0] = 4;
  if (dim == 2)
    scene.idealization.kind = mesh::Idealization::Kind::plane_stress;
  return scene;
}

template <int dim>
void expect_force_over_area(unsigned int degree)
{
  auto scene                                          = bar<dim>(degree);
  scene.bodies[0].loads[face_index(0, 1)].traction[0] = 7.;
  Problem<dim> problem(scene);
  const auto   state = problem.solve();
  ASSERT_EQ(state.stress_peaks.size(), 1u);
  EXPECT_NEAR(state.stress_peak().von_mises, 7., 1e-8); // solved to 1e-10
  EXPECT_EQ(state.stress_peak().body, "punch");
  // u = x sigma/E, and -nu sigma/E across
  EXPECT_NEAR(state.displacement_peak.position[0], 2., 1e-12);
  EXPECT_NEAR(state.displacement_peak.size, 7. / 1000. * std::sqrt(4. + (dim - 1) * 0.3 * 0.3),
              1e-10);
}

TEST(StressPeaks, ABarHasForceOverArea)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_force_over_area<2>(degree);
      expect_force_over_area<3>(degree);
    }
}

TEST(StressPeaks, AHangingBarIsStressedMostAtItsHighestGaussPoints)
{
  // sigma = b (L - x), which cells of degree 2 contain
  auto scene                              = bar<3>(2);
  scene.bodies[0].body_force[0]           = 5.;
  scene.bodies[0].material.poissons_ratio = 0.;
  Problem<3>   problem(scene);
  const auto   peak  = problem.solve().stress_peak();
  const double first = 0.5 * (1. - std::sqrt(0.6)) * 0.5; // in cells of 0.5
  EXPECT_NEAR(peak.von_mises, 5. * (2. - first), 1e-7);
  // Of the points across the bar, all equally stressed, it is the same one on any number of ranks.
  EXPECT_LT((peak.place - dealii::Tensor<1, 3>({first, first, first})).norm(), 1e-12);
}

TEST(StressPeaks, ABarYieldsWhereItsForceExceedsTheLimit)
{
  // sigma = b (L - x) = 5 (2 - x) exceeds 5 in half of the volume of 2.
  auto scene                              = bar<3>(2);
  scene.bodies[0].body_force[0]           = 5.;
  scene.bodies[0].material.poissons_ratio = 0.;
  scene.bodies[0].material.yield_stress   = 5.;
  Problem<3> problem(scene);
  const auto peak = problem.solve().stress_peak();
  EXPECT_NEAR(peak.yield.utilization, peak.von_mises / 5., 1e-12);
  EXPECT_NEAR(peak.yield.volume, 1., 1e-12);
  EXPECT_TRUE(std::isnan(peak.yield.depth)); // no contact
  EXPECT_EQ(peak.yield.pressure_over_shear, 0.);
}

TEST(StressPeaks, DoNotDependOnRanksAndUnits)
{
  // A symmetric punch has its peak twice.
  auto scene = two_blocks<2>(6, 5, 3.);
  for (auto &body : scene.bodies)
    body.material.yield_stress = 10.;
  auto other = scene;
  for (auto &body : other.bodies)
    {
      body.material.youngs_modulus *= 1e6;
      body.material.yield_stress *= 1e6;
    }
  other.bodies[0].loads[face_index(1, 1)].pressure *= 1e6;
  Problem<2> problem(scene), alone(scene, MPI_COMM_SELF), scaled(other);
  const auto state = problem.solve(), of_one = alone.solve(), of_units = scaled.solve();
  for (unsigned int body = 0; body < 2; ++body)
    {
      const auto &peak = state.stress_peaks[body];
      EXPECT_EQ(peak.body, problem.model.body_names[body]);
      EXPECT_GT(peak.von_mises, 10.);
      EXPECT_LT(relative_difference(of_one.stress_peaks[body].von_mises, peak.von_mises), 1e-7);
      EXPECT_LT((of_one.stress_peaks[body].place - peak.place).norm(), 1e-12);
      EXPECT_LT(relative_difference(of_units.stress_peaks[body].von_mises, 1e6 * peak.von_mises),
                1e-7);
      EXPECT_LT((of_units.stress_peaks[body].place - peak.place).norm(), 1e-12);
      EXPECT_GT(peak.yield.volume, 0.);
      for (const auto *other_yield :
           {&of_one.stress_peaks[body].yield, &of_units.stress_peaks[body].yield})
        {
          EXPECT_LT(relative_difference(other_yield->utilization, peak.yield.utilization), 1e-7);
          EXPECT_LT(relative_difference(other_yield->volume, peak.yield.volume), 1e-12);
          EXPECT_NEAR(other_yield->depth, peak.yield.depth, 1e-12);
          EXPECT_LT(relative_difference(other_yield->pressure_over_shear,
                                        peak.yield.pressure_over_shear),
                    1e-7);
        }
    }
  EXPECT_LT((of_one.displacement_peak.displacement - state.displacement_peak.displacement).norm(),
            1e-7 * state.displacement_peak.size);
}

TEST(DisplacementPeak, IsAtTheFirstOfEqualNodesOnAllRanks)
{
  const unsigned int     rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  state::ContactState<2> state;
  state.positions.resize(2);
  state.displacement.resize(2);
  for (unsigned int node = 0; node < 2; ++node)
    {
      state.positions[node][0]    = rank + 10. * node;
      state.displacement[node][1] = 1. + 1e-9 * (rank + node); // errors of a solver
    }
  const auto peak = state::displacement_peak(state, MPI_COMM_WORLD);
  EXPECT_EQ(peak.position[0], 0.);
  EXPECT_NEAR(peak.size, 1., 1e-7);
  EXPECT_EQ(peak.extent, 9. + dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
}
} // namespace
