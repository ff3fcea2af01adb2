#include <snug/base/errors.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

template <int dim>
std::function<double(const dealii::Point<dim> &)> constant(double value)
{
  return [value](const dealii::Point<dim> &) { return value; };
}

/// A rotation about an axis that is none of the coordinate axes.
template <int dim>
dealii::Tensor<2, dim> rotation()
{
  dealii::Tensor<2, dim> Q;
  for (unsigned int d = 0; d < dim; ++d)
    Q[d][d] = 1.;
  const double angles[] = {0.7, -0.4, 1.1};
  for (unsigned int k = 0; k < (dim == 2 ? 1 : 3); ++k)
    {
      dealii::Tensor<2, dim> R;
      for (unsigned int d = 0; d < dim; ++d)
        R[d][d] = 1.;
      const unsigned int i = k, j = (k + 1) % dim;
      R[i][i] = R[j][j] = std::cos(angles[k]);
      R[i][j]           = -std::sin(angles[k]);
      R[j][i]           = std::sin(angles[k]);
      Q                 = R * Q;
    }
  return Q;
}

/// All supports as rollers on their faces.
template <int dim>
TestScene<dim> rollers(unsigned int n, unsigned int m)
{
  auto scene = two_blocks<dim>(n, m, 3.);
  set_design(scene, 3, 0.02);
  for (auto &body : scene.bodies)
    body.supports.clear();
  for (unsigned int body = 0; body < 2; ++body)
    for (unsigned int d = 0; d + 1 < dim; ++d)
      scene.bodies[body].supports[face_index(d, 0)] = {dim};
  scene.bodies[1].supports[face_index(dim - 1, 0)] = {dim};
  return scene;
}

template <int dim>
void expect_same_when_rotated(TestScene<dim> scene)
{
  const auto   Q = rotation<dim>();
  Problem<dim> problem(scene);
  const auto   upright = problem.solve();
  auto         axes    = scene;
  for (auto &body : axes.bodies)
    for (auto &support : body.supports)
      support.second = {support.first / 2};
  Problem<dim> held_by_axes(axes);
  const auto   by_axes = held_by_axes.solve();

  auto x = problem.positions(scene.design);
  auto X = problem.mesh.reference_positions();
  for (auto *positions : {&x, &X})
    for (auto &point : *positions)
      point = Q * point;
  std::ostringstream      log;
  RunContext              context(MPI_COMM_WORLD, log);
  auto                    model = Problem<dim>::make_model(scene);
  state::StateSolver<dim> solver(problem.mesh, problem.tearing, model, X, context);
  const auto              rotated = solver.solve(x, qp::WarmStart());

  ASSERT_EQ(rotated.contact.size(), upright.contact.size());
  for (unsigned int i = 0; i < rotated.contact.size(); ++i)
    for (const auto *other : {&upright, &by_axes})
      EXPECT_NEAR(rotated.contact[i].pressure, other->contact[i].pressure,
                  1e-9 * upright.max_pressure);
  double size = 0.;
  for (const auto &cell : problem.mesh.cells())
    for (const unsigned int node : cell.nodes)
      size = std::max(size, upright.displacement[node].norm());
  for (const auto &cell : problem.mesh.cells())
    for (const unsigned int node : cell.nodes)
      EXPECT_LT((rotated.displacement[node] - Q * upright.displacement[node]).norm(), 1e-8 * size);
}

TEST(Supports, NormalsTurnWithTheScene)
{
  for (const unsigned int degree : {1, 2})
    {
      auto flat                      = rollers<2>(4, 5);
      flat.degree                    = degree;
      flat.bodies[1].refined_below   = 0.45;
      flat.solver.relative_tolerance = 1e-12;
      expect_same_when_rotated(flat);
    }
  auto solid                      = rollers<3>(3, 4);
  solid.bodies[0].refined_below   = 0.45;
  solid.subdomains                = 12;
  solid.solver.relative_tolerance = 1e-12;
  expect_same_when_rotated(solid);
}

/// One block alone, rolling on x-, y- (, z-) faces and drawn at one face.
template <int dim>
TestScene<dim> single_block(double strain)
{
  TestScene<dim> scene;
  scene.bodies.resize(1);
  auto &body = scene.bodies[0];
  for (unsigned int d = 0; d < dim; ++d)
    {
      body.size[d]                    = 1. + 0.5 * d;
      body.supports[face_index(d, 0)] = {dim};
    }
  body.cells.assign(dim, 3);
  body.prescribed.push_back(
    {0, face_index(dim - 1, 1), dim - 1, {constant<dim>(strain * body.size[dim - 1])}, "pull"});
  scene.solver.relative_tolerance = 1e-12;
  return scene;
}

/// Uniaxial stress: uniform strain, exactly. No loads: e = 0.
template <int dim>
void check_uniaxial()
{
  const double strain = 0.01;
  Problem<dim> problem(single_block<dim>(strain));
  const auto   state    = problem.solve();
  const auto  &material = problem.scene.bodies[0].material;
  const double nu       = material.poissons_ratio;
  const double lateral  = dim == 3 ? -nu : -nu / (1. - nu);
  const double modulus  = material.youngs_modulus / (dim == 3 ? 1. : 1. - nu * nu);
  for (const auto &cell : problem.mesh.cells())
    for (const unsigned int node : cell.nodes)
      for (unsigned int c = 0; c < dim; ++c)
        EXPECT_NEAR(state.displacement[node][c],
                    strain * (c == dim - 1 ? 1. : lateral) *
                      problem.mesh.reference_positions()[node][c],
                    1e-13);
  double volume = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    volume *= problem.scene.bodies[0].size[d];
  const double energy = modulus * strain * strain / 2. * volume;
  EXPECT_NEAR(state.energy, energy, 1e-11 * energy);
  EXPECT_EQ(state.compliance, 0.);
  EXPECT_LT(state.certificate.worst(), 1e-12);
}

