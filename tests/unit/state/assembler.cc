#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

#include <deal.II/base/mpi.h>

namespace {
using namespace snug;
using namespace snug::test;

/// Bent bodies with hanging nodes, random heights, all loads.
template <int dim>
TestScene<dim> loaded_scene(unsigned int degree)
{
  auto scene = two_blocks<dim>(3, 4, 3.);
  set_design(scene, 3, 0.03);
  scene.degree     = degree;
  scene.subdomains = 10;
  for (auto &body : scene.bodies)
    {
      body.refined_below                             = 0.45;
      body.body_force[0]                             = 0.7;
      body.loads[face_index(0, 1)].pressure          = 1.5;
      body.loads[face_index(0, 1)].traction[dim - 1] = -0.4;
    }
  return scene;
}

template <int dim>
void check_rigid_modes(unsigned int degree)
{
  Problem<dim> problem(loaded_scene<dim>(degree));
  const auto   state = problem.solve();
  for (const auto &system : problem.solver.feti(state).linearization().subdomains())
    {
      const unsigned int n_modes = dim == 2 ? 3 : 6;
      ASSERT_EQ(system.R.n_columns(), n_modes);
      qp::MultiVector KR(system.n_dofs(), n_modes);
      system.K.multiply_add(1., system.R, KR);
      const auto RR = qp::inner_products(system.R, system.R, MPI_COMM_SELF);
      for (unsigned int j = 0; j < n_modes; ++j)
        {
          // stiffness entries are about 1e3
          for (unsigned int i = 0; i < system.n_dofs(); ++i)
            ASSERT_NEAR(KR(i, j), 0., 1e-10);
          for (unsigned int i = 0; i < n_modes; ++i)
            EXPECT_NEAR(RR(i, j), double(i == j), 1e-13);
        }
      for (unsigned int i = 0; i < system.n_dofs(); ++i)
        for (PetscInt p = system.K.row_start()[i]; p < system.K.row_start()[i + 1]; ++p)
          EXPECT_NEAR(system.K.values[p],
                      system.K.values[system.K.position(system.K.columns()[p], i)], 1e-10);
    }
}

TEST(Assembler, KernelIsTheRigidModes)
{
  check_rigid_modes<2>(1);
  check_rigid_modes<2>(2);
  check_rigid_modes<3>(1);
}

/// R Z of neighbouring subdomains is one motion of the body: B of it
/// vanishes on all gluing rows (not on supports).
TEST(Assembler, BodyModesAreContinuous)
{
  Problem<3>          problem(loaded_scene<3>(1));
  const auto         &feti = problem.solver.feti(problem.solve());
  feti::PrimalVectors motion(6);
  for (const auto &system : feti.linearization().subdomains())
    {
      motion.emplace_back(system.n_dofs());
      motion.back().add_product(1., system.R, system.Z);
    }
  const auto          B_motion = feti.linearization().multiply_B(motion);
  const auto         &layout   = problem.solver.gluing(0).layout();
  std::vector<double> values;
  for (const auto &B : feti.linearization().B())
    for (const auto &entry : B)
      values.push_back(entry.value);
  values = layout.gather_entries(1, values);
  for (unsigned int i = 0; i < B_motion.n_rows(); ++i)
    {
      // the entries of a gluing row add up to zero, those of a support not
      double sum = 0.;
      for (unsigned int e = layout.entry_start()[i]; e < layout.entry_start()[i + 1]; ++e)
        sum += values[e];
      if (layout.contact_rows()[i] || std::abs(sum) > 1e-10)
        continue;
      for (unsigned int mode = 0; mode < 6; ++mode)
        EXPECT_NEAR(B_motion(i, mode), 0., 1e-13);
    }
}

/// Return the number of compact subdomains of a scene on one rank; more ranks make more subdomains.
unsigned int count_compact(const TestScene<3> &scene)
{
  Problem<3>   problem(scene, MPI_COMM_SELF);
  unsigned int n = 0;
  for (const auto &system : problem.solver.feti(problem.solve()).linearization().subdomains())
    n += system.compact;
  return n;
}

TEST(Assembler, CubesOfNearlyCubicCellsOfOneMaterialAreCompact)
{
  auto scene       = two_blocks<3>(4, 4, 0.);
  scene.subdomains = 2;
  EXPECT_EQ(count_compact(scene), 2u);
  scene.degree = 2;
  EXPECT_EQ(count_compact(scene), 2u);
  scene.degree          = 1;
  scene.bodies[0].cells = {2, 4, 4}; // cells of aspect 2, and 32 are no cube
  EXPECT_EQ(count_compact(scene), 1u);
  scene.bodies[1].core_from = 0.5;
  EXPECT_EQ(count_compact(scene), 0u);
  // hanging nodes: cells of two sizes
  scene                         = two_blocks<3>(4, 4, 0.);
  scene.subdomains              = 2;
  scene.bodies[0].refined_below = 0.45;
  EXPECT_EQ(count_compact(scene), 1u);
  // three cubes in one part
  scene                    = two_blocks<3>(4, 4, 0.);
  scene.subdomains         = 1; // of each body
  scene.bodies[0].size[0]  = 3.;
  scene.bodies[0].cells[0] = 12;
  EXPECT_EQ(count_compact(scene), 1u);
}

TEST(Assembler, LoadsHaveTheRightResultant)
{
  // a flat unit box: resultant = traction + pressure + weight
  auto scene             = loaded_scene<2>(1);
  scene.bodies[0].radius = 0.;
  Problem<2>           problem(scene);
  const auto           state = problem.solve();
  dealii::Tensor<1, 2> sum;
  const auto          &feti = problem.solver.feti(state);
  for (unsigned int s = 0; s < feti.loads().size(); ++s)
    if (feti.linearization().subdomains()[s].body == 0)
      for (unsigned int i = 0; i < feti.loads()[s].n_rows(); ++i)
        sum[i % 2] += feti.loads()[s](i);
  for (unsigned int c = 0; c < 2; ++c)
    {
      double total = sum[c];
      MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
      EXPECT_NEAR(total, c == 0 ? 0.7 - 1.5 : -10. - 0.4, 1e-13);
    }
}
} // namespace
