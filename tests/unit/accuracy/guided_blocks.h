#ifndef snug_tests_unit_accuracy_guided_blocks_h
#define snug_tests_unit_accuracy_guided_blocks_h

#include <deal.II/base/mpi.h>

#include <unit/state/test_scene.h>

namespace snug::test {
/// Estimates on several ranks are those of one (IsThatOfOneRank); the truth, which takes finer
/// meshes, is asked of one rank.
inline bool is_alone()
{
  return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
}

/// Both on rollers at their sides: contact closed all over, no corner, a smooth solution.
template <int dim>
TestScene<dim> guided_blocks(unsigned int n, unsigned int m)
{
  auto scene                                           = two_blocks<dim>(n, m, 0.);
  scene.bodies[0].loads[face_index(dim - 1, 1)].factor = [](const dealii::Point<dim> &x) {
    return 1. + 0.5 * std::cos(dealii::numbers::PI * x[0]);
  };
  scene.bodies[1].supports                         = scene.bodies[0].supports;
  scene.bodies[1].supports[face_index(dim - 1, 0)] = {dim - 1};
  return scene;
}

/// Return blocks of mixed elements, each torn into several subdomains.
template <int dim>
TestScene<dim> nearly_incompressible(const unsigned int n,
                                     const double       nu,
                                     const unsigned int degree,
                                     const double       tolerance)
{
  auto scene = guided_blocks<dim>(n, n);
  for (auto &body : scene.bodies)
    {
      body.material    = {1000., nu};
      body.formulation = elasticity::Formulation::B_bar;
    }
  scene.degree                    = degree;
  scene.solver.relative_tolerance = tolerance;
  return scene;
}
} // namespace snug::test

#endif