TEST(Supports, PrescribedDisplacementsDriveUniaxialStress)
{
  check_uniaxial<2>();
  check_uniaxial<3>();
}

TEST(Supports, PrescribedRigidMotionsCostNothing)
{
  // all of the bottom moved rigidly: no stress, no force, and certified
  auto  scene = single_block<3>(0.);
  auto &body  = scene.bodies[0];
  body.supports.clear();
  body.prescribed.clear();
  for (unsigned int c = 0; c < 3; ++c)
    body.prescribed.push_back({0, face_index(2, 0), c, {constant<3>(0.1 * (c + 1.))}, "motion"});
  Problem<3> problem(scene);
  const auto state = problem.solve();
  for (const auto &cell : problem.mesh.cells())
    for (const unsigned int node : cell.nodes)
      for (unsigned int c = 0; c < 3; ++c)
        EXPECT_NEAR(state.displacement[node][c], 0.1 * (c + 1.), 1e-13);
  EXPECT_NEAR(state.energy, 0., 1e-20);
}

/// Message of a scene that cannot be.
template <int dim>
std::string error_of(const TestScene<dim> &scene)
{
  try
    {
      const Problem<dim> problem(scene);
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}

TEST(Supports, ConflictsNameBoth)
{
  auto  scene = single_block<2>(0.01);
  auto &body  = scene.bodies[0];
  EXPECT_EQ(error_of(scene), "");
  // 0.015 at the top, nothing at the bottom, as the others say
  const auto linear = [](double top) {
    return [top](const dealii::Point<2> &x) { return top * x[1] / 1.5; };
  };
  body.prescribed.push_back({0, face_index(0, 1), 1, {linear(0.015)}, "the right side"});
  EXPECT_EQ(error_of(scene), "");
  body.prescribed.back().values = {linear(0.02)};
  const std::string message     = error_of(scene);
  EXPECT_NE(message.find("pull and the right side"), std::string::npos) << message;
  EXPECT_NE(message.find("0.015 and 0.02"), std::string::npos) << message;
  // a normal along a held axis
  body.prescribed.back() = {0, face_index(1, 1), 2, {constant<2>(0.015)}, "normal"};
  EXPECT_EQ(error_of(scene), "");
  body.prescribed.back().values = {constant<2>(0.01)};
  EXPECT_NE(error_of(scene).find("pull and normal"), std::string::npos);
}

/// Radial and hoop part of a quarter ring that is widened at its inner
/// side: u_r = A r + B / r in plane strain, no traction outside.
TEST(Supports, NormalsOfCurvedFacesAgainstLame)
{
  const double inner = 1., outer = 2., widening = 0.01;
  double       last_error = 0.;
  for (const unsigned int n : {6, 12})
    {
      auto  scene = single_block<2>(0.);
      auto &body  = scene.bodies[0];
      body.cells  = {n, n};
      body.size   = dealii::Point<2>(1., 1.);
      body.prescribed.clear();
      body.supports = {{face_index(1, 0), {2}}, {face_index(1, 1), {2}}};
      body.prescribed.push_back({0, face_index(0, 0), 2, {constant<2>(-widening)}, "inner"});
      Problem<2> problem(scene);
      auto       x = problem.mesh.reference_positions();
      for (auto &point : x)
        {
          const double r     = inner + (outer - inner) * point[0];
          const double angle = dealii::numbers::PI_2 * point[1];
          point[0]           = r * std::cos(angle);
          point[1]           = r * std::sin(angle);
        }
      auto                  model = Problem<2>::make_model(scene);
      std::ostringstream    log;
      RunContext            context(MPI_COMM_WORLD, log);
      state::StateSolver<2> solver(problem.mesh, problem.tearing, model, x, context);
      const auto            state = solver.solve(x, qp::WarmStart());
      const double          nu    = body.material.poissons_ratio;
      // sigma_r(outer) = 0: (1) A = B (1 - 2 nu) / outer^2
      const double B     = widening / (inner * (1. - 2. * nu) / (outer * outer) + 1. / inner);
      const double A     = B * (1. - 2. * nu) / (outer * outer);
      double       error = 0.;
      for (const auto &cell : problem.mesh.cells())
        for (const unsigned int node : cell.nodes)
          {
            const double r = x[node].norm();
            error =
              std::max(error, (state.displacement[node] - (A + B / (r * r)) * x[node]).norm());
          }
      error = dealii::Utilities::MPI::max(error, MPI_COMM_WORLD);
      EXPECT_LT(error, (n == 6 ? 2e-2 : 5e-3) * widening);
      if (last_error > 0.)
        {
          EXPECT_NEAR(last_error / error, 4., 0.6);
        }
      last_error = error;
    }
}
} // namespace
