#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

/// Force and moment about the origin of the loads of a body in a load case.
template <int dim>
elasticity::Resultant<dim> resultant(const Problem<dim>                 &problem,
                                     const typename Problem<dim>::Field &x,
                                     unsigned int                        body,
                                     unsigned int                        load_case)
{
  const auto                 f = problem.solver.loads(x, load_case);
  elasticity::Resultant<dim> sum;
  for (unsigned int s = 0; s < f.size(); ++s)
    for (unsigned int a = 0; a < f[s].n_rows() / dim; ++a)
      {
        const unsigned int node = problem.tearing.subdomains[s].nodes[a];
        if (problem.tearing.subdomains[s].body != body)
          continue;
        dealii::Tensor<1, dim> force;
        for (unsigned int c = 0; c < dim; ++c)
          force[c] = f[s](dim * a + c);
        sum.force += force;
        sum.moment += elasticity::moment_of(x[node], force);
      }
  for (unsigned int c = 0; c < dim; ++c)
    sum.force[c] = dealii::Utilities::MPI::sum(sum.force[c], MPI_COMM_WORLD);
  for (unsigned int c = 0; c < 3; ++c)
    sum.moment[c] = dealii::Utilities::MPI::sum(sum.moment[c], MPI_COMM_WORLD);
  return sum;
}

template <int dim>
elasticity::Resultant<dim> some_resultant()
{
  elasticity::Resultant<dim> given;
  for (unsigned int c = 0; c < dim; ++c)
    given.force[c] = 0.3 - 0.7 * c;
  for (unsigned int c = (dim == 2 ? 2 : 0); c < 3; ++c)
    given.moment[c] = 0.2 + 0.1 * c;
  return given;
}

/// On a curved face with hanging nodes, at a design that bends it: a force
/// alone acts at the centroid, and the moment comes on top.
template <int dim>
void check_resultants()
{
  auto scene = two_blocks<dim>(3, 4, 3.);
  set_design(scene, 3, 0.05);
  scene.bodies[1].refined_below = 0.45;
  const auto         given      = some_resultant<dim>();
  const unsigned int top        = face_index(dim - 1, 1);
  scene.cases.resize(2, std::vector<typename TestBody<dim>::Loads>(2));
  scene.cases[0][1][top].resultant.force = given.force;
  scene.cases[1][1][top].resultant       = given;
  const Problem<dim> problem(scene);
  const auto         x = problem.positions(scene.design);

  // centroid of the face by the tributary areas of its nodes
  dealii::Tensor<1, dim> centre;
  double                 area = 0.;
  for (const auto &face : problem.mesh.boundary_faces())
    if (face.body == 1 && face.boundary == top)
      {
        std::vector<dealii::Tensor<1, dim>> X;
        for (const unsigned int node : face.nodes)
          X.push_back(x[node]);
        const auto areas = problem.solver.face_load().areas(X);
        for (unsigned int a = 0; a < X.size(); ++a)
          {
            centre += areas[a] * X[a];
            area += areas[a];
          }
      }
  area = dealii::Utilities::MPI::sum(area, MPI_COMM_WORLD);
  for (unsigned int c = 0; c < dim; ++c)
    centre[c] = dealii::Utilities::MPI::sum(centre[c], MPI_COMM_WORLD) / area;
  const auto moment_of_force = elasticity::moment_of(centre, given.force);

  const auto force = resultant(problem, x, 1, 0);
  EXPECT_LT((force.force - given.force).norm(), 1e-12);
  EXPECT_LT((force.moment - moment_of_force).norm(), 1e-12);
  const auto both = resultant(problem, x, 1, 1);
  EXPECT_LT((both.force - given.force).norm(), 1e-12);
  EXPECT_LT((both.moment - moment_of_force - given.moment).norm(), 1e-12);
  EXPECT_EQ(resultant(problem, x, 0, 0).force.norm(), 0.);
}

TEST(Loads, ResultantsAreExact)
{
  check_resultants<2>();
  check_resultants<3>();
}

TEST(Loads, FormulasActOnTheReferencePosition)
{
  // traction (x, 0, 0) on the top of a unit cube, wherever it moved
  TestScene<3> scene;
  scene.bodies.resize(1);
  auto &body = scene.bodies[0];
  for (unsigned int d = 0; d < 3; ++d)
    body.size[d] = 1.;
  body.cells                               = {3, 3, 3};
  body.supports[face_index(2, 0)]          = {0, 1, 2};
  body.loads[face_index(2, 1)].traction[0] = 1.;
  body.loads[face_index(2, 1)].factor      = [](const dealii::Point<3> &x) { return x[0]; };
  const Problem<3> problem(scene);
  auto             x = problem.mesh.reference_positions();
  for (auto &point : x)
    point[0] += 7.;
  const auto sum = resultant(problem, x, 0, 0);
  EXPECT_NEAR(sum.force[0], 0.5, 1e-13);
  EXPECT_NEAR(sum.moment[1], 0.5, 1e-13); // at height 1
}

