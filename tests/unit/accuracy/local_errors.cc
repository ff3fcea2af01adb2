#include <snug/accuracy/local_errors.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace snug::test {
namespace {
/// sum of eta_K^2 over all ranks
template <int dim>
double square(Problem<dim> &problem, const state::ContactState<dim> &state)
{
  const accuracy::LocalErrors<dim>       errors(problem.solver, state);
  accuracy::LoadedDisplacement<dim>      u{state.displacement, {}};
  for (const auto &point : state.contact)
    u.pressures.push_back(point.pressure);
  double sum = 0.;
  for (const auto &of_cell : errors.products({u}))
    sum += of_cell[0];
  return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}

/// |u - u_h|^2 = 2 (J_h - J) for the energies of a mesh and of a much finer one.
template <int dim>
double effectivity(const TestScene<dim> &scene, unsigned int finer)
{
  Problem<dim> problem(scene);
  const auto   state = problem.solve();
  auto         fine  = scene;
  for (auto &body : fine.bodies)
    for (auto &n : body.cells)
      n *= finer;
  fine.degree = 2;
  Problem<dim> reference(fine);
  const double error = 2. * (state.energy - reference.solve().energy);
  return std::sqrt(square(problem, state) / error);
}
} // namespace

/// Both on rollers at their sides: contact closed all over, no corner, a smooth solution.
template <int dim>
TestScene<dim> guided_blocks(unsigned int n)
{
  auto scene = two_blocks<dim>(n, n, 0.);
  scene.bodies[0].loads[face_index(dim - 1, 1)].factor = [](const dealii::Point<dim> &x) {
    return 1. + 0.5 * std::cos(dealii::numbers::PI * x[0]);
  };
  scene.bodies[1].supports                           = scene.bodies[0].supports;
  scene.bodies[1].supports[face_index(dim - 1, 0)] = {dim - 1};
  return scene;
}

TEST(LocalErrors, PlaneContact)
{
  for (const unsigned int degree : {1, 2})
    for (const unsigned int n : {4, 8, 16})
      {
        auto scene   = guided_blocks<2>(n);
        scene.degree = degree;
        std::cerr << "degree " << degree << " cells " << n << " effectivity "
                  << effectivity(scene, 64 / n) << std::endl;
      }
}

TEST(LocalErrors, SolidContact)
{
  for (const unsigned int n : {2, 4})
    std::cerr << "solid, cells " << n << " effectivity "
              << effectivity(guided_blocks<3>(n), 8 / n) << std::endl;
}

/// A uniform state has no error.
TEST(LocalErrors, NoneOfUniformStates)
{
  const auto check = [](auto scene) {
    scene.bodies[1].supports[face_index(1, 0)] = {1};
    Problem problem(scene);
    const auto state = problem.solve();
    EXPECT_LT(square(problem, state), 1e-16 * state.strain_energy);
  };
  check(two_blocks<2>(4, 4, 0.));
}
} // namespace snug::test
