#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

#include <deal.II/base/numbers.h>

namespace {
using namespace snug;
using namespace snug::test;
using contact::Method;

template <int dim>
TestScene<dim> blocks(const Method method, unsigned int n, unsigned int m)
{
  auto scene                      = two_blocks<dim>(n, m, 0.);
  scene.method                    = method;
  scene.solver.relative_tolerance = 1e-12;
  for (auto &body : scene.bodies)
    body.material.poissons_ratio = 0.;
  return scene;
}

/// About all axes.
template <int dim>
dealii::Tensor<2, dim> tilt()
{
  dealii::Tensor<2, dim> q = dealii::unit_symmetric_tensor<dim>();
  for (unsigned int axis = 0; axis < (dim == 3 ? 3 : 1); ++axis)
    {
      const unsigned int     i = axis, j = (axis + 1) % dim;
      const double           angle = 0.4 + 0.3 * axis;
      dealii::Tensor<2, dim> turn  = dealii::unit_symmetric_tensor<dim>();
      turn[i][i] = turn[j][j] = std::cos(angle);
      turn[i][j]              = -std::sin(angle);
      turn[j][i]              = std::sin(angle);
      q                       = turn * q;
    }
  return q;
}

/// Largest difference of a contact pressure of the tilted scene from
/// @p pressure at the slave node before the tilt, relative to the largest.
template <int dim, typename Pressure>
double tilted_error(const TestScene<dim> &scene, const Pressure &pressure)
{
  const Problem<dim> problem(scene);
  const auto         reference = problem.mesh.reference_positions();
  auto               positions = reference;
  const auto         q         = tilt<dim>();
  for (auto &x : positions)
    x = q * x;
  std::ostringstream      log;
  RunContext              context(MPI_COMM_WORLD, log);
  state::StateSolver<dim> solver(problem.mesh, problem.tearing, problem.model, positions, context);
  const auto              state = solver.solve(positions, qp::WarmStart());
  const auto              x     = solver.surface().gather(reference);
  double                  worst = 0.;
  for (unsigned int i = 0; i < state.contact.size(); ++i)
    worst = std::max(worst, std::abs(state.contact[i].pressure -
                                     pressure(x[solver.contact(0).places()[i].slave][0])));
  return worst / state.max_pressure;
}

/// The upper block held by contact alone, hanging nodes on its lower face.
template <int dim>
void expect_uniform_pressure_passes(TestScene<dim> scene)
{
  scene.bodies[0].supports.clear();
  if (scene.method == Method::mortar)
    scene.bodies[0].refined_below = 0.4;
  EXPECT_LT(tilted_error(scene, [](double) { return 10.; }), 1e-10)
    << to_text(scene.method) << " " << dim << " " << scene.degree;
}

TEST(PatchTest, UniformPressure)
{
  for (const unsigned int degree : {1, 2})
    {
      auto matching = blocks<2>(Method::nodal, 4, 4), other = blocks<2>(Method::mortar, 3, 4);
      matching.degree = other.degree = degree;
      expect_uniform_pressure_passes(matching);
      expect_uniform_pressure_passes(other);
    }
  expect_uniform_pressure_passes(blocks<3>(Method::nodal, 3, 3));
  expect_uniform_pressure_passes(blocks<3>(Method::mortar, 3, 4));
}

const double mean_pressure = 8., slope = 5.;

double linear_pressure(double x)
{
  return mean_pressure + slope * (x - 0.5);
}

/// The stress -p(x) along the last axis and no other, p linear; with
/// Poisson's ratio 0, u_x = p' z^2 / 2E, u_z = -p z / E in both blocks.
template <int dim>
TestScene<dim> bent_blocks(const Method method, unsigned int n, unsigned int m)
{
  auto scene         = blocks<dim>(method, n, m);
  scene.degree       = 2;
  auto        &punch = scene.bodies[0];
  const double E     = punch.material.youngs_modulus;
  punch.supports.clear();
  punch.loads.clear();
  for (unsigned int d = 1; d + 1 < dim; ++d)
    punch.supports[face_index(d, 0)] = {dim};
  punch.prescribed = {
    {0,
     face_index(0, 0),
     dim,
     {[E](const dealii::Point<dim> &x) { return -slope * x[dim - 1] * x[dim - 1] / (2. * E); }},
     "side"},
    {0,
     face_index(dim - 1, 1),
     dim,
     {[E](const dealii::Point<dim> &x) { return -linear_pressure(x[0]) * x[dim - 1] / E; }},
     "top"}};
  return scene;
}

TEST(PatchTest, LinearStress)
{
  EXPECT_LT(tilted_error(bent_blocks<2>(Method::nodal, 3, 3), linear_pressure), 1e-10);
  EXPECT_LT(tilted_error(bent_blocks<2>(Method::mortar, 3, 4), linear_pressure), 1e-10);
  EXPECT_LT(tilted_error(bent_blocks<3>(Method::nodal, 2, 2), linear_pressure), 1e-10);
  EXPECT_LT(tilted_error(bent_blocks<3>(Method::mortar, 2, 3), linear_pressure), 1e-10);
}

/// Largest relative difference of a contact pressure from @p pressure.
template <int dim>
double pressure_error(const state::ContactState<dim> &state, double pressure)
{
  double worst = 0.;
  for (const auto &point : state.contact)
    worst = std::max(worst, std::abs(point.pressure / pressure - 1.));
  return worst;
}

TEST(PatchTest, WithoutLateralMotion)
{
  // rollers all round; held nodes of the slave side as well
  auto scene = blocks<3>(Method::mortar, 3, 4);
  for (auto &body : scene.bodies)
    {
      body.material.poissons_ratio = 0.3;
      for (unsigned int axis = 0; axis < 2; ++axis)
        for (unsigned int side = 0; side < 2; ++side)
          body.supports[face_index(axis, side)] = {axis};
    }
  EXPECT_LT(pressure_error(Problem<3>(scene).solve(), 10.), 1e-10);
}

TEST(PatchTest, BodiesOfRevolution)
{
  for (const unsigned int degree : {1, 2})
    {
      auto scene         = blocks<2>(Method::mortar, 3, 4);
      scene.degree       = degree;
      scene.idealization = {mesh::Idealization::Kind::axisymmetric};
      const auto state   = Problem<2>(scene).solve();
      EXPECT_LT(pressure_error(state, 10.), 1e-10) << degree;
      // per full revolution
      EXPECT_NEAR(state.contact_force[1], 10. * dealii::numbers::PI, 1e-9);
      EXPECT_NEAR(state.contact_area, dealii::numbers::PI, 1e-12);
    }
}

/// Energy and largest pressure of a punch so flat that it does not matter
/// whose normals the rows have (a second order of slopes: 1e-5).
std::pair<double, double> curved_punch(unsigned int n, bool punch_is_slave)
{
  auto scene                                       = two_blocks<2>(2 * n, 3 * n, 40.);
  scene.bodies[0].loads[face_index(1, 1)].pressure = 1.;
  const contact::Boundary punch(0, face_index(1, 0));
  const contact::Boundary foundation(1, face_index(1, 1));
  contact::Pair pair{punch_is_slave ? punch : foundation, punch_is_slave ? foundation : punch};
  pair.parameters.slave  = contact::Slave::first;
  pair.parameters.method = Method::mortar;
  scene.pairs            = {pair};
  const auto state       = Problem<2>(scene).solve();
  return {state.energy, state.max_pressure};
}

TEST(Mortar, ExchangeOfSidesVanishesWithRefinement)
{
  std::vector<double> energies, pressures;
  for (const unsigned int n : {4, 8, 16})
    {
      const auto a = curved_punch(n, true), b = curved_punch(n, false);
      energies.push_back(relative_difference(a.first, b.first));
      pressures.push_back(relative_difference(a.second, b.second));
    }
  for (unsigned int i = 0; i < 2; ++i)
    {
      EXPECT_LT(energies[i + 1], energies[i] / 2.);
      EXPECT_LT(pressures[i + 1], pressures[i] / 2.);
    }
}

TEST(Mortar, StateDoesNotDependOnRanksAndSubdomains)
{
  auto scene                      = two_blocks<3>(3, 4, 3.);
  scene.method                    = Method::mortar;
  scene.bodies[0].refined_below   = 0.4;
  scene.solver.relative_tolerance = 1e-12;
  const auto answer               = [&](unsigned int subdomains, MPI_Comm communicator) {
    scene.subdomains = subdomains;
    return Problem<3>(scene, communicator).solve();
  };
  const auto own = answer(2, MPI_COMM_SELF), all = answer(9, MPI_COMM_WORLD);
  EXPECT_LT(relative_difference(own.energy, all.energy), 1e-9);
  EXPECT_LT(relative_difference(own.max_pressure, all.max_pressure), 1e-9);
  EXPECT_EQ(own.active_contacts, all.active_contacts);
}
} // namespace