TEST(Loads, GravityWeighsWhatThereIs)
{
  auto scene                       = two_blocks<2>(3, 4, 0.);
  scene.bodies[1].material.density = 2.5;
  Problem<2> problem(scene);
  auto       model                         = problem.model;
  model.load_cases[0].bodies[1].gravity[1] = -9.81;
  std::ostringstream    log;
  RunContext            context(MPI_COMM_WORLD, log);
  state::StateSolver<2> solver(problem.mesh, problem.tearing, model,
                               problem.mesh.reference_positions(), context);
  double                weight = 0.;
  auto                  x      = problem.mesh.reference_positions();
  for (unsigned int node = 0; node < x.size(); ++node)
    if (problem.mesh.body_of_node(node) == 1)
      x[node][1] *= 2.; // twice the volume
  const auto f = solver.loads(x, 0);
  for (unsigned int s = 0; s < f.size(); ++s)
    for (unsigned int i = 0; i < f[s].n_rows(); ++i)
      if (problem.tearing.subdomains[s].body == 1 && i % 2 == 1)
        weight += f[s](i);
  EXPECT_NEAR(dealii::Utilities::MPI::sum(weight, MPI_COMM_WORLD), -2. * 2.5 * 9.81, 1e-12);
}

/// Three load cases: pressed, tilted by a moment, and driven.
template <int dim>
TestScene<dim> three_cases()
{
  auto scene = two_blocks<dim>(4, 4, 3.);
  set_design(scene, 3, 0.03);
  scene.solver.relative_tolerance = 1e-12;
  const unsigned int top          = face_index(dim - 1, 1);
  scene.cases.resize(3, std::vector<typename TestBody<dim>::Loads>(2));
  for (unsigned int c = 0; c < 3; ++c)
    scene.cases[c][0][top].pressure = 10. + 5. * c;
  scene.cases[1][0][top].resultant.moment[dim == 2 ? 2 : 0] = 0.2;
  scene.cases[2][1][face_index(0, 1)].traction[0]           = 0.5;
  const auto push                                           = [](double value) {
    return [value](const dealii::Point<dim> &x) { return value * (1. + x[dim - 1]); };
  };
  scene.bodies[1].prescribed.push_back(
    {1, face_index(0, 0), dim, {{}, push(1e-4), push(-2e-4)}, "drive"});
  // the bottom leaves the driven side free
  scene.bodies[1].supports = {{face_index(dim - 1, 0), {dim - 1}}};
  if (dim == 3)
    scene.bodies[1].supports[face_index(1, 0)] = {1};
  return scene;
}

template <int dim>
void check_cases()
{
  const auto   scene = three_cases<dim>();
  Problem<dim> problem(scene);
  const auto   x = problem.positions(scene.design);
  for (unsigned int c = 0; c < 3; ++c)
    {
      const auto state = problem.solver.solve(x, qp::WarmStart(), c);
      auto       alone = scene;
      alone.cases      = {scene.cases[c]};
      auto &values     = alone.bodies[1].prescribed[0].values;
      values           = {values[c]};
      Problem<dim> own(alone);
      const auto   expected = own.solve();
      EXPECT_EQ(state.load_case, c);
      EXPECT_LT(relative_difference(state.energy, expected.energy), 1e-9);
      ASSERT_GT(expected.active_contacts, 0u);
      for (unsigned int i = 0; i < state.contact.size(); ++i)
        EXPECT_NEAR(state.contact[i].pressure, expected.contact[i].pressure,
                    1e-9 * expected.max_pressure);
      if (c == 0)
        continue;
      // one factorization of each subdomain, and of its interior, for all
      const auto work     = problem.context.total_work();
      const auto own_work = own.context.total_work();
      EXPECT_EQ(work.assembled_subdomains, own_work.assembled_subdomains);
      EXPECT_EQ(work.numeric_factorizations, own_work.numeric_factorizations);
      EXPECT_EQ(work.symbolic_factorizations, own_work.symbolic_factorizations);
    }
  // cases differ
  const auto first = problem.solver.solve(x, qp::WarmStart(), 0);
  const auto last  = problem.solver.solve(x, qp::WarmStart(), 2);
  EXPECT_GT(relative_difference(first.energy, last.energy), 0.1);
}

TEST(LoadCases, EqualTheirOwnRunsWithOneFactorization)
{
  check_cases<2>();
  check_cases<3>();
}
} // namespace
